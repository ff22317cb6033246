// view_light.c - self-shadowing of one view.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

// Return whether only the vertices that the view draws need light. Strands that a level of
// detail leaves out need no light. The drawn strands make up for them in the grid. A full vertex
// cache that views share has all vertices.
static bool needs_light_of_a_part(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->lod && !hair_geometry_has_history(renderer->geometry) &&
           !hair_geometry_has_vertex_cache(renderer->geometry);
}

hair_result hair_draw_ensure_self_shadow(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    struct hair_draw_params params;
    bool part = needs_light_of_a_part(renderer, plan->view);
    hair_view whole = *plan->view;
    whole.lod = NULL; // All views of a step share the grid.
    hair_draw_write_params(renderer, plan->head, part ? plan->view : &whole, &params);
    params.culls = 0; // Hair that is out of view or occluded casts shadows too.
    params.head_sphere.w = 0;
    return hair_lighting_update_self_shadow(renderer->lighting, renderer->geometry, plan->view, &params,
                                            part);
}
