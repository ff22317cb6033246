// variant.c - choice of the program variants that a look and a view need.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

static const hair_gl_pass row_of_path[] = {[HAIR_RENDER_PATH_TESSELLATION] = HAIR_GL_TESSELLATED,
                                           [HAIR_RENDER_PATH_INSTANCED] = HAIR_GL_INSTANCED,
                                           [HAIR_RENDER_PATH_CACHED] = HAIR_GL_CACHED,
                                           [HAIR_RENDER_PATH_COMPUTE] = HAIR_GL_RESOLVE_TILES};

hair_gl_pass hair_draw_styled(const struct hair_draw* draw, hair_gl_pass pass)
{
    return hair_look_is_styled(&draw->look) ? hair_gl_add_features(pass, HAIR_GL_WITH(STYLED)) : pass;
}

hair_gl_pass hair_draw_choose(const struct hair_draw* draw, hair_gl_pass pass)
{
    if (draw->follower_collision.active && draw->push_out_weight > 0)
        pass = hair_gl_add_features(pass, HAIR_GL_WITH(HITS));
    return hair_draw_styled(draw, pass);
}

hair_result hair_draw_ensure(struct hair_draw* draw, hair_gl_pass* pass)
{
    *pass = hair_draw_choose(draw, *pass);
    return hair_gl_ensure_program(draw->gl, *pass);
}

bool hair_draw_is_textured(const struct hair_draw* draw, const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && view->color_texture && hair_draw_has_uvs(draw);
}

bool hair_draw_is_painted(const struct hair_draw* draw, const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && draw->groom_color && draw->look.groom_colors > 0;
}

bool hair_draw_wants_uvs(const struct hair_draw* draw, const hair_view* view,
                         const struct hair_gl_shader* shader)
{
    return hair_draw_is_textured(draw, view) || (shader && hair_draw_has_uvs(draw));
}

static hair_gl_pass features_of(const struct hair_draw* draw, const hair_view* view,
                                const struct hair_gl_shader* shader)
{
    hair_gl_pass features = 0;
    if (view->pass == HAIR_PASS_DEPTH || view->pass == HAIR_PASS_OPACITY) features |= HAIR_GL_WITH(DEPTH);
    if (view->pass == HAIR_PASS_ID) features |= HAIR_GL_WITH(IDS);
    if (view->pass == HAIR_PASS_MOTION) features |= HAIR_GL_WITH(MOTION);
    if (view->pass == HAIR_PASS_COLOR && draw->look.shading == HAIR_SHADING_FIBRES)
        features |= HAIR_GL_WITH(FIBRES);
    if (hair_draw_uses_analytic_coverage(view))
        features |= HAIR_GL_WITH(ALPHA_COVERAGE);
    else if (view->primitive == HAIR_PRIMITIVE_LINES)
        features |= HAIR_GL_WITH(LINES);
    if (view->lod) features |= HAIR_GL_WITH(WIDENED);
    if (hair_draw_is_blocked(view)) features |= HAIR_GL_WITH(OPAQUE_SHADOWS);
    if (hair_draw_wants_uvs(draw, view, shader)) features |= HAIR_GL_WITH(ROOT_UV);
    if (hair_draw_is_painted(draw, view)) features |= HAIR_GL_WITH(GROOM_COLORS);
    return features;
}

// Features of shading, for views that shade vertices in a separate pass.
#define SHADE_FEATURES                                                                                       \
    (HAIR_GL_WITH(FIBRES) | HAIR_GL_WITH(ROOT_UV) | HAIR_GL_WITH(GROOM_COLORS) | HAIR_GL_WITH(OPAQUE_SHADOWS))

hair_result hair_draw_ensure_program(struct hair_draw* draw, hair_gl_pass pass, struct hair_gl_shader* shader,
                                     GLuint* out)
{
    if (shader) return hair_gl_ensure_user_program(draw->gl, shader, pass, out);
    hair_result result = hair_gl_ensure_program(draw->gl, pass);
    if (!result) *out = hair_gl_find(draw->gl, pass)->program;
    return result;
}

hair_gl_pass hair_draw_find_passes(const struct hair_draw* draw, const hair_view* view,
                                   const struct hair_gl_shader* shader, hair_gl_pass* shade)
{
    HAIR_ASSERT((size_t)view->render_path < sizeof row_of_path / sizeof *row_of_path);
    hair_gl_pass features = features_of(draw, view, shader), row = row_of_path[view->render_path];
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
