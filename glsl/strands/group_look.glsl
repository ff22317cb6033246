// group_look.glsl - factors by which the looks of groups of strands differ from the instance's.
#ifndef HAIR_GROUP_LOOK_GLSL
#define HAIR_GROUP_LOOK_GLSL

#include "shared.h"

#ifdef HAIR_GROUP_LOOKS
// lavapipe of Mesa 22.3 overwrites its stack when a branch depends only on the third uniform block
// of a stage. Mesa orders blocks by hashes of their names, and with this name draw_buffer is not
// the third.
layout(std140, binding = HAIR_BIND_GROUP_LOOKS) uniform look_factor_buffer {
    hair_group_factors group_look[HAIR_STRAND_GROUPS];
};

// Return the group of a follower, which is in the last bits of its radius.
uint group_of(hair_follower follower)
{
    return floatBitsToUint(follower.offset[0].w) & uint(HAIR_STRAND_GROUPS - 1);
}
#define GROUP_FACTOR(group, member) group_look[group].member

// Guides have smaller numbers than these bits.
#define GROUP_SHIFT 29
uint pack_lock(hair_follower follower) { return follower.guide0 | group_of(follower) << GROUP_SHIFT; }
uint lock_of(uint number) { return number & (1u << GROUP_SHIFT) - 1u; }
uint group_of_lock(uint number) { return number >> GROUP_SHIFT; }
#else
uint group_of(hair_follower follower) { return 0u; }
#define GROUP_FACTOR(group, member) 1.0

uint pack_lock(hair_follower follower) { return follower.guide0; }
uint lock_of(uint number) { return number; }
uint group_of_lock(uint number) { return 0u; }
#endif

#endif
