// field_error.h - Error of a field against the exact distance to one collider, and the random
// numbers of suite `field`.
#ifndef HAIR_TOOLS_BENCH_FIELD_ERROR_H
#define HAIR_TOOLS_BENCH_FIELD_ERROR_H

#include <hair/hair.h>

struct bench_field_error {
    double max, square, centre; // in voxels
    uint64_t points, wrong; // `wrong` counts wrong signs farther than a voxel from the surface
};

// Return a random number between `min` and `max`.
double bench_field_random(uint32_t* seed, double min, double max);

// Compare the texels of a field with the exact distance to `exact`, the ideal shape of the
// collider, at up to `points` points near the surface.
void bench_field_measure(const hair_field_info* info, const float* texels, const hair_collider* exact,
                         uint32_t points, struct bench_field_error* out);

#endif
