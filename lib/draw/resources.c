// resources.c - resources that only some views need. One table says how each is made and released.
#include "lib/draw/draw.h"

#define MAX_UNUSED_FRAMES 240 // Toggling a setting must not reallocate each time.

// Ensure ------------------------------------------------------------------------------------------

static hair_result ensure_fibres(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    (void)plan;
    return hair_lighting_ensure_fibres(renderer->lighting, &renderer->geometry->look);
}

// Self-shadowing writes the vertices that it needs, if the view itself does not read the cache.
static hair_result ensure_vertex_cache(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    if (plan->vertices != HAIR_VERTICES_CACHED) return HAIR_OK;
    return hair_geometry_ensure_vertex_cache(renderer->geometry, NULL);
}

static hair_result ensure_shaded(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    (void)plan;
    return hair_geometry_ensure_shaded(renderer->geometry);
}

static hair_result ensure_root_uvs(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    (void)plan;
    return hair_geometry_ensure_uvs(renderer->geometry);
}

static hair_result ensure_history(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    HAIR_ASSERT(plan->head && plan->vertices == HAIR_VERTICES_CACHED);
    struct hair_geometry* geometry = renderer->geometry;
    HAIR_TRY(hair_geometry_ensure_history(geometry, &geometry->history));
    hair_geometry_begin_history(geometry, &geometry->history, plan->head, plan->view->frame_index);
    return HAIR_OK;
}

// Release -----------------------------------------------------------------------------------------

static void free_fibres(struct hair_renderer* renderer)
{
    hair_lighting_free_fibres(renderer->lighting);
}

static void free_vertex_cache(struct hair_renderer* renderer)
{
    hair_geometry_free_vertex_cache(renderer->geometry);
}

static void free_shaded(struct hair_renderer* renderer)
{
    hair_geometry_free_shaded(renderer->geometry);
}

static void free_root_uvs(struct hair_renderer* renderer)
{
    hair_geometry_free_uvs(renderer->geometry);
}

static void free_history(struct hair_renderer* renderer)
{
    hair_geometry_free_history(renderer->geometry, &renderer->geometry->history);
}

static void free_host_history(struct hair_renderer* renderer)
{
    hair_geometry_free_history(renderer->geometry, &renderer->geometry->host_history);
}

static void free_guide_history(struct hair_renderer* renderer)
{
    hair_geometry_free_history(renderer->geometry, &renderer->geometry->guide_history);
}

static void free_self_shadow(struct hair_renderer* renderer)
{
    hair_lighting_free_self_shadow(renderer->lighting);
}

// The table ---------------------------------------------------------------------------------------

static const struct {
    hair_result (*ensure)(struct hair_renderer* renderer, struct hair_draw_plan* plan);
    void (*release)(struct hair_renderer* renderer);
} resources[HAIR_RESOURCES] = {
    [HAIR_RESOURCE_FIBRES] = {ensure_fibres, free_fibres},
    [HAIR_RESOURCE_STRAND_LIST] = {hair_draw_ensure_strand_list, hair_draw_free_strand_list},
    [HAIR_RESOURCE_OCCLUSION] = {hair_draw_ensure_occlusion, hair_draw_free_occlusion},
    [HAIR_RESOURCE_VERTEX_CACHE] = {ensure_vertex_cache, free_vertex_cache},
    [HAIR_RESOURCE_RASTER] = {hair_draw_ensure_raster, hair_draw_free_raster},
    [HAIR_RESOURCE_VIEW_CACHE] = {hair_draw_ensure_view_cache, hair_draw_free_view_cache},
    [HAIR_RESOURCE_SHADED] = {ensure_shaded, free_shaded},
    [HAIR_RESOURCE_ROOT_UVS] = {ensure_root_uvs, free_root_uvs},
    [HAIR_RESOURCE_SORTED_SEGMENTS] = {hair_draw_ensure_sorted_segments, hair_draw_free_sorted_segments},
    [HAIR_RESOURCE_HISTORY] = {ensure_history, free_history},
    [HAIR_RESOURCE_SELF_SHADOW] = {hair_draw_ensure_self_shadow, free_self_shadow},
    // Views need none of these. See host_buffers.c.
    [HAIR_RESOURCE_REFLECTANCE] = {NULL, hair_draw_free_reflectance},
    [HAIR_RESOURCE_STRAND_INDEX] = {NULL, hair_draw_free_strand_index},
    [HAIR_RESOURCE_HOST_HISTORY] = {NULL, free_host_history},
    [HAIR_RESOURCE_GUIDE_HISTORY] = {NULL, free_guide_history},
    [HAIR_RESOURCE_GUIDE_TANGENTS] = {NULL, hair_draw_free_guide_tangents},
};

