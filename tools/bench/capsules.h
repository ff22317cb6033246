// capsules.h - Distance from a set of capsules, as the built-in head and shoulders are.
#ifndef HAIR_TOOLS_BENCH_CAPSULES_H
#define HAIR_TOOLS_BENCH_CAPSULES_H

#include <hair/hair.h>

// Return the distance from the nearest of the capsules to a point, in m, negative inside.
double bench_capsule_distance(const hair_collider* capsules, uint32_t count, const float at[3]);

#endif
