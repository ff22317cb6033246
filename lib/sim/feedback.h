// feedback.h - redblack without compute shaders: as Tariq 2010 runs it under Direct3D 10, for comparison.
#ifndef HAIR_SIM_FEEDBACK_H
#define HAIR_SIM_FEEDBACK_H

#include "lib/gl/gl.h"

struct hair_sim;

#define HAIR_FEEDBACK_STATES 3 // two in turn, and that of the guides, which is the last to be written

// All 0 unless it is asked for.
struct hair_feedback {
    int wanted;
    GLuint buffer[2], owner; // two states; the guide of each vertex
    GLuint texture[HAIR_FEEDBACK_STATES]; // of each state
    GLuint captured[HAIR_FEEDBACK_STATES]; // transform feedback into it
    GLuint rest_texture, guide_texture, owner_texture;
    GLuint framebuffer;
};

hair_result hair_feedback_make(struct hair_sim* sim, const struct hair_guide* guides);
void hair_feedback_free(struct hair_sim* sim);

// All substeps of `params`, as redblack.comp has them, but that strands put back to rest are not counted.
void hair_feedback_run(struct hair_sim* sim, const struct hair_step_params* params);

#endif
