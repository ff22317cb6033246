// flicker.h - Rows of a slowly turning head, whose hair should not flicker.
#ifndef HAIR_TOOLS_BENCH_FLICKER_H
#define HAIR_TOOLS_BENCH_FLICKER_H

#include "tools/bench/bench.h"

void bench_measure_flicker(struct bench* bench);

#endif
