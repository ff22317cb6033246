// guide_level.h - the level of detail of guides: small hair simulates some of them, and derives the
// others.
#ifndef HAIR_SIM_GUIDE_LEVEL_H
#define HAIR_SIM_GUIDE_LEVEL_H

#include "glsl/shared.h"
#include "lib/gl/gl.h"

struct hair_sim;

struct hair_guide_level {
    uint32_t wanted; // Stride for hair that may have one: 1, 2, 4 or HAIR_MAX_GUIDE_STRIDE.
    uint32_t last; // Stride of the last dispatch. 0 before the first.
};

// Return the stride of the next dispatch. The stride is 1 for hair that hair_lod.guide_pixels
// excepts.
uint32_t hair_guide_stride(const struct hair_sim* sim);
// Return the number of guides that the next dispatch simulates.
uint32_t hair_guide_simulated(const struct hair_sim* sim);
// Write the level of a dispatch that lasts `time` seconds.
void hair_guide_level_write(const struct hair_sim* sim, struct hair_step_params* params, double time);
// Compile the programs that derive guides.
hair_result hair_guide_level_ensure_programs(struct hair_sim* sim);
// Compile the programs that derive guides, if the next dispatch derives any.
hair_result hair_guide_level_ensure(struct hair_sim* sim);
// Note the shapes of derived guides if the level changes, before the solver runs.
void hair_guide_level_begin(struct hair_sim* sim);
// Derive the guides that the solver has left out.
void hair_guide_level_end(struct hair_sim* sim);

#endif
