// strand_light.h - Fraction of a distant light that reaches each vertex of strands past other
// strands. One method counts rays. Others emulate GPU methods on the CPU.
#ifndef HAIR_TOOLS_BENCH_STRAND_LIGHT_H
#define HAIR_TOOLS_BENCH_STRAND_LIGHT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Strands of `each` vertices and one radius in m, in the light's view space. x and y are
// perpendicular to the light, z points towards it.
struct bench_strands {
    float* seen; // xyz
    uint32_t count, each;
    float radius;
    float lower[3], upper[3];
};

// Transform strands to the light's view space. Return false if memory runs out. Free the strands in
// either case.
bool bench_strands_make(const float* positions, uint32_t count, uint32_t each, float radius,
                        const float to_light[3], struct bench_strands* out);
void bench_strands_free(struct bench_strands* strands);

// Compute the fraction of light that reaches each vertex, by `rays` rays per vertex. Rays start on
// the strand within half a segment of the vertex. `seed` selects the rays. `out` has one number per
// vertex. Return false if memory runs out.
bool bench_light_by_rays(const struct bench_strands* strands, uint32_t rays, uint32_t seed, float* out);

// Compute the same fractions by a deep opacity map of `layers` layers. Each layer is `deeper` times
// as deep as the previous one. The taps are those of light/shadow.glsl.
bool bench_light_by_layers(const struct bench_strands* strands, float texel, uint32_t layers, float first,
                           float deeper, float* out);

#endif
