// variant.c - choice of the program variants that a look and a view need.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

static const hair_gl_pass row_of_path[] = {[HAIR_RENDER_PATH_TESSELLATION] = HAIR_GL_TESSELLATED,
                                           [HAIR_RENDER_PATH_INSTANCED] = HAIR_GL_INSTANCED,
                                           [HAIR_RENDER_PATH_CACHED] = HAIR_GL_CACHED,
                                           [HAIR_RENDER_PATH_COMPUTE] = HAIR_GL_RESOLVE_TILES};

bool hair_draw_is_textured(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && view->color_texture && hair_geometry_has_uvs(renderer->geometry);
}

bool hair_draw_is_painted(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && renderer->lighting->groom_color &&
           renderer->geometry->look.groom_colors > 0;
}

bool hair_draw_wants_uvs(const struct hair_renderer* renderer, const hair_view* view,
                         const struct hair_gl_shader* shader)
{
    return hair_draw_is_textured(renderer, view) || (shader && hair_geometry_has_uvs(renderer->geometry));
}

static hair_gl_pass features_of(const struct hair_renderer* renderer, const hair_view* view,
                                const struct hair_gl_shader* shader)
{
    hair_gl_pass features = 0;
    if (view->pass == HAIR_PASS_DEPTH || view->pass == HAIR_PASS_OPACITY) features |= HAIR_GL_WITH(DEPTH);
    if (view->pass == HAIR_PASS_ID) features |= HAIR_GL_WITH(IDS);
    if (view->pass == HAIR_PASS_MOTION) features |= HAIR_GL_WITH(MOTION);
    if (view->pass == HAIR_PASS_COLOR && renderer->geometry->look.shading == HAIR_SHADING_FIBRES)
        features |= HAIR_GL_WITH(FIBRES);
    if (hair_draw_uses_analytic_coverage(view))
        features |= HAIR_GL_WITH(ALPHA_COVERAGE);
    else if (view->primitive == HAIR_PRIMITIVE_LINES)
        features |= HAIR_GL_WITH(LINES);
    if (view->lod) features |= HAIR_GL_WITH(WIDENED);
    if (hair_lighting_is_blocked(view)) features |= HAIR_GL_WITH(OPAQUE_SHADOWS);
    if (hair_draw_wants_uvs(renderer, view, shader)) features |= HAIR_GL_WITH(ROOT_UV);
    if (hair_draw_is_painted(renderer, view)) features |= HAIR_GL_WITH(GROOM_COLORS);
    return features;
}

// Features of shading, for views that shade vertices in a separate pass.
#define SHADE_FEATURES                                                                                       \
    (HAIR_GL_WITH(FIBRES) | HAIR_GL_WITH(ROOT_UV) | HAIR_GL_WITH(GROOM_COLORS) | HAIR_GL_WITH(OPAQUE_SHADOWS))

hair_result hair_draw_ensure_program(struct hair_renderer* renderer, hair_gl_pass pass,
                                     struct hair_gl_shader* shader, GLuint* out)
{
    if (shader) return hair_gl_ensure_user_program(renderer->gl, shader, pass, out);
    hair_result result = hair_gl_ensure_program(renderer->gl, pass);
    if (!result) *out = hair_gl_find(renderer->gl, pass)->program;
    return result;
}

hair_gl_pass hair_draw_find_passes(const struct hair_renderer* renderer, const hair_view* view,
                                   const struct hair_gl_shader* shader, hair_gl_pass* shade)
{
    HAIR_ASSERT((size_t)view->render_path < sizeof row_of_path / sizeof *row_of_path);
    hair_gl_pass features = features_of(renderer, view, shader), row = row_of_path[view->render_path];
    if (hair_draw_is_paired(view)) row = HAIR_GL_CACHED_PAIRED;
    *shade = 0;
    if (hair_draw_is_shaded(view, shader)) *shade = hair_gl_add_features(HAIR_GL_SHADE, features);
    if (hair_draw_uses_view_cache(view)) {
        int sides = hair_draw_caches_sides(view);
        *shade = hair_gl_add_features(sides ? HAIR_GL_EXPAND_VIEW_SIDES : HAIR_GL_EXPAND_VIEW, features);
        return hair_gl_add_features(sides ? HAIR_GL_VIEW_CACHED : row, features);
    }
    if (row == HAIR_GL_RESOLVE_TILES) return hair_gl_add_features(row, features);
    return !*shade ? row | features : row | (features & ~SHADE_FEATURES) | HAIR_GL_WITH(SHADED);
}
