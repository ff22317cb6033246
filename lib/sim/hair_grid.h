// hair_grid.h - hair-hair interaction by a grid that moves with the head. The grid gathers mass,
// momentum and volume of all guides. Every guide vertex gets an acceleration from the grid.
//
// The grid holds integers, so that the order in which threads add does not matter. Time is divided
// into blocks of substeps, counted from the last reset. The grid is filled at the start of a block,
// and its accelerations last for the block.
#ifndef HAIR_SIM_HAIR_GRID_H
#define HAIR_SIM_HAIR_GRID_H

#include "lib/base/math.h"
#include "lib/gl/commands.h"

#include <stdbool.h>

// Total mass of all vertices, in the grid's units of mass, and their total volume, in its units of
// volume. Rounding adds at most half a unit per vertex, and there are at most 2^26 vertices. No sum
// exceeds 32 bits, even if all hair is at one node. The unit of
// momentum is the unit of mass times HAIR_GRID_SPEED. No vertex counts as faster than that speed.
#define HAIR_GRID_UNITS 1073741824.0

// The hair-hair grid. All 0 until hair first has cohesion or volume.
struct hair_grid {
    // Buffers, as in shared.h, and the texture of `acceleration`.
    GLuint params, grid, splat, order, rest_density, node_motion, acceleration, texture;
    hair_vec3 lower; // Position of node 0 in the head's frame, m.
    float cell; // Distance between nodes, m.
    double metres; // Total length of all guides, m.
    uint32_t nodes[3]; // Number of nodes along each axis.
    uint32_t substeps_done; // Number of substeps done in the current block.
};

struct hair_sim;

// hair_grid_rest.c --------------------------------------------------------------------------------

// Place the grid, and upload all that depends on the groom at rest.
hair_result hair_grid_make_rest(struct hair_sim* sim, const struct hair_guide* guides,
                                const struct hair_rest* rest);
uint32_t hair_grid_count_nodes(const struct hair_grid* hair_grid);
// Create the contributions of guide vertices to a grid of mass alone, a buffer of
// hair_grid_splat[] that counts as memory of the wind, and the order in which they are added. Set
// *metres to the length of guides per unit of mass, m.
hair_result hair_grid_weigh(struct hair_sim* sim, GLuint* splat, GLuint* order, double* metres);

// hair_grid.c -------------------------------------------------------------------------------------

// Make the grid if it is on and has not been made.
hair_result hair_grid_create(struct hair_sim* sim, const struct hair_guide* guides,
                             const struct hair_rest* rest);
// Make the hair-hair grid if the physics have cohesion or volume.
hair_result hair_sim_ensure_hair_grid(struct hair_sim* sim);
// Free what depends on the lengths of guides, which the next step makes again. The accelerations
// stay.
void hair_grid_free_weights(struct hair_sim* sim);
void hair_grid_free(struct hair_sim* sim);

// Return whether the grid is on and a block starts with the next substep.
bool hair_grid_is_due(const struct hair_sim* sim);
// Start a block: find its accelerations from the current state.
void hair_grid_update(struct hair_sim* sim);
// Let the next substep start a block.
void hair_grid_reset(struct hair_sim* sim);
// Return the number of substeps left in the current block, or in the block that is due.
uint32_t hair_grid_substeps_left(const struct hair_sim* sim);
// Bind the accelerations for the solver.
void hair_grid_bind(struct hair_sim* sim);
// Count substeps as done.
void hair_grid_count(struct hair_sim* sim, uint32_t substeps);

#endif
