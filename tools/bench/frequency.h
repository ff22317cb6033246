// frequency.h - Frequency of an oscillation, from samples of it.
#ifndef HAIR_TOOLS_BENCH_FREQUENCY_H
#define HAIR_TOOLS_BENCH_FREQUENCY_H

#include <stdint.h>

// Return the frequency in [low, high], in rad/s, of a possibly damped oscillation. Its `count`
// samples are `dt` s apart.
double bench_frequency(const double* samples, uint32_t count, double dt, double low, double high);

#endif
