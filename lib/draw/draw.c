// draw.c - passes that draw strands as lines or ribbons, in colour, depth and other outputs, and
// guides for debugging.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

void hair_renderer_create(struct hair_renderer* renderer, struct hair_gl* gl, const struct hair_groom* groom,
                          const hair_vec3 bounds[2], struct hair_geometry* geometry,
                          struct hair_lighting* lighting, struct hair_batch* batch,
                          const struct hair_fastest* fastest)
{
    hair_vec3 middle = hair_lerp(bounds[0], bounds[1], 0.5f);
    renderer->gl = gl;
    renderer->geometry = geometry;
    renderer->lighting = lighting;
    renderer->head_sphere = groom->head_sphere;
    renderer->reach = (hair_vec4){middle.x, middle.y, middle.z, hair_distance(middle, bounds[1])};
    renderer->rest_size = hair_sub(groom->upper, groom->lower);
    hair_draw_find_extent(renderer, groom);
    renderer->batch = batch;
    renderer->fastest = fastest;
}

void hair_renderer_destroy(struct hair_renderer* renderer)
{
    if (!renderer->gl) return;
    hair_draw_free_resources(renderer);
}

void hair_renderer_set_attachment(struct hair_renderer* renderer, bool has_fixed_roots,
                                  bool has_attached_strands)
{
    renderer->is_cullable = has_fixed_roots;
    renderer->has_attached_roots = has_attached_strands;
}

void hair_draw_bind_plan(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    hair_geometry_bind(renderer->geometry);
    if (plan->view->pass == HAIR_PASS_COLOR)
        hair_lighting_bind(renderer->lighting, &renderer->geometry->look, plan->view);
    if (plan->has_root_uvs) hair_gl_bind_texture(gl, HAIR_UNIT_UV, renderer->geometry->uv_texture);
    if (plan->is_painted)
        hair_gl_bind_texture(gl, HAIR_UNIT_GROOM_COLOR, renderer->lighting->groom_color_texture);
    if (!plan->is_textured) return;
    hair_gl_bind_texture(gl, HAIR_UNIT_COLOR, plan->view->color_texture);
    hair_gl_bind_sampler(gl, HAIR_UNIT_COLOR, 0); // Use the state of the application's texture.
}

static void draw_guides(struct hair_renderer* renderer, const struct hair_pose* head, const hair_view* view)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_draw_params params;
    struct hair_outputs outputs;
    hair_draw_write_params(renderer, head, view, &params);
    hair_gl_write_uniform(gl, renderer->geometry->params, sizeof params, &params);
    hair_geometry_bind(renderer->geometry);
    gl->BindVertexArray(gl->vertex_array);
    hair_draw_begin_outputs(gl, HAIR_DRAW_FIRST_BUFFER, &outputs);
    hair_gl_begin(gl, HAIR_GL_GUIDES);
    gl->DrawArraysInstanced(GL_LINE_STRIP, 0, (GLsizei)renderer->geometry->smooth_vertices,
                            (GLsizei)renderer->geometry->guides);
    hair_gl_end(gl, HAIR_GL_GUIDES);
    hair_draw_end_outputs(gl, &outputs);
}

// Run the passes before the one that draws.
static void prepare_vertices(struct hair_renderer* renderer, struct hair_draw_plan* plan,
                             const struct hair_draw_params* params)
{
    if (plan->has_occlusion) {
        hair_draw_cull_occluded(renderer, plan);
        hair_geometry_bind_group_looks(renderer->geometry);
    }
    if (plan->has_strand_list && !plan->keeps_vertices) hair_draw_update_strand_list(renderer, plan, params);
    if (plan->vertices == HAIR_VERTICES_CACHED) hair_geometry_bind_vertex_cache(renderer->geometry);
    if (plan->shade) hair_draw_write_vertices(renderer, plan, params);
    if (hair_draw_has_motion(plan->view)) hair_geometry_bind_history(renderer->geometry);
    if (plan->blending == HAIR_BLENDING_SORTED) hair_draw_sort(renderer);
}

