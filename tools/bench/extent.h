// extent.h - where what a studio shows is in its picture and in its shadow map, and how large.
#ifndef HAIR_TOOLS_BENCH_EXTENT_H
#define HAIR_TOOLS_BENCH_EXTENT_H

#include "tools/bench/studio.h"
#include "tools/common/camera.h"

// The camera of what is drawn next; and by how many pixels what a picture of such a size shows moves.
void bench_extent_aim(const struct bench_studio* studio, struct hair_matrices* out);
void bench_extent_shift(struct hair_matrices* matrices, const float by[2], uint32_t size);

// Pixels to a metre where the scene's camera looks, from so many times its distance.
float bench_extent_scale(const struct bench_studio* studio, float away);

// Pixels of the picture to a texel of a shadow map of such a size.
float bench_extent_texel(const struct bench_studio* studio, const struct hair_matrices* camera,
                         const struct hair_matrices* light, uint32_t size);

// Whether the shadow map is to be as coarse as strands are wide, those that make up for others too, and at that size they
// still fill its texels.
bool bench_extent_fits(const struct bench_studio* studio, const struct hair_matrices* light, uint32_t size);

// Texels to a side of the shadow map: no more than strands fill, where it fits them; where the picture has levels of detail, no
// more than that needs.
uint32_t bench_extent_map(const struct bench_studio* studio, const struct hair_matrices* camera,
                          const struct hair_matrices* light);

// Around all that hair can reach. `pixels` to each side of the picture.
struct bench_rectangle bench_extent_hair(const struct bench_studio* studio,
                                         const struct hair_matrices* camera, uint32_t pixels);

#endif
