// style_grow.h - how the guides of each built-in haircut run from root to tip.
#ifndef HAIR_GROOM_STYLE_GROW_H
#define HAIR_GROOM_STYLE_GROW_H

#include <hair/hair_asset.h>
#include "lib/groom/style_course.h"
#include "lib/groom/style_scalp.h"

struct hair_parting hair_style_parting(hair_style style);

// Vertices of a guide that show the style's curls.
uint32_t hair_style_vertices(hair_style style);

// `scale`: of the style's own length.
void hair_style_grow(hair_style style, hair_vec3 root, float scale, uint32_t seed,
                     struct hair_course* course);

// One of them, in its own file.
void hair_style_grow_ponytail(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course);

#endif
