// strand_light.h - how much of a far light reaches each vertex of strands past the others: counted ray by ray, and as
// methods that draw would find it, worked out by the processor.
#ifndef HAIR_TOOLS_BENCH_STRAND_LIGHT_H
#define HAIR_TOOLS_BENCH_STRAND_LIGHT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Strands of `each` vertices and of one radius, m. Vertices are seen from the light: x and y across its light, z towards it.
struct bench_strands {
    float* seen; // xyz
    uint32_t count, each;
    float radius;
    float lower[3], upper[3];
};

// False: out of memory. To be freed in either case.
bool bench_strands_make(const float* positions, uint32_t count, uint32_t each, float radius,
                        const float to_light[3], struct bench_strands* out);
void bench_strands_free(struct bench_strands* strands);

// `out` has room for a number per vertex: the share of light that meets no other strand. False: out of memory.

// Of `rays` rays from the strand within half a segment of the vertex, the share that meet no other. `seed`: which rays.
bool bench_light_by_rays(const struct bench_strands* strands, uint32_t rays, uint32_t seed, float* out);

// By a deep opacity map of so many layers, each `deeper` times as deep as the one before, and taps as those of shadow.glsl.
bool bench_light_by_layers(const struct bench_strands* strands, float texel, uint32_t layers, float first,
                           float deeper, float* out);

#endif
