BEGIN(hair_target_blend)
FLOAT(hair_target_blend, weight, 1, 0, 1, 0, 1, LINEAR, "", "Weight of all targets.")
CURVE(hair_target_blend, along, 1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 0, 1, "",
      "Factor of the weight along each guide.")
POINTER(hair_target_blend, guide_weights,
      "Factor of the weight of each guide, in the order of HAIR_READ_GUIDES.")
UINT(hair_target_blend, guide_count, 0, 0, 262144, 0, 1000, LINEAR, "",
      "Number of guide weights, that of the guides.")
FLOAT(hair_target_blend, blend_time, 0.25, 0, 10, 0, 2, LINEAR, "s",
      "Time in which a weight changes from 0 to 1.")
END
