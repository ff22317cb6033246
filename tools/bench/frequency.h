// frequency.h - how fast something swings, from samples of it.
#ifndef HAIR_TOOLS_BENCH_FREQUENCY_H
#define HAIR_TOOLS_BENCH_FREQUENCY_H

#include <stdint.h>

// The frequency in [low, high], rad/s, of `count` samples at distances `dt`, s, of a swing that may die away.
double bench_frequency(const double* samples, uint32_t count, double dt, double low, double high);

#endif