// Issue the commands of the pass that draws.
static void submit(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    if (plan->blending == HAIR_BLENDING_SORTED)
        hair_draw_issue_sorted_segments(renderer, plan);
    else if (plan->is_computed)
        hair_draw_resolve_tiles(renderer, plan);
    else if (plan->has_strand_list)
        hair_draw_issue_strand_list(renderer, plan);
    else
        hair_geometry_draw_patches(renderer->geometry);
}

static void draw_followers(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_blend was;
    struct hair_outputs outputs;
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE); // A ribbon faces the eye with either side.
    hair_gl_begin(gl, plan->draw);
    hair_gl_use_program(gl, plan->draw_program);
    if (plan->blending) hair_draw_begin_blend(gl, plan->has_motion_output ? 2 : 1, &was);
    hair_draw_begin_outputs(gl, hair_draw_find_outputs(gl, plan), &outputs);
    submit(renderer, plan);
    hair_draw_end_outputs(gl, &outputs);
    if (plan->blending) hair_draw_end_blend(gl, &was);
    hair_gl_end(gl, plan->draw);
}

// Return the features of passes that depend on where the hair is.
static hair_gl_pass find_state(const struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    const struct hair_geometry* geometry = renderer->geometry;
    hair_gl_pass state = hair_geometry_has_hits(geometry) ? HAIR_GL_WITH(HITS) : 0;
    if (geometry->follower_collision.field) state |= HAIR_GL_WITH(COLLIDERS);
    if (plan->has_occlusion) state |= HAIR_GL_WITH(OCCLUSION);
    return state;
}

hair_result hair_draw_prepare(struct hair_renderer* renderer, const struct hair_pose* head,
                              struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    struct hair_draw_params params;
    plan->head = head;
    plan->is_empty = true;
    if (view->pass == HAIR_PASS_GUIDES) return hair_gl_ensure_program(renderer->gl, HAIR_GL_GUIDES);
    if (renderer->geometry->look.followers.density <= 0) return HAIR_OK;
    plan->has_occlusion = hair_draw_find_occlusion(renderer, head, view, &plan->occlusion);
    plan->is_empty = plan->is_computed && !hair_draw_find_raster(renderer, head, plan);
    if (renderer->geometry->look.self_shadow.method != HAIR_SELF_SHADOW_STRANDS)
        hair_lighting_free_self_shadow(renderer->lighting);
    hair_draw_find_passes(renderer, find_state(renderer, plan), plan);
    hair_result result = hair_draw_compile(renderer, plan);
    if (!result) result = hair_draw_ensure_resources(renderer, plan);
    if (result || plan->is_empty) return result;

    HAIR_ASSERT(plan->draw_program && (plan->shade_program != 0) == (plan->shade != 0));
    if (plan->is_of_batch && plan->keeps_vertices) {
        hair_batch_add(renderer, plan);
        return HAIR_OK;
    }
    hair_draw_write_params(renderer, head, view, &params);
    if (plan->vertices == HAIR_VERTICES_TESSELLATED) hair_draw_cull_patches(renderer, view, &params);
    params.textured = plan->is_textured;
    if (plan->is_of_batch) params.strands_at = hair_batch_count_vertices(renderer->view_cache.place) - 1;
    hair_gl_write_uniform(renderer->gl, renderer->geometry->params, sizeof params, &params);
    hair_draw_bind_plan(renderer, plan);
    prepare_vertices(renderer, plan, &params);
    if (plan->is_of_batch) hair_batch_add(renderer, plan);
    return HAIR_OK;
}

void hair_draw_finish(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    if (plan->view->pass == HAIR_PASS_GUIDES) {
        draw_guides(renderer, plan->head, plan->view);
    } else if (!plan->is_empty) {
        if (!plan->is_of_batch) draw_followers(renderer, plan);
        hair_lighting_unbind(renderer->lighting);
    }
}
