// wind_coupling.h - wind coupling of the guides: a fluid wind that flows around colliders.
//
// Time is divided into blocks of substeps, counted from the last reset, as for the hair-hair grid.
// The fluid makes one step as long as the block at the block's start, and then stays constant for
// the block. Motion therefore does not depend on the frame rate.
#ifndef HAIR_SIM_WIND_COUPLING_H
#define HAIR_SIM_WIND_COUPLING_H

#include "lib/wind/fluid.h"

#include <stdbool.h>

struct hair_wind_coupling {
    // Distance field of the instance, updated before every step.
    const struct hair_collider_field* field;
    struct hair_fluid fluid; // Exists from the first to the last step in which the wind is a fluid.
    uint32_t substeps_done; // Number of substeps done in the current block.
    // Buffers of the grid of hair in the fluid, as in hair_grid. 0 if the fluid ignores hair.
    GLuint splat, order, params;
    double metres; // Length of guides per unit of mass, m.
};

struct hair_sim;

bool hair_wind_coupling_is_on(const struct hair_sim* sim);
hair_result hair_wind_coupling_ensure_programs(struct hair_sim* sim);
// Create what the wind needs. If the wind needs another fluid, create the fluid in `other`.
// Otherwise other->gl is NULL. The present fluid keeps its past.
hair_result hair_wind_coupling_prepare(struct hair_sim* sim, struct hair_fluid* other);
// Use a prepared fluid, if there is one. The caller destroys the fluid that was used before.
void hair_wind_coupling_replace(struct hair_wind_coupling* wind_coupling, const struct hair_fluid* other);
// Create what the wind needs, and replace a fluid of another size together with its past. On
// failure the fluid is as it was.
hair_result hair_wind_coupling_ensure(struct hair_sim* sim);
// Free what depends on the lengths of guides, which the next step makes again.
void hair_wind_coupling_free_hair(struct hair_sim* sim);
void hair_wind_coupling_free(struct hair_sim* sim);
// Discard the fluid's past. The fluid starts again from the wind.
void hair_wind_coupling_reset(struct hair_sim* sim);

// Return whether the fluid is on and a block starts with the next substep.
bool hair_wind_coupling_is_due(const struct hair_sim* sim);
// Start a block: step the fluid by the length of the block, within a step of `dt`.
void hair_wind_coupling_update(struct hair_sim* sim, double dt);
// Return the number of substeps left in the current block, or in the block that is due.
uint32_t hair_wind_coupling_substeps_left(const struct hair_sim* sim);
// Count substeps as done.
void hair_wind_coupling_count(struct hair_sim* sim, uint32_t substeps);

// Return the fluid's box. xyz is its corner from the head's origin after the last substep, m. w is
// 1 / its side, 1/m.
hair_vec4 hair_wind_coupling_box(const struct hair_sim* sim);

#endif
