// blow.h - air that flows round solids, as guides need it: the fluid in steps that are counted in substeps.
//
// Time goes in blocks of substeps, counted from the last reset, as it does for the crowd: at a block's start the fluid makes
// one step as long as the block, and the air is then as it is for all of it. So motion does not depend on the frame rate.
#ifndef HAIR_SIM_BLOW_H
#define HAIR_SIM_BLOW_H

#include "lib/wind/fluid.h"

struct hair_blow {
    const struct hair_solid_field* field; // of the instance, brought up to date before every step
    struct hair_fluid fluid; // there is none unless the wind is one
    uint32_t beat; // substeps done of the block under way
    // Of the grid of hair, where the fluid knows of it.
    GLuint share, params; // buffers, as the crowd's
    double metres; // of guides that a unit of mass is
};

struct hair_sim;

int hair_blow_is_on(const struct hair_sim* sim);
hair_result hair_blow_need_programs(struct hair_sim* sim);
hair_result hair_blow_need(struct hair_sim* sim); // what the wind takes; what it no longer does is let go
void hair_blow_free(struct hair_sim* sim);
void hair_blow_forget(struct hair_sim* sim); // the air's past: it is the wind again

// How many substeps the block under way still has, in a step of `dt`. At its start: step the fluid first.
uint32_t hair_blow_left(struct hair_sim* sim, double dt);
void hair_blow_count(struct hair_sim* sim, uint32_t substeps);

// Where the fluid's box is from the head's origin as the last substep left it: its corner, m, and 1 / its side, 1/m.
hair_vec4 hair_blow_box(const struct hair_sim* sim);

#endif
