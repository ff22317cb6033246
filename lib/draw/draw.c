// draw.c - passes that draw strands as lines or ribbons, in colour, depth and other outputs, and
// guides for debugging.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

hair_result hair_renderer_create(struct hair_renderer* renderer, struct hair_gl* gl,
                                 const struct hair_groom* groom, struct hair_geometry* geometry,
                                 struct hair_lighting* lighting)
{
    renderer->gl = gl;
    renderer->geometry = geometry;
    renderer->lighting = lighting;
    renderer->head_sphere = groom->head_sphere;
    hair_draw_find_extent(renderer, groom);
    hair_draw_find_fastest(renderer);
    return HAIR_OK;
}

void hair_renderer_destroy(struct hair_renderer* renderer)
{
    if (!renderer->gl) return;
    hair_draw_free_strand_list(renderer);
    hair_draw_free_sorted_segments(renderer);
    hair_draw_free_occlusion(renderer);
    hair_draw_free_raster(renderer);
    hair_draw_free_view_cache(renderer);
}

// Programs of one draw: the main pass, and an optional pass that shades or writes vertices before
// it.
struct drawn {
    hair_gl_pass pass, shade_pass;
    GLuint program, shade;
    int occlusion; // Nonzero if patches are tested for occlusion with `hide`.
    struct hair_occlusion_params occlusion_params;
    // Parameters of compute rasterisation.
    struct hair_raster_params raster;
    // Nonzero if compute rasterisation has no pixels to cover.
    int nowhere;
};

// Features of compute rasterisation.
#define RASTER_FEATURES (HAIR_GL_WITH(DEPTH) | HAIR_GL_WITH(WIDENED))

static hair_result find_program(struct hair_renderer* renderer, const hair_view* view,
                                struct hair_gl_shader* shader, struct drawn* out)
{
    hair_result result = HAIR_OK;
    out->pass = hair_geometry_choose_variant(renderer->geometry,
                                             hair_draw_find_passes(renderer, view, shader, &out->shade_pass));
    if (out->occlusion) out->pass = hair_gl_add_features(out->pass, HAIR_GL_WITH(OCCLUSION));
    if (out->shade_pass) out->shade_pass = hair_geometry_choose_variant(renderer->geometry, out->shade_pass);
    if (out->shade_pass) result = hair_draw_ensure_program(renderer, out->shade_pass, shader, &out->shade);
    return result ? result
                  : hair_draw_ensure_program(renderer, out->pass, out->shade_pass ? NULL : shader,
                                             &out->program);
}

hair_result hair_draw_ensure_programs(struct hair_renderer* renderer, const hair_view* view,
                                      struct hair_gl_shader* shader, int may_meet)
{
    struct hair_gl* gl = renderer->gl;
    int meets = may_meet && renderer->geometry->look.follower_collision != HAIR_FOLLOWER_COLLISION_NONE;
    int lit = hair_lighting_value_count(&renderer->geometry->look, view) > 0;
    hair_gl_pass occlusion = hair_draw_uses_occlusion(view) ? HAIR_GL_WITH(OCCLUSION) : 0;
    hair_gl_pass expand = hair_geometry_add_style(renderer->geometry, HAIR_GL_EXPAND), shade;
    hair_gl_pass strands =
        hair_geometry_add_style(renderer->geometry, hair_draw_find_passes(renderer, view, shader, &shade));
    hair_result result = HAIR_OK;
    GLuint program;
    if (view->render_path != HAIR_RENDER_PATH_TESSELLATION)
        result = hair_gl_ensure_programs(gl, HAIR_GL_SCAN_STRANDS, HAIR_GL_COMPACT_STRANDS, occlusion);
    if (!result && hair_draw_uses_alpha(view))
        result = hair_gl_ensure_programs(gl, HAIR_GL_HISTOGRAM, HAIR_GL_SCATTER, 0);
    if (!result && view->render_path == HAIR_RENDER_PATH_COMPUTE)
        result = hair_gl_ensure_programs(gl, HAIR_GL_RASTER_CLEAR, HAIR_GL_RASTER, strands & RASTER_FEATURES);
    if (!result && meets) result = hair_geometry_ensure_hit_programs(renderer->geometry);
    // Compile the variants without follower collision, then those with it.
    for (int i = 0; i <= meets && !result; ++i) {
        hair_gl_pass with = i ? HAIR_GL_WITH(HITS) | HAIR_GL_WITH(COLLIDERS) : 0;
        if (shade)
            result = hair_draw_ensure_program(
                renderer, hair_gl_add_features(hair_geometry_add_style(renderer->geometry, shade), with),
                shader, &program);
        if (!result)
            result = hair_draw_ensure_program(renderer, hair_gl_add_features(strands, with | occlusion),
                                              shade ? NULL : shader, &program);
        if (!result && occlusion)
            result = hair_gl_ensure_programs(gl, HAIR_GL_HIZ_REDUCE_DEPTH, HAIR_GL_CULL_PATCHES, with);
        if (!result && (lit || hair_draw_uses_vertex_cache(view)))
            result = hair_gl_ensure_program(gl, hair_gl_add_features(expand, with));
        if (!result && lit)
            result = hair_gl_ensure_programs(gl, HAIR_GL_DENSITY_BOUNDS, HAIR_GL_VERTEX_TRANSMITTANCE, with);
    }
    return result;
}

