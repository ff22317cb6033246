// extent.h - Positions and sizes of a studio's content in its picture and in its shadow map.
#ifndef HAIR_TOOLS_BENCH_EXTENT_H
#define HAIR_TOOLS_BENCH_EXTENT_H

#include "tools/bench/studio.h"
#include "tools/common/camera.h"

// Compute the camera of the next draw.
void bench_extent_aim(const struct bench_studio* studio, struct hair_matrices* out);
// Shift a projection by `by` pixels of a picture of `size` pixels per side.
void bench_extent_shift(struct hair_matrices* matrices, const float by[2], uint32_t size);

// Return the pixels per metre at the camera's target, seen from `away` times the scene's distance.
float bench_extent_scale(const struct bench_studio* studio, float away);

// Return the pixels of the picture per texel of a shadow map of `size` texels per side.
float bench_extent_texel(const struct bench_studio* studio, const struct hair_matrices* camera,
                         const struct hair_matrices* light, uint32_t size);

// Return whether the shot requests a shadow map as coarse as strands are wide, and strands still
// fill its texels at `size`. The width includes the widening of strands that replace others.
bool bench_extent_fits(const struct bench_studio* studio, const struct hair_matrices* light, uint32_t size);

// Return the texels per side of the shadow map. If the shot fits the map to strands, the map is the
// smallest one whose texels strands fill. With dynamic level of detail it has no more than TEXELS
// texels per pixel.
uint32_t bench_extent_map(const struct bench_studio* studio, const struct hair_matrices* camera,
                          const struct hair_matrices* light);

// Return the bounds of everything that hair can reach in the picture. The picture has `pixels` per
// side.
struct bench_rectangle bench_extent_hair(const struct bench_studio* studio,
                                         const struct hair_matrices* camera, uint32_t pixels);

#endif
