// lod_color.h - Rows of the suite `lod`, the colour of thinned and of distant hair.
#ifndef HAIR_TOOLS_BENCH_LOD_COLOR_H
#define HAIR_TOOLS_BENCH_LOD_COLOR_H

#include "tools/bench/bench.h"

void bench_measure_lod_color(struct bench* bench);

#endif
