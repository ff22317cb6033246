// health.h - what shows that hair thrashes, is stretched, or gains energy that nothing gave it.
#ifndef HAIR_SIM_HEALTH_H
#define HAIR_SIM_HEALTH_H

#include <hair/hair.h>

#include "lib/gl/gl.h"

struct hair_diagnosis {
    int wanted; // hair_desc.diagnose
    int watches; // The step under way is watched.
    int goes_on; // The last one was.
    double time; // of the window under way, s
    double substep; // of the steps that were watched, s
    GLuint energy; // buffer: hair_energy per guide. 0 until it is needed.
    GLuint energy_params; // the same: hair_energy_params
    GLuint found; // the same: uint[HAIR_FOUND_COUNT]
    GLuint motion_params; // the same: hair_motion_params
};

struct hair_sim;

void hair_diagnosis_free(struct hair_sim* sim);

// Find out whether the coming step is to be watched, and make what that needs. `stirred`: something drives hair.
hair_result hair_diagnosis_need(struct hair_sim* sim, int stirred);

// Watch the energy of guides at the end of a step of so many substeps.
void hair_diagnosis_watch(struct hair_sim* sim, uint32_t substeps);

// Compare no energy of before with one of now: guides are elsewhere.
void hair_diagnosis_forget(struct hair_sim* sim);

// Fill in `health`. Waits for the GPU.
hair_result hair_sim_health(struct hair_sim* sim, hair_health* health);

#endif
