BEGIN(hair_physics)
VECTOR(hair_physics, gravity, 0, -9.81, 0, -1000, 1000, -20, 20, "m/s^2",
      "Acceleration by gravity, in the world.")
FLOAT(hair_physics, damping, 4, 0, 1000, 0, 20, LINEAR, "1/s",
      "Decay rate c of the velocity v relative to the velocity u of the air, dv/dt = -c (v - u).")
FLOAT(hair_physics, drag, 0.1, 0, 10, 0, 1, LINEAR, "",
      "Multiple of the drag law of hair_wind, which holds for a single hair.")
#undef GROUP
#define GROUP "fiber"
FLOAT(hair_physics, fiber.youngs_modulus, 4e9, 0, 1e12, 1e8, 1e11, LOG, "Pa", "Young's modulus of the fibre.")
FLOAT(hair_physics, fiber.poisson_ratio, 0.45, 0, 0.5, 0, 0.5, LINEAR, "", "Poisson's ratio of the fibre.")
FLOAT(hair_physics, fiber.radius, 4e-5, 1e-6, 1e-3, 1e-5, 2e-4, LOG, "m",
      "Radius of the circle with the area of the fibre's cross section.")
FLOAT(hair_physics, fiber.density, 1300, 1, 1e5, 500, 3000, LINEAR, "kg/m^3", "Mass density of the fibre.")
FLOAT(hair_physics, fiber.flatness, 1, 0.03, 1, 0.3, 1, LINEAR, "",
      "Ratio of the short axis to the long axis of the cross section.")
#undef GROUP
#define GROUP "shape"
FLOAT(hair_physics, shape.stiffness_root, 1, 0, 1e4, 0.1, 100, LOG, "",
      "Multiple of the bending and twist stiffness at the root.")
FLOAT(hair_physics, shape.stiffness_tip, 1, 0, 1e4, 0.1, 100, LOG, "",
      "Multiple of the bending and twist stiffness at the tip.")
FLOAT(hair_physics, shape.frequency_root, 4, 0, 30, 0, 12, LINEAR, "Hz",
      "Frequency of the restoring force to the rest pose at the root.")
FLOAT(hair_physics, shape.frequency_tip, 1, 0, 30, 0, 12, LINEAR, "Hz",
      "Frequency of the restoring force to the rest pose at the tip.")
FLOAT(hair_physics, shape.gravity_preload, 1, 0, 1, 0, 1, LINEAR, "",
      "Fraction of gravity that the rest shape balances.")
#undef GROUP
#define GROUP ""
ENUM(hair_physics, root, HAIR_ROOT_CLAMPED,
      "Boundary condition of guides at the root.", "clamped", "hinged", "free")
FLOAT(hair_physics, tip_mass, 0, 0, 1e4, 0, 10, LINEAR, "",
      "Mass attached to the tip, as a multiple of the mass of the strand.")
#undef GROUP
#define GROUP "collision"
FLOAT(hair_physics, collision.margin, 0.001, 0, 0.1, 0, 0.01, LINEAR, "m",
      "Distance that hair keeps from colliders.")
FLOAT(hair_physics, collision.friction, 0.3, 0, 10, 0, 1, LINEAR, "",
      "Coefficient of Coulomb friction with colliders.")
#undef GROUP
#define GROUP "hair_hair"
FLOAT(hair_physics, hair_hair.cohesion, 0, 0, 1000, 0, 50, LINEAR, "1/s",
      "Decay rate of the velocity of hair relative to the rigid motion of the hair around it.")
FLOAT(hair_physics, hair_hair.pressure_stiffness, 0, 0, 100, 0, 5, LINEAR, "m^2/s^2",
      "Resistance of hair to compression beyond its density at rest, as of a gas, by the square of the "
      "speed of sound.")
#undef GROUP
#define GROUP ""
FLOAT(hair_physics, substep_rate, 1, 0.0625, 1, 0.0625, 1, LOG, "",
      "Multiple of the number of substeps, for level of detail.")
FLOAT(hair_physics, offscreen_substep_rate, 1, 0.0625, 1, 0.0625, 1, LOG, "",
      "Substep rate of hair that has not been visible for 0.25 s, if lower than substep_rate.")
FLOAT(hair_physics, sleep_threshold, 1e-4, 0, 0.01, 0, 1e-3, LINEAR, "m",
      "Distance from equilibrium below which hair falls asleep.")
#undef GROUP
#define GROUP "redblack"
FLOAT(hair_physics, redblack.angular_hz, 8, 0, 30, 0, 16, LINEAR, "Hz",
      "Frequency of the angular force to the rest angle with the previous segment.")
FLOAT(hair_physics, redblack.bend, 0.1, 0, 1, 0, 1, LINEAR, "",
      "Fraction of the angular error that the constraint removes per iteration.")
UINT(hair_physics, redblack.iterations, 20, 1, 256, 1, 64, LINEAR, "",
      "Number of iterations of the constraints per substep.")