static bool needs_fibres(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && renderer->geometry->look.shading.model == HAIR_SHADING_FIBRES;
}

hair_result hair_draw_ensure_textures(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    if (!needs_fibres(renderer, plan->view)) return HAIR_OK;
    renderer->last_used[HAIR_RESOURCE_FIBRES] = renderer->frame;
    return ensure_fibres(renderer, plan);
}

// Return whether a resource has what an earlier frame wrote, for a plan that keeps vertices.
static bool has_kept(const struct hair_draw_plan* plan, int resource)
{
    return plan->keeps_vertices &&
           (resource == HAIR_RESOURCE_STRAND_LIST || resource == HAIR_RESOURCE_VIEW_CACHE ||
            resource == HAIR_RESOURCE_SELF_SHADOW);
}

// Find the resources that a plan needs.
static void find_needed(const struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                        bool needed[HAIR_RESOURCES])
{
    const hair_view* view = plan->view;
    bool is_per_view = plan->vertices == HAIR_VERTICES_PER_VIEW, is_lit = plan->light_values > 0;
    needed[HAIR_RESOURCE_FIBRES] = needs_fibres(renderer, view);
    needed[HAIR_RESOURCE_STRAND_LIST] = plan->has_strand_list;
    needed[HAIR_RESOURCE_OCCLUSION] = plan->has_occlusion;
    needed[HAIR_RESOURCE_VERTEX_CACHE] = plan->vertices == HAIR_VERTICES_CACHED || is_lit;
    needed[HAIR_RESOURCE_RASTER] = plan->is_computed && !plan->is_empty && !plan->is_of_batch;
    needed[HAIR_RESOURCE_VIEW_CACHE] = is_per_view;
    needed[HAIR_RESOURCE_SHADED] = plan->shade && !is_per_view;
    needed[HAIR_RESOURCE_ROOT_UVS] = plan->has_root_uvs;
    needed[HAIR_RESOURCE_SORTED_SEGMENTS] = plan->blending == HAIR_BLENDING_SORTED;
    needed[HAIR_RESOURCE_HISTORY] = hair_draw_has_motion(view);
    needed[HAIR_RESOURCE_SELF_SHADOW] = is_lit;
}

hair_result hair_draw_ensure_resources(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    bool needed[HAIR_RESOURCES] = {false};
    hair_result result = HAIR_OK;
    HAIR_ASSERT(plan->pass_count > 0 && plan->draw == plan->pass[plan->pass_count - 1]);
    HAIR_ASSERT(plan->draw_program); // The passes must be compiled.
    find_needed(renderer, plan, needed);
    for (int i = 0; i < HAIR_RESOURCES && !result; ++i) {
        if (!needed[i]) continue;
        renderer->last_used[i] = renderer->frame;
        if (!has_kept(plan, i)) result = resources[i].ensure(renderer, plan);
    }
    return result;
}

void hair_draw_free_unused(struct hair_renderer* renderer, uint32_t frame)
{
    renderer->frame = frame;
    // Memory that has run out may be there again.
    if (frame - renderer->scarce_frame > MAX_UNUSED_FRAMES) renderer->scarce_vertices = 0;
    for (int i = 0; i < HAIR_RESOURCES; ++i) {
        HAIR_ASSERT(renderer->last_used[i] <= frame);
        if (frame - renderer->last_used[i] > MAX_UNUSED_FRAMES) resources[i].release(renderer);
    }
}

void hair_draw_free_resources(struct hair_renderer* renderer)
{
    for (int i = 0; i < HAIR_RESOURCES; ++i) resources[i].release(renderer);
}

hair_result hair_draw_read_vertices(struct hair_renderer* renderer, hair_vec4** out)
{
    renderer->last_used[HAIR_RESOURCE_VERTEX_CACHE] = renderer->frame;
    return hair_geometry_read_vertex_cache(renderer->geometry, out);
}
