// sleep.h - sleeping of hair that has come to rest. Sleeping hair is not simulated until an event
// wakes it.
//
// Once no event has disturbed the hair for a while, the GPU measures the activity of the guides now
// and then. Activity is the distance of guides from an earlier position, and their speed. A
// measurement is used some steps after its request, and never sooner. The time at which the GPU
// answers therefore does not matter, and hair falls asleep at the same step in every run. A GPU may
// be farther behind than that, for example when nothing that is stepped is shown. No step waits for
// such a GPU. Hair then stays awake, and is not measured again, until the answer arrives.
#ifndef HAIR_SIM_SLEEP_H
#define HAIR_SIM_SLEEP_H

#include "lib/base/pose.h"
#include "lib/gl/commands.h"

#include <stdbool.h>

// Activity of the guides.
struct hair_activity {
    float far; // Maximum measured distance of a vertex from its anchor, m.
    float speed; // Maximum measured speed of a vertex, m/s.
};

struct hair_sleep {
    int asleep;
    double quiet_time; // Simulated time since an event last disturbed the hair, s.
    double due; // Value of `quiet_time` at which guides are measured next, s.
    uint32_t samples; // Number of measurements since the last such event.
    struct hair_activity now; // Activity in the current round of measurements.
    float before; // Distance in the previous round, m. Negative if there was none.
    double since; // Value of `quiet_time` at the start of the current round, s.
    double span, span_before; // Duration of the last round and of the round before that, s.
    // State of the pending measurement. `waits` is 1 while there is one, `known` once it is
    // answered.
    int waits, known;
    struct hair_activity answer;
    uint32_t steps; // Number of steps since the request.
    double time; // Simulated time since the request, s.
    // Conditions under which guides have come to rest.
    struct hair_pose head;
    hair_physics physics;
    hair_wind wind;
    uint32_t program_generation; // Value of gl->program_generation.
    int disturbed; // 1 if any other event has disturbed the hair since the last step.
    uint32_t parity; // Alternating index of the answer, as in hair_activity_params.
    GLuint anchor, activity, readback, params; // Buffers. 0 until needed.
    const float* mapped; // Contents of `readback`.
    GLsync fence;
};

struct hair_sim;

void hair_sleep_free(struct hair_sim* sim);
// Wake the hair at the next step.
void hair_sleep_wake(struct hair_sim* sim);

// Return whether the hair sleeps through the next step. The caller then passes the time by
// hair_sim_pass_time(). No OpenGL.
bool hair_sleep_through(const struct hair_sim* sim);

// Return whether an event has disturbed the hair since the last step.
bool hair_sleep_is_disturbed(const struct hair_sim* sim);
// Create what watching a step of `dt` needs.
hair_result hair_sleep_ensure(struct hair_sim* sim, int disturbed, double dt);
// Update the sleep state after a step of `dt`. Use a pending measurement and request the next when
// due.
void hair_sleep_submit_query(struct hair_sim* sim, int disturbed, double dt);

// Restart the quiet time if an event has disturbed the hair since the last step.
void hair_sleep_settle(struct hair_sim* sim);
// Settle the sleep state before a save. Wait for a pending measurement. Discard it if an event has
// disturbed the hair since the last step.
void hair_sleep_resolve_query(struct hair_sim* sim);
// Compare a loaded state with the current conditions from now on. `was` is the replaced state.
void hair_sleep_load(struct hair_sim* sim, const struct hair_sleep* was);
// Create the programs and buffers of measurements.
hair_result hair_sleep_create(struct hair_sim* sim);

#endif
