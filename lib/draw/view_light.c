// view_light.c - self-shadowing of one view.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#define SWING 1.5 // Volume of the box around moving hair, as a multiple of that at rest.

// Return whether the vertex cache only needs the strands that the view draws. These make up for
// strands that a level of detail leaves out. A full cache that views share has all vertices.
static bool needs_cache_of_a_part(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->lod && !hair_geometry_has_history(renderer->geometry) &&
           !hair_geometry_has_vertex_cache(renderer->geometry);
}

// Return whether a view finds the light of strands by the list of strands. Others find it by the
// numbers of followers.
static bool finds_light_by_list(const struct hair_draw_plan* plan)
{
    return plan->vertices == HAIR_VERTICES_PER_VIEW;
}

// Return the fraction of the strands that the vertex cache of a part has room for, as in
// hair_draw_params.
static uint32_t choose_cached_fraction(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    if (!finds_light_by_list(plan)) return 0;
    return hair_geometry_choose_cached_fraction(renderer->geometry,
                                                hair_draw_max_fraction(renderer, plan->head, plan->view));
}

// Write the parameters of hair that casts shadows, also where hair is out of view or occluded.
// All strands have places in the vertex cache.
static void write_shadow_params(const struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                                const hair_view* view, struct hair_draw_params* out)
{
    hair_draw_write_params(renderer, plan->head, view, out);
    out->culls = 0;
    out->head_sphere.w = 0;
    out->cache_fraction = 0;
}

// Return the nodes that the density grid needs for cells of `cell` m. The cells of hair that swings
// far out of its rest pose become larger. Hair that may come off gets all nodes.
static uint32_t count_grid_nodes(const struct hair_renderer* renderer, double cell)
{
    const float* size = &renderer->rest_size.x;
    double nodes = SWING;
    HAIR_ASSERT(cell > 0);
    for (int i = 0; i < 3; ++i) nodes *= (double)size[i] / cell + 3;
    return renderer->has_attached_roots && nodes < HAIR_DENSITY_NODES ? (uint32_t)nodes : HAIR_DENSITY_NODES;
}

// Return whether a view may use the light of a frame before. Strands that were not drawn then have
// none.
static bool keeps_light(const struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    const struct hair_light_age* age = &renderer->light_age;
    const struct hair_self_shadow_state* self_shadow = &renderer->lighting->self_shadow;
    const hair_lod* lod = plan->view->lod;
    size_t vertices = hair_geometry_count_cached(renderer->geometry, self_shadow->fraction);
    uint32_t frames = renderer->frame - age->frame, index = plan->view->frame_index;
    bool fits = age->interval > 1 && lod && self_shadow->texture &&
                self_shadow->numbers == vertices * plan->light_values && age->lights == plan->light_values &&
                (!self_shadow->fraction || finds_light_by_list(plan)) &&
                hair_draw_estimate_fraction(renderer, lod) <= age->fraction;
    if (!fits) return false;
    // Lights may change while hair is not stepped.
    if (frames == 0) return index && index == age->frame_index;
    if (age->pace > 1) return frames + age->pace <= age->interval;
    return frames < age->interval && (renderer->frame + age->turn) % age->interval != 0;
}

hair_result hair_draw_ensure_self_shadow(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    struct hair_draw_params drawn, all;
    if (keeps_light(renderer, plan)) return HAIR_OK;
    bool part = needs_cache_of_a_part(renderer, plan->view);
    write_shadow_params(renderer, plan, plan->view, &drawn);
    if (part) drawn.cache_fraction = choose_cached_fraction(renderer, plan);
    all = drawn;
    if (plan->view->lod && !part) {
        hair_view whole = *plan->view;
        whole.lod = NULL; // All views of a step share the grid.
        write_shadow_params(renderer, plan, &whole, &all);
        drawn.origin.w = all.origin.w; // The size of the cells in the shared grid.
        drawn.grid_has_all = 1;
    }
    uint32_t nodes = count_grid_nodes(renderer, (double)all.origin.w);
    hair_result result = hair_lighting_ensure_grid(renderer->lighting, nodes, all.light_values);
    if (result) return result;
    result = hair_lighting_update_self_shadow(renderer->lighting, renderer->geometry, plan->view, &all,
                                              &drawn, part);
    struct hair_light_age* age = &renderer->light_age;
    *age = (struct hair_light_age){.interval = age->interval,
                                   .pace = age->pace,
                                   .turn = age->turn,
                                   .frame = renderer->frame,
                                   .frame_index = plan->view->frame_index,
                                   .lights = result ? 0 : plan->light_values,
                                   .fraction = hair_draw_estimate_fraction(renderer, plan->view->lod)};
    return result;
}
