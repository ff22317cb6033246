// view_light.c - self-shadowing of one view.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

// Return whether the vertex cache only needs the strands that the view draws. These make up for
// strands that a level of detail leaves out. A full cache that views share has all vertices.
static bool needs_cache_of_a_part(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->lod && !hair_geometry_has_history(renderer->geometry) &&
           !hair_geometry_has_vertex_cache(renderer->geometry);
}

hair_result hair_draw_ensure_self_shadow(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    struct hair_draw_params drawn, all;
    bool part = needs_cache_of_a_part(renderer, plan->view);
    hair_view whole = *plan->view;
    hair_draw_write_params(renderer, plan->head, plan->view, &drawn);
    drawn.culls = 0; // Hair that is out of view or occluded casts shadows too.
    drawn.head_sphere.w = 0;
    all = drawn;
    if (plan->view->lod && !part) {
        whole.lod = NULL; // All views of a step share the grid.
        hair_draw_write_params(renderer, plan->head, &whole, &all);
        all.culls = 0;
        all.head_sphere.w = 0;
    }
    return hair_lighting_update_self_shadow(renderer->lighting, renderer->geometry, plan->view, &all, &drawn,
                                            part);
}
