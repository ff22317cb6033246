// style_grow.h - paths of the guides of each built-in haircut, from root to tip.
#ifndef HAIR_GROOM_STYLE_GROW_H
#define HAIR_GROOM_STYLE_GROW_H

#include <hair/hair_asset.h>
#include "lib/groom/style_path.h"
#include "lib/groom/style_scalp.h"

struct hair_parting hair_style_parting(hair_style style);
// Return the point of the skull around which hair turns, behind the end of the parting.
hair_vec3 hair_style_whorl(struct hair_parting parting);

// Return the number of vertices of a guide that resolves the curls of the style.
uint32_t hair_style_vertices(hair_style style);

// Grow the guide of a number, on which its curls depend. `scale` multiplies the length of the
// style.
void hair_style_grow(hair_style style, uint32_t guide, hair_vec3 root, float scale, uint32_t seed,
                     struct hair_style_path* path);

// Grow a guide that is tied up. Defined in style_tied.c.
void hair_style_grow_ponytail(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path);
void hair_style_grow_bun(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path);
void hair_style_grow_braid(hair_vec3 root, float scale, uint32_t seed, struct hair_style_path* path);

#endif