#undef GROUP
#define GROUP ""
END
BEGIN(hair_collision_mesh_desc)
POINTER(hair_collision_mesh_desc, host, "Callbacks, kept as long as the collision mesh.")
POINTER(hair_collision_mesh_desc, positions, "Vertex positions, xyz each, in the local space of the mesh.")
POINTER(hair_collision_mesh_desc, triangles,
      "Three vertex indices per triangle, counter-clockwise seen from outside.")
UINT(hair_collision_mesh_desc, vertex_count, 0, 1, 16777216, 1, 100000, LOG, "", "Number of vertices.")
UINT(hair_collision_mesh_desc, triangle_count, 0, 1, 16777216, 1, 100000, LOG, "", "Number of triangles.")
UINT(hair_collision_mesh_desc, resolution, 64, 8, 256, 16, 128, LINEAR, "",
      "Number of voxels along the longest side of the grid.")
AUTO_FLOAT(hair_collision_mesh_desc, voxel_size, 0, 1e6, 0, 0.05, LINEAR, "m",
      "Size of a voxel, enlarged if the longest side would have more than 256.")
FLOAT(hair_collision_mesh_desc, thickness, 0, 0, 1e6, 0, 0.05, LINEAR, "m",
      "Thickness of the shell of an open mesh, at least two voxels.")
FLOAT(hair_collision_mesh_desc, padding, 0, 0, 1e6, 0, 0.1, LINEAR, "m",
      "Space around the surface that the grid covers too, for hair_collider.rounding.")
END
BEGIN(hair_body_desc)
POINTER(hair_body_desc, positions, "First vertex positions, xyz each, in the local space of the collider.")
POINTER(hair_body_desc, triangles,
      "Three vertex indices per triangle, counter-clockwise seen from outside.")
UINT(hair_body_desc, vertex_count, 0, 1, 786432, 1, 20000, LOG, "", "Number of vertices.")
UINT(hair_body_desc, triangle_count, 0, 1, 262144, 1, 20000, LOG, "", "Number of triangles.")
UINT(hair_body_desc, resolution, 64, 8, 128, 16, 128, LINEAR, "",
      "Number of voxels along the longest side of the box from `lower` to `upper`.")
VECTOR(hair_body_desc, lower, 0, 0, 0, -1e6, 1e6, -2, 2, "m",
      "Lower corner of the box in which all vertices stay.")
VECTOR(hair_body_desc, upper, 0, 0, 0, -1e6, 1e6, -2, 2, "m",
      "Upper corner of the box in which all vertices stay, above `lower`.")
FLOAT(hair_body_desc, thickness, 0, 0, 1e6, 0, 0.05, LINEAR, "m",
      "Thickness of the shell of an open or two-sided body, at least two voxels.")
UINT64(hair_body_desc, key, "Key by which hair_load() finds the body among the colliders.")
BOOL(hair_body_desc, two_sided, false, "Permission for hair on both sides of the surface.")
END
BEGIN(hair_collider)
ENUM(hair_collider, shape, HAIR_SHAPE_SPHERE,
      "Shape of a collider in its local space, centred at the origin.", "sphere", "capsule", "box",
      "cylinder", "cone", "plane", "mesh", "ellipsoid")
VECTOR(hair_collider, position, 0, 0, 0, -1e9, 1e9, -2, 2, "m", "Position in the world.")
QUATERNION(hair_collider, rotation, "Rotation in the world, a unit quaternion xyzw.")
VECTOR(hair_collider, size, 0, 0, 0, 0, 1e6, 0, 1, "m", "Dimensions of the shape, see hair_shape.")
FLOAT(hair_collider, rounding, 0, 0, 1e6, 0, 0.1, LINEAR, "m",
      "Distance by which the shape grows on all sides, which rounds its edges.")
FLOAT(hair_collider, scale, 1, 1e-6, 1e6, 0.01, 100, LOG, "", "Scale factor of HAIR_SHAPE_MESH.")
FLOAT(hair_collider, friction, 1, 0, 100, 0, 2, LINEAR, "",
      "Multiple of hair_physics.collision.friction, the coefficient of Coulomb friction.")
POINTER(hair_collider, mesh, "Mesh of HAIR_SHAPE_MESH.")
UINT64(hair_collider, key, "Key that identifies the collider from step to step.")
END
BEGIN(hair_pin)
UINT(hair_pin, guide, 0, 0, UINT32_MAX, 0, 1000, LINEAR, "",
      "Index of the guide, in the order of HAIR_READ_GUIDES of hair_read_positions().")
UINT(hair_pin, vertex, UINT32_MAX, 1, 4294967295, 1, 256, LINEAR, "",
      "Index of the vertex in the guide, from 1.")
ENUM(hair_pin, to, HAIR_PIN_HEAD, "Space in which a pin is fixed.", "head", "world")
VECTOR(hair_pin, position, 0, 0, 0, -1e9, 1e9, -2, 2, "m",
      "Position in groom space for HAIR_PIN_HEAD, and in the world for HAIR_PIN_WORLD.")
END
