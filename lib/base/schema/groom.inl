BEGIN(hair_import)
FLOAT(hair_import, scale, 1, 1e-6, 1e6, 0.001, 100, LOG, "m", "Length of one unit of the positions.")
ENUM(hair_import, up, HAIR_UP_Y, "Axis that points up in the positions.", "y", "z", "x")
BOOL(hair_import, tip_first, false,
      "Order of the vertices of a strand, false for root to tip and true for tip to root.")
FLOAT(hair_import, keep_fraction, 1, 1e-6, 1, 0.01, 1, LINEAR, "",
      "Fraction of the strands that the import keeps, chosen at random from `seed`.")
UINT(hair_import, strand_vertices, 0, 0, 256, 0, 64, LINEAR, "",
      "Number of vertices to which every strand is resampled.")
UINT(hair_import, seed, 1, 0, UINT32_MAX, 0, 100, LINEAR, "", "Seed of all random choices.")
END
BEGIN(hair_map_set)
#undef GROUP
#define GROUP "density"
ENUM(hair_map_set, density.source, HAIR_MAP_SOURCE_NONE,
      "Source of the values of a map.", "none", "image", "vertices", "triangles")
POINTER(hair_map_set, density.values, "Values of the source.")
UINT(hair_map_set, density.width, 0, 0, 16384, 0, 1024, LINEAR, "",
      "Width of the image, in texels, at least 1.")
UINT(hair_map_set, density.height, 0, 0, 16384, 0, 1024, LINEAR, "",
      "Height of the image, in texels, at least 1.")
#undef GROUP
#define GROUP "thickness"
ENUM(hair_map_set, thickness.source, HAIR_MAP_SOURCE_NONE,
      "Source of the values of a map.", "none", "image", "vertices", "triangles")
POINTER(hair_map_set, thickness.values, "Values of the source.")
UINT(hair_map_set, thickness.width, 0, 0, 16384, 0, 1024, LINEAR, "",
      "Width of the image, in texels, at least 1.")
UINT(hair_map_set, thickness.height, 0, 0, 16384, 0, 1024, LINEAR, "",
      "Height of the image, in texels, at least 1.")
#undef GROUP
#define GROUP ""
END
BEGIN(hair_strand_attribute)
ENUM(hair_strand_attribute, kind, HAIR_STRAND_ATTRIBUTE_STIFFNESS, "Property that the factors multiply.", "stiffness",
      "damping", "shape_frequency", "gravity_preload", "clump", "curl_radius", "curl_frequency", "frizz",
      "roughness", "radius", "length", "density")
POINTER(hair_strand_attribute, strand_values, "Factor of each strand.")
#undef GROUP
#define GROUP "map"
ENUM(hair_strand_attribute, map.source, HAIR_MAP_SOURCE_NONE,
      "Source of the values of a map.", "none", "image", "vertices", "triangles")
POINTER(hair_strand_attribute, map.values, "Values of the source.")
UINT(hair_strand_attribute, map.width, 0, 0, 16384, 0, 1024, LINEAR, "",
      "Width of the image, in texels, at least 1.")
UINT(hair_strand_attribute, map.height, 0, 0, 16384, 0, 1024, LINEAR, "",
      "Height of the image, in texels, at least 1.")
#undef GROUP
#define GROUP ""
END
BEGIN(hair_groom_desc)
POINTER(hair_groom_desc, host, "Callbacks.")
POINTER(hair_groom_desc, positions,
      "Vertex positions, xyz each, strand after strand, in units of hair_import.scale.")
POINTER(hair_groom_desc, strand_vertices, "Number of vertices of each strand, of any size.")
UINT(hair_groom_desc, strand_count, 0, 1, 4194304, 1, 100000, LOG, "", "Number of strands.")
POINTER(hair_groom_desc, import, "Conversion of the positions.")
ENUM(hair_groom_desc, strand_set, HAIR_STRAND_SET_FULL,
      "Meaning of the strands that a groom is made from.", "full", "guides")
AUTO_UINT(hair_groom_desc, guide_count, 0, 262144, 0, 2000, LINEAR, "",
      "Number of guides to choose from HAIR_STRAND_SET_FULL.")
UINT(hair_groom_desc, guide_vertices, 32, 2, 256, 4, 64, LINEAR, "",
      "Maximum number of simulated vertices per guide.")
UINT(hair_groom_desc, follower_count, 18000, 0, 4194304, 0, 100000, LINEAR, "",
      "Number of followers to generate for HAIR_STRAND_SET_GUIDES.")
FLOAT(hair_groom_desc, clump_radius, 0.01, 0, 1, 0, 0.05, LINEAR, "m",
      "Radius around a guide in which its followers grow if there is no scalp.")
POINTER(hair_groom_desc, scalp_positions,
      "Positions of the scalp's vertices, xyz each, in the space of `positions`.")
POINTER(hair_groom_desc, scalp_triangles,
      "Three vertex indices per triangle, counter-clockwise seen from outside.")
POINTER(hair_groom_desc, scalp_density, "Fraction of the full follower density per scalp vertex.")
UINT(hair_groom_desc, scalp_vertex_count, 0, 0, 4194304, 0, 65536, LINEAR, "", "Number of scalp vertices.")
UINT(hair_groom_desc, scalp_triangle_count, 0, 0, 4194304, 0, 65536, LINEAR, "", "Number of scalp triangles.")
UINT(hair_groom_desc, seed, 1, 0, UINT32_MAX, 0, 100, LINEAR, "", "Seed of all random choices.")
POINTER(hair_groom_desc, scalp_uvs,
      "Texture coordinates per scalp vertex, uv each, for map images and hair_view.color_texture.")
POINTERS(hair_groom_desc, map_sets, 4, "Maps on the scalp.")
POINTER(hair_groom_desc, strand_radii, "Radius of each strand, in the unit of `positions`.")
POINTER(hair_groom_desc, colors, "Linear rgb colours of the strands, color_count per strand.")
UINT(hair_groom_desc, color_count, 0, 0, 256, 0, 32, LINEAR, "",
      "Number of colours per strand, at even places from root to tip.")
POINTER(hair_groom_desc, physics, "Physics that instances will be created with.")
ENUM(hair_groom_desc, solver, HAIR_SOLVER_DIRECT, "Solver for which `physics` prepares the guides.",
      "direct", "accurate", "follow", "redblack")
POINTER(hair_groom_desc, tasks, "Threads on which the guides are prepared.")
POINTER(hair_groom_desc, strand_groups, "Group of each strand, such as beard, brows or undercoat.")
POINTER(hair_groom_desc, strand_attributes, "Attributes of strands, strand_attribute_count of them.")
UINT(hair_groom_desc, strand_attribute_count, 0, 0, 32, 0, 32, LINEAR, "", "Number of attributes.")
POINTER(hair_groom_desc, strand_guides, "1 for each strand that is a guide, otherwise 0.")
END
