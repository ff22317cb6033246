// collider_count.h - Case `many colliders` of the suite `collision`.
#ifndef HAIR_TOOLS_BENCH_COLLIDER_COUNT_H
#define HAIR_TOOLS_BENCH_COLLIDER_COUNT_H

#include "tools/bench/bench.h"

void bench_collider_count(struct bench* bench);

#endif
