// turn.h - rows of a head that turns slowly: how much its hair flickers.
#ifndef HAIR_TOOLS_BENCH_TURN_H
#define HAIR_TOOLS_BENCH_TURN_H

#include "tools/bench/bench.h"

void bench_measure_turn(struct bench* bench);

#endif
