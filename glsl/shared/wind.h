// wind.h - the wind: ambient, local sources and fluid.
#ifndef HAIR_SHARED_WIND_H
#define HAIR_SHARED_WIND_H

#define HAIR_WIND_BALLS 4    // Maximum spheres that shelter hair from the wind.
#define HAIR_WIND_SOURCES 4  // Maximum local wind sources per instance.
#define HAIR_GUST_NODES 32   // Texels of the gust texture along each axis.
#define HAIR_GUST_LENGTHS 8  // Side of the gust texture, in integral length scales.

// Maximum cells along an axis of the coarsest level. See glsl/wind/coarse_solve.comp.
#define HAIR_FLUID_COARSEST 8
#define HAIR_FLUID_COARSEST_THREADS 256
#define HAIR_FLUID_FASTEST 1e4 // m/s. A greater speed counts as not finite.

// Wind parameters of the rod solvers.
struct hair_wind_params {
    // xyz: velocity of the wind far from all obstacles, m/s. w: standard deviation of gusts, m/s.
    hair_vec4 velocity;
    // xyz: lower corner of the fluid's box, from the head's origin, m. w: 1 / its side, 1/m. 0 if
    // there is no fluid.
    hair_vec4 box;
    hair_vec4 gust_turn; // Unit quaternion from the world to the gust texture.
    // xyz: the head's origin in the gust texture at the end of the dispatch. w: 1 / the texture's
    // side, 1/m.
    hair_vec4 gust_from;
    float     per_speed; // Reynolds number of a strand per wind speed across it, s/m.
    float     viscous;   // Drag by the air's viscosity, per mass of the strand, 1/s.
    float     shelter; // Fraction of the shelter by spheres that is applied.
    hair_uint balls;
    hair_uint sources;
    hair_uint volume; // 1 if there is a texture of velocities.
    hair_uint unused0, unused1;
    // Matrix from positions relative to the head's origin at the end of the dispatch to texture
    // coordinates.
    hair_mat4 to_volume;
    hair_vec4 ball[HAIR_WIND_BALLS];     // xyz: from the head's origin, m. w: radius, m.
    // xyz: from the head's origin at the end of the dispatch, m. w: radius, m.
    hair_vec4 source[HAIR_WIND_SOURCES];
    // xyz: unit direction. 0 if the source blows to all sides. w: speed, m/s.
    hair_vec4 jet[HAIR_WIND_SOURCES];
    // Head at the start of each substep, relative to the end of the dispatch. xyz: the head's
    // origin, m. w: time, s, below 0.
    hair_vec4 at[HAIR_STEP_SUBSTEPS];
};
HAIR_SIZE(hair_wind_params)

// Parameters of the fluid. Its box is a cube along the world's axes.
struct hair_fluid_params {
    hair_vec4 lower;    // xyz: lower corner from the head's origin, m. w: side of a cell, m.
    // xyz: movement of the box since the last step, cells. w: cells per m/s in a step, s/m.
    hair_vec4 shift;
    hair_vec4 wind;     // xyz: of the scene, m/s. w: standard deviation of gusts, m/s.
    hair_vec4 gain;     // xyz: change of the wind since the last step, m/s.
    hair_vec4 rotation; // Head rotation, unit quaternion.
    hair_vec4 gust_turn, gust_from; // Fields of hair_wind_params, at the start of the step.
    hair_uint cells;    // Along each axis.
    hair_uint colliders;   // 0 if no collider is in reach.
    hair_uint open;     // 0 if the box is closed on all sides.
    hair_uint nodes;    // Nodes of the grid of hair along each axis.
    // Length of strands in a cubic metre per mass at a grid node, 1/m^2. 0 if there is no hair.
    float     thick;
    float     per_speed; // Reynolds number of a strand per wind speed, s/m.
    float     viscous;   // Drag of strands per viscous force, times the step, m^2.
    hair_uint unused;
};
HAIR_SIZE(hair_fluid_params)

// A level of the fluid's grid, and what a pass does there. Each level has half as many cells along
// an axis as the level before it.
struct hair_fluid_level {
    hair_uint cells; // Along each axis.
    hair_uint slot, cell; // The level's first slot and cell.
    hair_uint coarse_slot, coarse_cell; // First slot and cell of the next level.
    hair_uint color;
    float     relax; // Relaxation factor.
    hair_uint unused;
};
HAIR_SIZE(hair_fluid_level)

// Velocity of a collider. At a position p it is velocity + cross(spin, p).
struct hair_fluid_motion {
    hair_vec4 velocity; // xyz: at the head's origin, m/s.
    hair_vec4 spin;     // xyz: 1/s.
};
HAIR_SIZE(hair_fluid_motion)

#endif
