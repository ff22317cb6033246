// solid.h - the bodies hair collides with, as the application gives them: checked, and paired with where they were.
#ifndef HAIR_COLLIDE_SOLID_H
#define HAIR_COLLIDE_SOLID_H

#include "lib/base/host.h"
#include "lib/base/pose.h"
#include "glsl/shared.h"

#define HAIR_MOST_SOLIDS 1048576u // of one instance

// Holds the forms of its solids.
struct hair_solid_list {
    hair_solid* solid;
    uint32_t count, capacity;
};

struct hair_solids {
    struct hair_solid_list now, before; // before: at the last step; it has room for as many as there are now
    uint32_t* pair; // of each now: its place in before, or HAIR_UNPAIRED
    uint32_t capacity; // of pair
    uint32_t capsules; // what hair_solids_capsules will return,
    uint32_t bodies; // and what hair_solids_bodies will
    uint32_t contacts; // all but forms without their mesh,
    uint32_t forms; // and the forms among them
    int changed; // since `before` was
};

#define HAIR_UNPAIRED UINT32_MAX

// Take `count` solids, each `stride` bytes from the next. On failure nothing has changed.
hair_result hair_solids_set(const hair_host* host, struct hair_solids* solids, const hair_solid* from,
                            uint32_t count, size_t stride);

// The same of both lists at once, of solids that were saved: a form may be missing, and then its solid touches nothing.
hair_result hair_solids_restore(const hair_host* host, struct hair_solids* solids, const hair_solid* now,
                                uint32_t count, const hair_solid* before, uint32_t count_before);
void hair_solids_free(const hair_host* host, struct hair_solids* solids);

// Where the i-th was at the last step: itself where it was not there.
const hair_solid* hair_solids_before(const struct hair_solids* solids, uint32_t i);

// The spheres and capsules, from where the head was to where it is: the HAIR_STEP_SOLIDS nearest to it, in their
// order. Returns how many.
uint32_t hair_solids_capsules(const struct hair_solids* solids, const struct hair_pose* head_before,
                              const struct hair_pose* head_now, struct hair_capsule out[HAIR_STEP_SOLIDS]);

// The same of all solids but forms: a capsule around each, and the solid itself.
uint32_t hair_solids_bodies(const struct hair_solids* solids, const struct hair_pose* head_before,
                            const struct hair_pose* head_now, struct hair_capsule around[HAIR_STEP_SOLIDS],
                            struct hair_body out[HAIR_STEP_SOLIDS]);

// The same of the i-th, which may be a form with its mesh. Where the form's nodes are is left open.
struct hair_contact hair_solids_contact(const struct hair_solids* solids, uint32_t i,
                                        const struct hair_pose* head_before,
                                        const struct hair_pose* head_now);

// In its own axes, without rounding: the middle of the box around it, and from there half its sides.
void hair_solid_extent(const hair_solid* solid, hair_vec3* middle, hair_vec3* half);

// The step is over: now becomes before.
void hair_solids_settle(struct hair_solids* solids);

// Where they were says nothing about how they move.
void hair_solids_forget(struct hair_solids* solids);

#endif
