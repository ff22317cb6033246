// solver_stats.h - diagnosis of hair that thrashes, is stretched, or gains energy without a source.
#ifndef HAIR_SIM_SOLVER_STATS_H
#define HAIR_SIM_SOLVER_STATS_H

#include <hair/hair.h>

#include "lib/gl/commands.h"

struct hair_diagnosis {
    int wanted; // hair_desc.diagnose
    int watches; // 1 if the current step is watched.
    int goes_on; // 1 if the last step was watched.
    double time; // Elapsed time of the current window, s.
    double substep; // Substep length of the watched steps, s.
    GLuint energy; // Buffer of hair_energy per guide. 0 until needed.
    GLuint energy_params; // Buffer of hair_energy_params. 0 until needed.
    GLuint found; // Buffer of uint[HAIR_FOUND_COUNT]. 0 until needed.
    GLuint motion_params; // Buffer of hair_motion_params. 0 until needed.
};

struct hair_sim;

void hair_diagnosis_free(struct hair_sim* sim);

// Decide whether to watch the coming step, and create what watching needs. `disturbed` is 1 if
// something drives the hair.
hair_result hair_diagnosis_ensure(struct hair_sim* sim, int disturbed);

// Watch the energy of guides at the end of a step. The step had `substeps` substeps.
void hair_diagnosis_watch(struct hair_sim* sim, uint32_t substeps);

// Discard earlier energies, because the guides have been moved.
void hair_diagnosis_reset(struct hair_sim* sim);

// Fill in `solver_stats`. Wait for the GPU.
hair_result hair_sim_solver_stats(struct hair_sim* sim, hair_solver_stats* solver_stats);

#endif
