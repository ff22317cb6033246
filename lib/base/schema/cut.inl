BEGIN(hair_cut_desc)
ENUM(hair_cut_desc, shape, HAIR_CUT_SHAPE_PLANE, "Shape of the cut.", "plane", "capsule", "blade")
VECTOR(hair_cut_desc, start, 0, 0, 0, -1e9, 1e9, -2, 2, "m",
      "A point of the plane, or the first end of the axis or the edge, in the world.")
VECTOR(hair_cut_desc, end, 0, 0, 0, -1e9, 1e9, -2, 2, "m", "Second end of the axis or the edge, in the world.")
VECTOR(hair_cut_desc, normal, 0, -1, 0, -1, 1, -1, 1, "",
      "Normal of the plane in the world, of any length above 0.")
FLOAT(hair_cut_desc, radius, 0.01, 0, 1e6, 0, 0.5, LINEAR, "m", "Radius of the capsule.")
VECTOR(hair_cut_desc, last_start, 0, 0, 0, -1e9, 1e9, -2, 2, "m",
      "Position of `start` when the stroke of a blade begins.")
VECTOR(hair_cut_desc, last_end, 0, 0, 0, -1e9, 1e9, -2, 2, "m",
      "Position of `end` when the stroke of a blade begins.")
UINT(hair_cut_desc, groups, 255, 0, 255, 0, 255, LINEAR, "", "Groups of strands that are cut.")
END
