// many.h - Case `many colliders` of the suite `collision`.
#ifndef HAIR_TOOLS_BENCH_MANY_H
#define HAIR_TOOLS_BENCH_MANY_H

#include "tools/bench/bench.h"

void bench_many_colliders(struct bench* bench);

#endif
