// scatter.h - Rows of multiple scattering against path tracing.
#ifndef HAIR_TOOLS_BENCH_SCATTER_H
#define HAIR_TOOLS_BENCH_SCATTER_H

#include "tools/bench/bench.h"

void bench_measure_scatter(struct bench* bench);

#endif
