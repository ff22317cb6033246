// crowd_space.h - The space that the strands of a crowd fill, and the side of the head they are on.
#ifndef HAIR_TOOLS_BENCH_CROWD_SPACE_H
#define HAIR_TOOLS_BENCH_CROWD_SPACE_H

#include "tools/bench/crowd.h"

// Return the volume of the cubes of 1 cm that have a vertex, m^3. Return 0 if memory runs out.
double bench_crowd_measure_volume(const struct crowd* crowd, const float* strands);
// Return the number of strands that pass the middle plane of the head by more than `depth`, away
// from the side of their roots.
uint32_t bench_crowd_count_crossed(const struct crowd* crowd, const float* strands, double depth);

#endif
