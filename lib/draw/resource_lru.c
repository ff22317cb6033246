// resource_lru.c - release of resources that views no longer use.
#include "lib/draw/draw.h"

#define LONG 240 // Frames to keep unused resources, because toggling a setting must not reallocate.

static void free_vertex_cache(struct hair_renderer* renderer)
{
    hair_geometry_free_vertex_cache(renderer->geometry);
}

static void free_history(struct hair_renderer* renderer)
{
    hair_geometry_free_history(renderer->geometry);
}

static void free_uvs(struct hair_renderer* renderer)
{
    hair_geometry_free_uvs(renderer->geometry);
}

static void free_shaded(struct hair_renderer* renderer)
{
    hair_geometry_free_shaded(renderer->geometry);
}

static void free_fibres(struct hair_renderer* renderer)
{
    hair_lighting_free_fibres(renderer->lighting);
}

static void free_self_shadow(struct hair_renderer* renderer)
{
    hair_lighting_free_self_shadow(renderer->lighting);
}

void hair_draw_free_unused(struct hair_renderer* renderer, uint32_t frame)
{
    static void (*const release[HAIR_DRAW_PARTS])(struct hair_renderer*) = {
        [HAIR_DRAW_STRAND_LIST] = hair_draw_free_strand_list,
        [HAIR_DRAW_VERTEX_CACHE] = free_vertex_cache,
        [HAIR_DRAW_MOTION] = free_history,
        [HAIR_DRAW_SORTED_SEGMENTS] = hair_draw_free_sorted_segments,
        [HAIR_DRAW_FIBRES] = free_fibres,
        [HAIR_DRAW_UVS] = free_uvs,
        [HAIR_DRAW_SHADED] = free_shaded,
        [HAIR_DRAW_SELF_SHADOW] = free_self_shadow,
        [HAIR_DRAW_OCCLUSION] = hair_draw_free_occlusion,
        [HAIR_DRAW_RASTER] = hair_draw_free_raster,
        [HAIR_DRAW_VIEW_CACHE] = hair_draw_free_view_cache,
    };
    renderer->frame = frame;
    for (int part = 0; part < HAIR_DRAW_PARTS; ++part)
        HAIR_ASSERT(release[part] && renderer->used[part] <= frame);
    for (int part = 0; part < HAIR_DRAW_PARTS; ++part)
        if (frame - renderer->used[part] > LONG) release[part](renderer);
}

void hair_draw_use(struct hair_renderer* renderer, int part)
{
    renderer->used[part] = renderer->frame;
}

hair_result hair_draw_read_vertices(struct hair_renderer* renderer, hair_vec4** out)
{
    hair_draw_use(renderer, HAIR_DRAW_VERTEX_CACHE);
    return hair_geometry_read_vertex_cache(renderer->geometry, out);
}
