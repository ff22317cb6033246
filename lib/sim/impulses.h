// impulses.h - impulses between hair and colliders, for the application.
//
// Programs with HAIR_IMPULSES add up the impulses of every guide vertex. At the end of a step a
// pass sums them by collider, and the GPU copies the sums to memory of the CPU. They are read once
// the GPU is done. No step waits for the sums unless SLOTS earlier steps are not done.
#ifndef HAIR_SIM_IMPULSES_H
#define HAIR_SIM_IMPULSES_H

#include <hair/hair.h>

#include "lib/gl/commands.h"

#include <stdbool.h>

#define HAIR_IMPULSE_SLOTS 8 // Steps whose sums may be on their way.

struct hair_sim;

// Collider of the solver in a step.
struct hair_impulse_collider {
    uint64_t key;
    uint32_t collider; // Index in the list of the application.
    float position[3]; // m.
};

// A step whose sums are on their way.
struct hair_impulse_slot {
    GLsync fence; // NULL if the slot is free.
    struct hair_impulse_collider* collider;
    uint32_t count, room;
    double head[3]; // Origin of the head, m.
    double scale; // Impulse by unit of the sums, N s.
};

// Impulses of hair on a collider, since the application has last asked.
struct hair_impulse {
    uint64_t key;
    uint32_t collider, vertices;
    double impulse[3], moment[3], normal[3], place[3], size;
};

struct hair_impulses {
    double strands; // Strands whose mass each guide has. 0 disables the record.
    GLuint record, texture; // Impulses of guide vertices. 0 until needed.
    GLuint sum, readback; // Sums by collider, and their copies, one slot after the other.
    const unsigned char* mapped; // Contents of `readback`.
    uint32_t room; // Number of colliders that fit into `sum`.
    struct hair_impulse_slot slot[HAIR_IMPULSE_SLOTS];
    uint32_t first, used; // Oldest used slot, and number of used slots.
    struct hair_impulse* total;
    uint32_t totals, total_room;
    uint32_t merged; // Number of totals after the last merge.
};

// Return whether the coming step records impulses.
bool hair_impulses_are_on(const struct hair_sim* sim);
// Record impulses of guides that each have the mass of `strands` strands. 0 stops the record, and
// drops what has been recorded. [GL]
void hair_impulses_set(struct hair_sim* sim, double strands);
// Ensure everything that recording in a step needs, once the contacts of the step are known.
hair_result hair_impulses_ensure(struct hair_sim* sim);
// Bind the record for the solvers.
void hair_impulses_bind(struct hair_sim* sim);
// Order what a dispatch has recorded before the next one.
void hair_impulses_end_dispatch(struct hair_sim* sim);
// Sum up the record at the end of a step. Never fails.
void hair_impulses_end_step(struct hair_sim* sim);
// Add the sums of finished steps to the totals, and merge them by collider. `waits` waits for all
// steps.
hair_result hair_impulses_collect(struct hair_sim* sim, bool waits);
void hair_impulses_free(struct hair_sim* sim);

#endif
