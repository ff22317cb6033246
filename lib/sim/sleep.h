// sleep.h - hair that has come to rest sleeps: nothing of it is simulated until something stirs it.
//
// Once nothing has stirred hair for a while, guides are looked at now and then: how far they are from where they were, and
// how fast. The answer is used some steps after it was asked for, and never sooner, so that it does not matter when the GPU
// gave it: hair sleeps at the same step in every run. A GPU that is farther behind than that, as it may be when nobody
// shows what is stepped, is not waited for either: hair stays awake until the answer is there, and is not looked at
// again before.
#ifndef HAIR_SIM_SLEEP_H
#define HAIR_SIM_SLEEP_H

#include "lib/base/pose.h"
#include "lib/gl/gl.h"

// What the guides do.
struct hair_stirring {
    float far; // from where they were, m: the most that one has been seen to be
    float speed; // m/s, likewise
};

struct hair_sleep {
    int asleep;
    double calm; // s: simulated since something last stirred hair
    double due; // at which `calm` guides are looked at next
    uint32_t looks; // since then
    struct hair_stirring now; // of this round of looks,
    float before; // how far in the one before, m; or below 0
    double since; // `calm` when the round under way began,
    double span, span_before; // s: how long the last took, and the one before it
    // A look that is under way.
    int waits, known; // and that it has been answered:
    struct hair_stirring answer;
    uint32_t steps; // since it was asked for
    double time; // s, likewise
    // What guides have come to rest under.
    struct hair_pose head;
    hair_physics physics;
    hair_wind wind;
    uint32_t made; // gl->made
    int stirred; // by what is none of these
    uint32_t turn; // as in hair_stir_params
    GLuint anchor, stir, seen, params; // buffers; 0 until they are needed
    const float* mapped; // what is in `seen`
    GLsync fence;
};

struct hair_sim;

void hair_sleep_free(struct hair_sim* sim);
void hair_sleep_stir(struct hair_sim* sim); // something has

// Whether a step of `dt` is slept through, which then it has been. No OpenGL.
int hair_sleep_through(struct hair_sim* sim, double dt);

// Whether something has stirred hair since the last step; what a step of `dt` then takes; and after it, whether it was.
int hair_sleep_is_stirred(const struct hair_sim* sim);
hair_result hair_sleep_need(struct hair_sim* sim, int stirred, double dt);
void hair_sleep_watch(struct hair_sim* sim, int stirred, double dt);

// For what is saved: the answer is known, nothing has stirred hair since the last step or there is nothing to tell. Waits.
void hair_sleep_settle(struct hair_sim* sim);
// What is loaded is to be compared with how things are here. `was`: what there was before.
void hair_sleep_load(struct hair_sim* sim, const struct hair_sleep* was);
hair_result hair_sleep_make(struct hair_sim* sim);

#endif
