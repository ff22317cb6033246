// pass_time.h - GPU time of passes by the first letters of their names.
#ifndef HAIR_TOOLS_BENCH_PASS_TIME_H
#define HAIR_TOOLS_BENCH_PASS_TIME_H

#include "tools/bench/bench.h"

// Return the GPU time of the passes so far whose names begin with `prefix`, in ms. `runs` receives
// how often they ran.
double bench_sum_passes(const struct bench* bench, const char* prefix, uint32_t* runs);

#endif
