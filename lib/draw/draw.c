// draw.c - passes that draw strands as lines or ribbons, in colour, depth and other outputs, and
// guides for debugging.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

hair_result hair_draw_create(struct hair_draw* draw, struct hair_gl* gl, const struct hair_groom* groom,
                             const struct hair_sim* sim)
{
    draw->gl = gl;
    draw->guides = sim->guides;
    draw->smooth_vertices = sim->smooth_vertices;
    draw->followers = groom->info.follower_count;
    draw->patches = groom->info.patch_count;
    draw->map_sets = groom->map_sets;
    draw->head_sphere = groom->head_sphere;
    draw->root_bindings = hair_root_bindings_retain(groom->root_bindings);
    for (uint32_t i = 0; i < draw->patches; ++i)
        if (groom->patches[i].count > draw->max_isolines) draw->max_isolines = groom->patches[i].count;
    HAIR_ASSERT(0 < draw->max_isolines && draw->max_isolines <= HAIR_MAX_ISOLINES);
    hair_draw_find_extent(draw, groom);
    hair_draw_find_fastest(draw);
    hair_result result = hair_gl_buffer(gl, "hair followers", draw->followers * sizeof *groom->followers,
                                        groom->followers, &draw->follower);
    if (!result)
        result = hair_gl_buffer(gl, "hair patches", draw->patches * sizeof *groom->patches, groom->patches,
                                &draw->patch);
    if (!result) result = hair_gl_uniform(gl, "hair draw", sizeof(struct hair_draw_params), &draw->params);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair followers", GL_RGBA32UI, draw->follower,
                                        &draw->follower_texture);
    if (!result && groom->colors)
        result = hair_gl_buffer(gl, "hair colours",
                                draw->followers * (HAIR_CURVE_INTERVALS + 1) * 4 * sizeof *groom->colors,
                                groom->colors, &draw->groom_color);
    if (!result && groom->colors)
        result = hair_gl_buffer_texture(gl, "hair colours", GL_RGBA16, draw->groom_color,
                                        &draw->groom_color_texture);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair patches", GL_RGBA32UI, draw->patch, &draw->patch_texture);
    return result;
}

void hair_draw_destroy(struct hair_draw* draw)
{
    if (!draw->gl) return;
    hair_draw_free_follower_collision(draw);
    hair_draw_free_fibres(draw);
    hair_draw_free_strand_list(draw);
    hair_draw_free_vertex_cache(draw);
    hair_draw_free_sorted_segments(draw);
    hair_draw_free_self_shadow(draw);
    hair_draw_free_occlusion(draw);
    hair_draw_free_raster(draw);
    hair_draw_free_view_cache(draw);
    hair_draw_free_uvs(draw);
    hair_root_bindings_release(draw->root_bindings);
    draw->root_bindings = NULL;
    hair_gl_free_buffer_texture(draw->gl, &draw->follower_texture);
    hair_gl_free_buffer_texture(draw->gl, &draw->patch_texture);
    hair_gl_free_buffer(draw->gl, &draw->follower);
    hair_gl_free_buffer(draw->gl, &draw->patch);
    hair_gl_free_buffer_texture(draw->gl, &draw->groom_color_texture);
    hair_gl_free_buffer(draw->gl, &draw->groom_color);
    hair_gl_free_buffer(draw->gl, &draw->params);
}