static void draw_guides(struct hair_renderer* renderer)
{
    struct hair_gl* gl = renderer->gl;
    gl->BindVertexArray(gl->vertex_array);
    hair_gl_begin(gl, HAIR_GL_GUIDES);
    gl->DrawArraysInstanced(GL_LINE_STRIP, 0, (GLsizei)renderer->geometry->smooth_vertices,
                            (GLsizei)renderer->geometry->guides);
    hair_gl_end(gl, HAIR_GL_GUIDES);
}

static void draw_followers(struct hair_renderer* renderer, const hair_view* view,
                           const struct hair_draw_params* params, struct drawn* with)
{
    struct hair_gl* gl = renderer->gl;
    int strand_list = view->render_path != HAIR_RENDER_PATH_TESSELLATION;
    int computed = view->render_path == HAIR_RENDER_PATH_COMPUTE;
    struct hair_blend was;
    HAIR_ASSERT(with->program && (with->shade != 0) == (with->shade_pass != 0));
    if (strand_list) hair_draw_update_strand_list(renderer, params, with->occlusion);
    if (hair_draw_uses_vertex_cache(view)) hair_geometry_bind_vertex_cache(renderer->geometry);
    if (hair_draw_uses_view_cache(view))
        hair_draw_expand_view(renderer, with->shade_pass, with->shade);
    else if (with->shade_pass)
        hair_draw_shade(renderer, with->shade_pass, with->shade, params->chunks);
    if (computed) hair_draw_rasterise(renderer, with->pass & RASTER_FEATURES, &with->raster);
    if (view->pass == HAIR_PASS_MOTION) hair_geometry_bind_history(renderer->geometry);
    if (hair_draw_uses_alpha(view)) hair_draw_sort(renderer);
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE); // A ribbon faces the eye with either side.
    hair_gl_begin(gl, with->pass);
    gl->UseProgram(with->program);
    if (hair_draw_uses_analytic_coverage(view)) hair_draw_begin_blend(gl, &was);
    if (hair_draw_uses_alpha(view))
        hair_draw_issue_sorted_segments(renderer);
    else if (computed)
        hair_draw_resolve_tiles(renderer, &with->raster);
    else if (strand_list)
        hair_draw_issue_strand_list(renderer, hair_draw_is_paired(view));
    else
        hair_geometry_draw_patches(renderer->geometry);
    if (hair_draw_uses_analytic_coverage(view)) hair_draw_end_blend(gl, &was);
    hair_gl_end(gl, with->pass);
}

static hair_result ensure_raster(struct hair_renderer* renderer, const struct hair_pose* head,
                                 const hair_view* view, struct drawn* out)
{
    hair_gl_pass with = out->pass & RASTER_FEATURES;
    hair_result result = hair_gl_ensure_programs(renderer->gl, HAIR_GL_RASTER_CLEAR, HAIR_GL_RASTER, with);
    out->nowhere = !hair_draw_find_raster(renderer, head, view, &out->raster);
    return result || out->nowhere ? result : hair_draw_ensure_raster(renderer, with, &out->raster);
}

static hair_result ensure_fibres(struct hair_renderer* renderer)
{
    hair_draw_use(renderer, HAIR_DRAW_FIBRES);
    return hair_lighting_ensure_fibres(renderer->lighting, &renderer->geometry->look);
}

static hair_result ensure_vertex_cache(struct hair_renderer* renderer)
{
    hair_draw_use(renderer, HAIR_DRAW_VERTEX_CACHE);
    return hair_geometry_ensure_vertex_cache(renderer->geometry, NULL);
}

static hair_result ensure_shaded(struct hair_renderer* renderer)
{
    hair_draw_use(renderer, HAIR_DRAW_SHADED);
    return hair_geometry_ensure_shaded(renderer->geometry);
}

static hair_result ensure_uvs(struct hair_renderer* renderer)
{
    hair_draw_use(renderer, HAIR_DRAW_UVS);
    return hair_geometry_ensure_uvs(renderer->geometry);
}

static hair_result ensure_history(struct hair_renderer* renderer)
{
    hair_draw_use(renderer, HAIR_DRAW_MOTION);
    return hair_geometry_ensure_history(renderer->geometry);
}

