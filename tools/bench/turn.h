// turn.h - Rows of a slowly turning head, whose hair should not flicker.
#ifndef HAIR_TOOLS_BENCH_TURN_H
#define HAIR_TOOLS_BENCH_TURN_H

#include "tools/bench/bench.h"

void bench_measure_turn(struct bench* bench);

#endif
