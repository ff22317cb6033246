// tidy.c - release of resources that views no longer use.
#include "lib/draw/draw.h"

#define LONG 240 // Frames to keep unused resources, because toggling a setting must not reallocate.

void hair_draw_tidy(struct hair_draw* draw, uint32_t frame)
{
    static void (*const release[HAIR_DRAW_PARTS])(struct hair_draw*) = {
        [HAIR_DRAW_LISTED] = hair_draw_free_listed, [HAIR_DRAW_EXPANDED] = hair_draw_free_expanded,
        [HAIR_DRAW_MOTION] = hair_draw_free_motion, [HAIR_DRAW_SORTED] = hair_draw_free_sorted,
        [HAIR_DRAW_FIBRES] = hair_draw_free_fibres, [HAIR_DRAW_UVS] = hair_draw_free_uvs,
        [HAIR_DRAW_SHADED] = hair_draw_free_shaded, [HAIR_DRAW_SELF_SHADOW] = hair_draw_free_self_shadow,
        [HAIR_DRAW_HIDDEN] = hair_draw_free_hidden, [HAIR_DRAW_RASTER] = hair_draw_free_raster,
        [HAIR_DRAW_STAGED] = hair_draw_free_staged,
    };
    draw->frame = frame;
    for (int part = 0; part < HAIR_DRAW_PARTS; ++part)
        HAIR_ASSERT(release[part] && draw->used[part] <= frame);
    for (int part = 0; part < HAIR_DRAW_PARTS; ++part)
        if (frame - draw->used[part] > LONG) release[part](draw);
}
