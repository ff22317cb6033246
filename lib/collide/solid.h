// solid.h - the bodies hair collides with, as the application gives them: checked, and paired with where they were.
#ifndef HAIR_COLLIDE_SOLID_H
#define HAIR_COLLIDE_SOLID_H

#include "lib/base/host.h"
#include "lib/base/pose.h"
#include "glsl/shared.h"

struct hair_solids {
    hair_solid now[HAIR_MAX_SOLIDS], before[HAIR_MAX_SOLIDS]; // before: at the last step
    uint32_t   count;
    uint32_t   count_before;
};

// Take `count` solids, each `stride` bytes from the next. On failure nothing has changed.
hair_result hair_solids_set(const hair_host* host, struct hair_solids* solids, const hair_solid* from,
                            uint32_t count, size_t stride);

// As capsules from where the head was to where it is. Returns how many.
uint32_t hair_solids_capsules(const struct hair_solids* solids, const struct hair_pose* head_before,
                              const struct hair_pose* head_now, struct hair_capsule out[HAIR_MAX_SOLIDS]);

// The step is over: now becomes before.
void hair_solids_settle(struct hair_solids* solids);

#endif