// Bind the textures that only the colour pass reads.
static void bind_light(struct hair_draw* draw, const hair_view* view)
{
    struct hair_gl* gl = draw->gl;
    if (draw->fibres.texture) gl->BindTextureUnit(HAIR_UNIT_FIBRE, draw->fibres.texture);
    gl->BindSampler(HAIR_UNIT_FIBRE, 0);
    if (hair_draw_light_value_count(draw, view))
        gl->BindTextureUnit(HAIR_UNIT_LIGHT, draw->self_shadow.texture);
    hair_draw_bind_shadows(draw, view);
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

static hair_result find_program(struct hair_draw* draw, const hair_view* view, struct hair_gl_shader* shader,
                                struct drawn* out)
{
    hair_result result = HAIR_OK;
    out->pass = hair_draw_choose(draw, hair_draw_find_passes(draw, view, shader, &out->shade_pass));
    if (out->occlusion) out->pass = hair_gl_add_features(out->pass, HAIR_GL_WITH(OCCLUSION));
    if (out->shade_pass) out->shade_pass = hair_draw_choose(draw, out->shade_pass);
    if (out->shade_pass) result = hair_draw_ensure_program(draw, out->shade_pass, shader, &out->shade);
    return result ? result
                  : hair_draw_ensure_program(draw, out->pass, out->shade_pass ? NULL : shader, &out->program);
}

hair_result hair_draw_ensure_programs(struct hair_draw* draw, const hair_view* view,
                                      struct hair_gl_shader* shader, int may_meet)
{
    struct hair_gl* gl = draw->gl;
    int meets = may_meet && draw->look.follower_collision != HAIR_FOLLOWER_COLLISION_NONE;
    int lit = hair_draw_light_value_count(draw, view) > 0;
    hair_gl_pass occlusion = hair_draw_uses_occlusion(view) ? HAIR_GL_WITH(OCCLUSION) : 0;
    hair_gl_pass expand = hair_draw_styled(draw, HAIR_GL_EXPAND), shade;
    hair_gl_pass strands = hair_draw_styled(draw, hair_draw_find_passes(draw, view, shader, &shade));
    hair_result result = HAIR_OK;
    GLuint program;
    if (view->render_path != HAIR_RENDER_PATH_TESSELLATION)
        result = hair_gl_ensure_programs(gl, HAIR_GL_SCAN_STRANDS, HAIR_GL_COMPACT_STRANDS, occlusion);
    if (!result && hair_draw_uses_alpha(view))
        result = hair_gl_ensure_programs(gl, HAIR_GL_HISTOGRAM, HAIR_GL_SCATTER, 0);
    if (!result && view->render_path == HAIR_RENDER_PATH_COMPUTE)
        result = hair_gl_ensure_programs(gl, HAIR_GL_RASTER_CLEAR, HAIR_GL_RASTER, strands & RASTER_FEATURES);
    if (!result && meets) result = hair_draw_ensure_hit_programs(draw);
    // Compile the variants without follower collision, then those with it.
    for (int i = 0; i <= meets && !result; ++i) {
        hair_gl_pass with = i ? HAIR_GL_WITH(HITS) | HAIR_GL_WITH(COLLIDERS) : 0;
        if (shade)
            result = hair_draw_ensure_program(draw, hair_gl_add_features(hair_draw_styled(draw, shade), with),
                                              shader, &program);
        if (!result)
            result = hair_draw_ensure_program(draw, hair_gl_add_features(strands, with | occlusion),
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

static void draw_guides(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    gl->BindVertexArray(gl->vertex_array);
    hair_gl_begin(gl, HAIR_GL_GUIDES);
    gl->DrawArraysInstanced(GL_LINE_STRIP, 0, (GLsizei)draw->smooth_vertices, (GLsizei)draw->guides);
    hair_gl_end(gl, HAIR_GL_GUIDES);
}

static void draw_followers(struct hair_draw* draw, const struct hair_smooth* smooth, const hair_view* view,
                           const struct hair_draw_params* params, struct drawn* with)
{
    struct hair_gl* gl = draw->gl;
    int strand_list = view->render_path != HAIR_RENDER_PATH_TESSELLATION;
    int computed = view->render_path == HAIR_RENDER_PATH_COMPUTE;
    struct hair_blend was;
    HAIR_ASSERT(with->program && (with->shade != 0) == (with->shade_pass != 0));
    if (strand_list) hair_draw_update_strand_list(draw, smooth, params, with->occlusion);
    if (hair_draw_uses_vertex_cache(view)) hair_draw_bind_vertex_cache(draw);
    if (hair_draw_uses_view_cache(view))
        hair_draw_expand_view(draw, with->shade_pass, with->shade);
    else if (with->shade_pass)
        hair_draw_shade(draw, with->shade_pass, with->shade, params->chunks);
    if (computed) hair_draw_rasterise(draw, with->pass & RASTER_FEATURES, &with->raster);
    if (view->pass == HAIR_PASS_MOTION) hair_draw_bind_motion(draw);
    if (hair_draw_uses_alpha(view)) hair_draw_sort(draw);
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE); // A ribbon faces the eye with either side.
    hair_gl_begin(gl, with->pass);
    gl->UseProgram(with->program);
    if (hair_draw_uses_analytic_coverage(view)) hair_draw_begin_blend(gl, &was);
    if (hair_draw_uses_alpha(view))
        hair_draw_issue_sorted_segments(draw);
    else if (computed)
        hair_draw_resolve_tiles(draw, &with->raster);
    else if (strand_list)
        hair_draw_issue_strand_list(draw, hair_draw_is_paired(view));
    else
        hair_draw_patches(draw);
    if (hair_draw_uses_analytic_coverage(view)) hair_draw_end_blend(gl, &was);
    hair_gl_end(gl, with->pass);
}

static hair_result ensure_raster(struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                                 struct drawn* out)
{
    hair_gl_pass with = out->pass & RASTER_FEATURES;
    hair_result result = hair_gl_ensure_programs(draw->gl, HAIR_GL_RASTER_CLEAR, HAIR_GL_RASTER, with);
    out->nowhere = !hair_draw_find_raster(draw, head, view, &out->raster);
    return result || out->nowhere ? result : hair_draw_ensure_raster(draw, with, &out->raster);
}

// Compile the programs and create or update the buffers that drawing followers needs.
static hair_result make_ready(struct hair_draw* draw, const struct hair_smooth* smooth,
                              const struct hair_pose* head, const hair_view* view,
                              struct hair_gl_shader* shader, struct drawn* out)
{
    int motion = view->pass == HAIR_PASS_MOTION;
    out->occlusion = hair_draw_find_occlusion(draw, head, view, &out->occlusion_params);
    hair_result result = find_program(draw, view, shader, out);
    if (!result && view->pass == HAIR_PASS_COLOR && draw->look.shading == HAIR_SHADING_FIBRES)
        result = hair_draw_ensure_fibres(draw);
    if (!result && view->render_path != HAIR_RENDER_PATH_TESSELLATION)
        result = hair_draw_ensure_strand_list(draw, out->occlusion);
    if (!result && view->render_path != HAIR_RENDER_PATH_TESSELLATION &&
        view->render_path != HAIR_RENDER_PATH_COMPUTE)
        result = hair_draw_ensure_indices(draw, hair_draw_is_paired(view));
    if (!result && out->occlusion) result = hair_draw_ensure_occlusion(draw, &out->occlusion_params);
    if (!result && hair_draw_uses_vertex_cache(view))
        result = hair_draw_ensure_vertex_cache(draw, smooth, NULL);
    if (!result && view->render_path == HAIR_RENDER_PATH_COMPUTE)
        result = ensure_raster(draw, head, view, out);
    if (!result && hair_draw_uses_view_cache(view))
        result = hair_draw_ensure_view_cache(draw, view);
    else if (!result && out->shade_pass)
        result = hair_draw_ensure_shaded(draw);
    if (!result && hair_draw_wants_uvs(draw, view, shader)) result = hair_draw_ensure_uvs(draw);
    if (!result && hair_draw_uses_alpha(view)) result = hair_draw_ensure_sorted_segments(draw);
    if (!result && motion) result = hair_draw_ensure_motion(draw);
    if (!result && motion) hair_draw_begin_motion(draw, head, view->frame_index);
    return result;
}

hair_result hair_draw_run(struct hair_draw* draw, const struct hair_smooth* smooth,
                          const struct hair_pose* head, const hair_view* view, struct hair_gl_shader* shader)
{
    int guides = view->pass == HAIR_PASS_GUIDES;
    HAIR_ASSERT(guides || view->render_path != HAIR_RENDER_PATH_AUTO);
    struct drawn with = {0};
    if (!guides && draw->look.density <= 0) return HAIR_OK;
    hair_result result = guides ? hair_gl_ensure_program(draw->gl, HAIR_GL_GUIDES)
                                : make_ready(draw, smooth, head, view, shader, &with);
    if (!result && !guides) result = hair_draw_find_light(draw, smooth, head, view);
    if (result || with.nowhere) return result;

    struct hair_draw_params params;
    hair_draw_write_params(draw, head, view, &params);
    if (!guides && view->render_path == HAIR_RENDER_PATH_TESSELLATION)
        hair_draw_cull_patches(draw, view, &params);
    params.textured = (uint32_t)hair_draw_is_textured(draw, view);
    params.drawn_only = with.shade_pass != 0;
    hair_gl_write_uniform(draw->gl, draw->params, sizeof params, &params);
    hair_draw_bind(draw, smooth);
    if (with.occlusion) hair_draw_cull_occluded(draw, view, &with.occlusion_params);
    if (view->pass == HAIR_PASS_COLOR) bind_light(draw, view);
    if (hair_draw_wants_uvs(draw, view, shader)) draw->gl->BindTextureUnit(HAIR_UNIT_UV, draw->uv_texture);
    if (hair_draw_is_painted(draw, view))
        draw->gl->BindTextureUnit(HAIR_UNIT_GROOM_COLOR, draw->groom_color_texture);
    if (params.textured) {
        draw->gl->BindTextureUnit(HAIR_UNIT_COLOR, view->color_texture);
        // Use the sampler state of the application's texture.
        draw->gl->BindSampler(HAIR_UNIT_COLOR, 0);
    }
    if (guides)
        draw_guides(draw);
    else
        draw_followers(draw, smooth, view, &params, &with);
    return HAIR_OK;
}
