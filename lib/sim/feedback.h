// feedback.h - the solver redblack by transform feedback instead of compute shaders. Tariq 2010
// runs it so under Direct3D 10. This variant serves for comparison.
#ifndef HAIR_SIM_FEEDBACK_H
#define HAIR_SIM_FEEDBACK_H

#include "lib/gl/commands.h"

struct hair_sim;

// Number of states: two that alternate, and the state of the guides, which is written last.
#define HAIR_FEEDBACK_STATES 3

// Objects of the transform feedback. All 0 unless `wanted` is set.
struct hair_feedback {
    int wanted;
    GLuint buffer[2], owner; // The two alternating states, and the guide of each vertex.
    GLuint texture[HAIR_FEEDBACK_STATES]; // Texture of each state.
    GLuint captured[HAIR_FEEDBACK_STATES]; // Transform feedback object that writes each state.
    GLuint rest_texture, guide_texture, owner_texture;
    GLuint framebuffer;
};

hair_result hair_feedback_create(struct hair_sim* sim, const struct hair_guide* guides);
void hair_feedback_free(struct hair_sim* sim);

// Run all substeps of `params`, as redblack.comp does. Do not count the strands that are reset to
// rest.
void hair_feedback_run(struct hair_sim* sim, const struct hair_step_params* params);

#endif
