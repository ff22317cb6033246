// resource_lru.c - release of resources that views no longer use.
#include "lib/draw/draw.h"

#define LONG 240 // Frames to keep unused resources, because toggling a setting must not reallocate.

void hair_draw_free_unused(struct hair_draw* draw, uint32_t frame)
{
    static void (*const release[HAIR_DRAW_PARTS])(struct hair_draw*) = {
        [HAIR_DRAW_STRAND_LIST] = hair_draw_free_strand_list,
        [HAIR_DRAW_VERTEX_CACHE] = hair_draw_free_vertex_cache,
        [HAIR_DRAW_MOTION] = hair_draw_free_motion,
        [HAIR_DRAW_SORTED_SEGMENTS] = hair_draw_free_sorted_segments,
        [HAIR_DRAW_FIBRES] = hair_draw_free_fibres,
        [HAIR_DRAW_UVS] = hair_draw_free_uvs,
        [HAIR_DRAW_SHADED] = hair_draw_free_shaded,
        [HAIR_DRAW_SELF_SHADOW] = hair_draw_free_self_shadow,
        [HAIR_DRAW_OCCLUSION] = hair_draw_free_occlusion,
        [HAIR_DRAW_RASTER] = hair_draw_free_raster,
        [HAIR_DRAW_VIEW_CACHE] = hair_draw_free_view_cache,
    };
    draw->frame = frame;
    for (int part = 0; part < HAIR_DRAW_PARTS; ++part)
        HAIR_ASSERT(release[part] && draw->used[part] <= frame);
    for (int part = 0; part < HAIR_DRAW_PARTS; ++part)
        if (frame - draw->used[part] > LONG) release[part](draw);
}