// Compile the programs and create or update the buffers that drawing followers needs.
static hair_result make_ready(struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view, struct hair_gl_shader* shader, struct drawn* out)
{
    int motion = view->pass == HAIR_PASS_MOTION;
    out->occlusion = hair_draw_find_occlusion(renderer, head, view, &out->occlusion_params);
    hair_result result = find_program(renderer, view, shader, out);
    if (!result && view->pass == HAIR_PASS_COLOR && renderer->geometry->look.shading == HAIR_SHADING_FIBRES)
        result = ensure_fibres(renderer);
    if (!result && view->render_path != HAIR_RENDER_PATH_TESSELLATION)
        result = hair_draw_ensure_strand_list(renderer, out->occlusion);
    if (!result && view->render_path != HAIR_RENDER_PATH_TESSELLATION &&
        view->render_path != HAIR_RENDER_PATH_COMPUTE)
        result = hair_draw_ensure_indices(renderer, hair_draw_is_paired(view));
    if (!result && out->occlusion) result = hair_draw_ensure_occlusion(renderer, &out->occlusion_params);
    if (!result && hair_draw_uses_vertex_cache(view)) result = ensure_vertex_cache(renderer);
    if (!result && view->render_path == HAIR_RENDER_PATH_COMPUTE)
        result = ensure_raster(renderer, head, view, out);
    if (!result && hair_draw_uses_view_cache(view))
        result = hair_draw_ensure_view_cache(renderer, view);
    else if (!result && out->shade_pass)
        result = ensure_shaded(renderer);
    if (!result && hair_draw_wants_uvs(renderer, view, shader)) result = ensure_uvs(renderer);
    if (!result && hair_draw_uses_alpha(view)) result = hair_draw_ensure_sorted_segments(renderer);
    if (!result && motion) result = ensure_history(renderer);
    if (!result && motion) hair_geometry_begin_history(renderer->geometry, head, view->frame_index);
    return result;
}

// Return whether only the vertices that the view draws need light. Strands that a level of
// detail leaves out need no light. The drawn strands make up for them in the grid. A full vertex
// cache that views share has all vertices.
static bool needs_light_of_a_part(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->lod && !renderer->geometry->history.buffer &&
           !hair_geometry_has_vertex_cache(renderer->geometry);
}

// Compute the light that reaches each vertex, if the look requests self-shadowing for `view`.
static hair_result find_light(struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view)
{
    const hair_look* look = &renderer->geometry->look;
    struct hair_lighting* lighting = renderer->lighting;
    if (lighting->self_shadow.density && look->self_shadow != HAIR_SELF_SHADOW_STRANDS)
        hair_lighting_free_self_shadow(lighting);
    if (!hair_lighting_value_count(look, view)) return HAIR_OK;
    hair_draw_use(renderer, HAIR_DRAW_SELF_SHADOW);
    hair_draw_use(renderer, HAIR_DRAW_VERTEX_CACHE);
    struct hair_draw_params params;
    bool part = needs_light_of_a_part(renderer, view);
    hair_view whole = *view;
    whole.lod = NULL; // All views of a step share the grid.
    hair_draw_write_params(renderer, head, part ? view : &whole, &params);
    params.drawn_only = part;
    params.culls = 0; // Hair that is out of view or occluded casts shadows too.
    params.head_sphere.w = 0;
    return hair_lighting_update_self_shadow(lighting, renderer->geometry, view, &params);
}

hair_result hair_draw_run(struct hair_renderer* renderer, const struct hair_pose* head, const hair_view* view,
                          struct hair_gl_shader* shader)
{
    int guides = view->pass == HAIR_PASS_GUIDES;
    HAIR_ASSERT(guides || view->render_path != HAIR_RENDER_PATH_AUTO);
    struct drawn with = {0};
    if (!guides && renderer->geometry->look.density <= 0) return HAIR_OK;
    hair_result result = guides ? hair_gl_ensure_program(renderer->gl, HAIR_GL_GUIDES)
                                : make_ready(renderer, head, view, shader, &with);
    if (!result && !guides) result = find_light(renderer, head, view);
    if (result || with.nowhere) return result;

    struct hair_draw_params params;
    hair_draw_write_params(renderer, head, view, &params);
    if (!guides && view->render_path == HAIR_RENDER_PATH_TESSELLATION)
        hair_draw_cull_patches(renderer, view, &params);
    params.textured = (uint32_t)hair_draw_is_textured(renderer, view);
    params.drawn_only = with.shade_pass != 0;
    hair_gl_write_uniform(renderer->gl, renderer->geometry->params, sizeof params, &params);
    hair_geometry_bind(renderer->geometry);
    if (with.occlusion) hair_draw_cull_occluded(renderer, view, &with.occlusion_params);
    if (view->pass == HAIR_PASS_COLOR)
        hair_lighting_bind(renderer->lighting, &renderer->geometry->look, view);
    if (hair_draw_wants_uvs(renderer, view, shader))
        renderer->gl->BindTextureUnit(HAIR_UNIT_UV, renderer->geometry->uv_texture);
    if (hair_draw_is_painted(renderer, view))
        renderer->gl->BindTextureUnit(HAIR_UNIT_GROOM_COLOR, renderer->lighting->groom_color_texture);
    if (params.textured) {
        renderer->gl->BindTextureUnit(HAIR_UNIT_COLOR, view->color_texture);
        // Use the sampler state of the application's texture.
        renderer->gl->BindSampler(HAIR_UNIT_COLOR, 0);
    }
    if (guides)
        draw_guides(renderer);
    else
        draw_followers(renderer, view, &params, &with);
    return HAIR_OK;
}
