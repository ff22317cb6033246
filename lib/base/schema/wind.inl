BEGIN(hair_wind_source)
VECTOR(hair_wind_source, position, 0, 0, 0, -1e9, 1e9, -5, 5, "m", "Centre of the mouth in the world.")
VECTOR(hair_wind_source, direction, 0, 0, 0, -1e6, 1e6, -1, 1, "",
      "Direction of a jet in the world, of any length.")
FLOAT(hair_wind_source, speed, 5, -1000, 1000, -20, 20, LINEAR, "m/s", "Speed of the air at the mouth.")
FLOAT(hair_wind_source, radius, 0.05, 0.001, 100, 0.01, 1, LOG, "m", "Radius of the mouth.")
END
BEGIN(hair_wind)
ENUM(hair_wind, model, HAIR_WIND_AMBIENT,
      "Model of the air flow around head and colliders.", "ambient", "fluid")
VECTOR(hair_wind, velocity, 0, 0, 0, -1000, 1000, -20, 20, "m/s", "Velocity of the air in the world.")
BOOL(hair_wind, still_air, false, "Drag law in still air.")
FLOAT(hair_wind, shelter, 1, 0, 1, 0, 1, LINEAR, "",
      "Strength with which spheres divert ambient wind and gusts, by potential flow upstream and a wake "
      "downstream.")
FLOAT(hair_wind, density, 1.204, 0.001, 1000, 0.1, 1000, LOG, "kg/m^3", "Density of the air.")
FLOAT(hair_wind, viscosity, 1.82e-5, 1e-7, 1, 1e-6, 1e-2, LOG, "Pa s", "Dynamic viscosity of the air.")
#undef GROUP
#define GROUP "turbulence"
FLOAT(hair_wind, turbulence.intensity, 0, 0, 2, 0, 1, LINEAR, "",
      "Turbulence intensity of gusts, the standard deviation of each component of the velocity as a "
      "fraction of the wind's speed.")
FLOAT(hair_wind, turbulence.length, 1, 0.1, 1000, 0.1, 20, LOG, "m",
      "Integral length scale of the turbulence.")
UINT(hair_wind, turbulence.seed, 1, 0, UINT32_MAX, 0, 100, LINEAR, "", "Seed of the turbulence.")
#undef GROUP
#define GROUP ""
POINTER(hair_wind, sources, "Local sources, source_count of them.")
UINT(hair_wind, source_count, 0, 0, 4, 0, 4, LINEAR, "", "Number of local sources.")
TEXTURE(hair_wind, texture,
      "3D OpenGL texture of floats with a wind field of the application, added to the other wind.")
MATRIX(hair_wind, texture_transform, IDENTITY, "Affine transform from the world to texture coordinates.")
#undef GROUP
#define GROUP "fluid"
UINT(hair_wind, fluid.resolution, 32, 16, 128, 16, 64, LINEAR, "",
      "Number of grid cells along a side of the fluid, rounded up to a multiple of 16.")
AUTO_FLOAT(hair_wind, fluid.grid_size, 0, 100, 0, 4, LINEAR, "m", "Side length of the fluid's grid.")
ENUM(hair_wind, fluid.projection, HAIR_PROJECTION_MULTIGRID,
      "Pressure projection method of the fluid.", "multigrid", "relaxation", "jacobi")
AUTO_UINT(hair_wind, fluid.projection_iterations, 0, 10000, 0, 50, LINEAR, "",
      "Number of cycles or sweeps of the projection per 1/60 s.")
UINT(hair_wind, fluid.drag_strand_count, 0, 0, 10000000, 0, 200000, LINEAR, "",
      "Number of strands that slow the fluid, like a porous medium.")
#undef GROUP
#define GROUP ""
END
