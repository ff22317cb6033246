// field_error.c - Error of a field against the exact distance to one collider.
#include "tools/bench/field_error.h"
#include "lib/collide/distance.h"

#include <math.h>

// Voxels on either side of a surface where an interpolated value has all its neighbours.
#define BAND 3

static uint32_t random_of(uint32_t* seed)
{
    *seed = *seed * 747796405u + 2891336453u;
    return (*seed >> 8) ^ (*seed >> 21);
}

double bench_field_random(uint32_t* seed, double min, double max)
{
    return min + (max - min) * (random_of(seed) % 65536) / 65535;
}

// Interpolate as OpenGL's linear filter does.
static double interpolate(const hair_field_info* info, const float* texels, const double at[3])
{
    const uint32_t* size = info->size;
    uint32_t low[3];
    double t[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
        double x = fmin(fmax(at[k] - 0.5, 0), (double)size[k] - 1.001);
        low[k] = (uint32_t)x;
        t[k] = x - low[k];
    }
    for (uint32_t corner = 0; corner < 8; ++corner) {
        uint32_t x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        double fraction = (x ? t[0] : 1 - t[0]) * (y ? t[1] : 1 - t[1]) * (z ? t[2] : 1 - t[2]);
        size_t texel = ((size_t)(low[2] + z) * size[1] + low[1] + y) * size[0] + low[0] + x;
        sum += fraction * (double)texels[texel];
    }
    return sum;
}

void bench_field_measure(const hair_field_info* info, const float* texels, const hair_collider* exact,
                         uint32_t points, struct bench_field_error* out)
{
    double voxel = (double)info->voxel;
    uint32_t seed = 1;
    *out = (struct bench_field_error){0};
    for (uint32_t i = 0; i < points; ++i) {
        double at[3], point[3];
        int centre = i % 2; // Every other point is the middle of a voxel.
        for (int k = 0; k < 3; ++k) {
            at[k] = bench_field_random(&seed, 0.5, (double)info->size[k] - 0.5) +
                    bench_field_random(&seed, -2e-5, 2e-5) * info->size[k];
            if (centre) at[k] = floor(at[k]) + 0.5;
            at[k] = fmin(fmax(at[k], 0.5), (double)info->size[k] - 0.5);
            // The head is at the origin, therefore the transform is a scale and a translation.
            point[k] =
                (at[k] / info->size[k] - (double)info->transform[12 + k]) / (double)info->transform[5 * k];
        }
        double right = hair_distance_to_collider(exact, point, NULL);
        if (fabs(right) > BAND * voxel) continue;
        double found = interpolate(info, texels, at), off = fabs(found - right) / voxel;
        if (centre) out->centre = fmax(out->centre, off);
        out->max = fmax(out->max, off);
        out->square += off * off;
        out->wrong += fabs(right) > voxel && (right < 0) != (found < 0);
        ++out->points;
    }
}
