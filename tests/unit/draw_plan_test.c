// draw_plan_test.c - plans of views: every combination of a view's settings gives the method that
// hair_view.h documents, and passes that fit it.
#include "tests/support/render_paths.h"
#include "tests/support/support.h"

#include <string.h>

#include "lib/draw/batch.h"
#include "lib/draw/draw.h"

static const hair_pass passes[] = {HAIR_PASS_COLOR, HAIR_PASS_DEPTH, HAIR_PASS_MOTION, HAIR_PASS_ID,
                                   HAIR_PASS_OPACITY};
#define PASSES ((int)(sizeof passes / sizeof *passes))

struct fixture {
    struct hair_geometry geometry;
    hair_groom groom;
    struct hair_lengths lengths;
    struct hair_lighting lighting;
    struct hair_renderer renderer;
    struct hair_batch batch;
    struct hair_gl_shader shader;
    struct hair_gl gl;
    hair_lod lod;
    hair_light light;
};

static struct fixture* start(void)
{
    static struct fixture f;
    memset(&f, 0, sizeof f);
    f.gl.draw_state.depth_function = GL_LESS; // Pixels have one sample, and depth is not tested.
    f.renderer.gl = &f.gl;
    f.renderer.geometry = &f.geometry;
    f.renderer.lighting = &f.lighting;
    f.renderer.batch = &f.batch;
    f.geometry.groom = &f.groom;
    f.geometry.look = hair_look_default();
    f.geometry.lengths = &f.lengths;
    f.lod = hair_lod_default();
    f.light = hair_light_default();
    return &f;
}

// Settings of a view, as digits of a number.
#define VIEWS (PASSES * HAIR_TEST_PATHS * 2 * 2 * 2 * 3 * 2)

struct settings {
    hair_view view;
    struct hair_gl_shader* shader;
};

static struct settings settings_of(struct fixture* f, int number)
{
    struct settings s = {hair_view_default(), NULL};
    s.view.pass = passes[number % PASSES];
    number /= PASSES;
    s.view.render_path = hair_test_paths[number % HAIR_TEST_PATHS];
    number /= HAIR_TEST_PATHS;
    s.view.lod = number % 2 ? &f->lod : NULL;
    s.view.primitive = (hair_primitive)(number / 2 % 2);
    s.view.coverage = (hair_coverage)(number / 4 % 2);
    s.view.motion_output = number / 24 % 2;
    if (number / 8 % 3) s.shader = &f->shader;
    f->shader.pixels = number / 8 % 3 == 2;
    s.view.lights = &f->light;
    return s;
}

static bool is_blended(const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && view->coverage == HAIR_COVERAGE_ALPHA;
}

static void plans_take_the_path_that_the_header_documents(void** state)
{
    (void)state;
    struct fixture* f = start();
    for (int i = 0; i < VIEWS; ++i) {
        struct settings s = settings_of(f, i);
        const hair_view* view = &s.view;
        struct hair_draw_plan plan;
        bool has_colour_or_depth = view->pass == HAIR_PASS_COLOR || view->pass == HAIR_PASS_DEPTH;
        bool by_pixel = s.shader && s.shader->pixels;
        hair_render_path path = view->render_path;
        hair_draw_make_plan(&f->renderer, view, s.shader, &plan);
        if (path == HAIR_RENDER_PATH_COMPUTE && view->pass != HAIR_PASS_OPACITY &&
            (!has_colour_or_depth || view->primitive == HAIR_PRIMITIVE_LINES || by_pixel))
            path = HAIR_RENDER_PATH_CACHED;
        if (path == HAIR_RENDER_PATH_CACHED && view->lod && (!has_colour_or_depth || s.shader))
            path = HAIR_RENDER_PATH_PROCEDURAL;
        bool has_motion =
            view->pass == HAIR_PASS_MOTION || (view->pass == HAIR_PASS_COLOR && view->motion_output);
        if (is_blended(view) || (has_motion && (path != HAIR_RENDER_PATH_COMPUTE || view->lod)))
            path = HAIR_RENDER_PATH_CACHED;
        if (plan.path != path) fail_msg("view %d takes path %d, not %d", i, plan.path, path);
        assert_int_equal(plan.is_computed, path == HAIR_RENDER_PATH_COMPUTE);
        assert_int_equal(plan.has_strand_list, path != HAIR_RENDER_PATH_TESSELLATION);
        assert_int_equal(plan.blending == HAIR_BLENDING_SORTED, is_blended(view));
        assert_int_equal(plan.blending == HAIR_BLENDING_UNSORTED, view->pass == HAIR_PASS_OPACITY);
        if (plan.vertices == HAIR_VERTICES_PER_VIEW) assert_non_null(view->lod);
        if (plan.vertices == HAIR_VERTICES_CACHED && view->lod) assert_true(has_motion || is_blended(view));
    }
}

static bool has_pass(const struct hair_draw_plan* plan, hair_gl_pass row)
{
    for (uint32_t i = 0; i < plan->pass_count; ++i)
        if (hair_gl_row_label(plan->pass[i]) == hair_gl_row_label(row)) return true;
    return false;
}

static void passes_of_plans_make_what_later_passes_read(void** state)
{
    (void)state;
    struct fixture* f = start();
    for (int i = 0; i < 2 * VIEWS; ++i) {
        struct settings s = settings_of(f, i % VIEWS);
        struct hair_draw_plan plan;
        f->geometry.look.self_shadow.method = i < VIEWS ? HAIR_SELF_SHADOW_DEPTH : HAIR_SELF_SHADOW_STRANDS;
        hair_draw_make_plan(&f->renderer, &s.view, s.shader, &plan);
        hair_draw_find_passes(&f->renderer, HAIR_GL_WITH(OCCLUSION) | HAIR_GL_WITH(HITS), &plan);
        bool is_lit = i >= VIEWS && s.view.pass == HAIR_PASS_COLOR;
        bool is_per_view = plan.vertices == HAIR_VERTICES_PER_VIEW;
        assert_true(plan.pass[plan.pass_count - 1] == plan.draw);
        assert_true(has_pass(&plan, HAIR_GL_CULL_PATCHES));
        assert_int_equal(has_pass(&plan, HAIR_GL_COMPACT_STRANDS), plan.has_strand_list);
        assert_int_equal(has_pass(&plan, HAIR_GL_VERTEX_TRANSMITTANCE), is_lit);
        assert_int_equal(has_pass(&plan, HAIR_GL_EXPAND), is_lit || plan.vertices == HAIR_VERTICES_CACHED);
        assert_int_equal(has_pass(&plan, HAIR_GL_EXPAND_DRAWN), is_lit && s.view.lod);
        assert_int_equal(has_pass(&plan, HAIR_GL_VERTEX_TRANSMITTANCE_DRAWN), is_lit && s.view.lod);
        assert_int_equal(has_pass(&plan, HAIR_GL_RASTER), plan.is_computed);
        assert_int_equal(has_pass(&plan, HAIR_GL_COMPOSE_TILES), plan.is_computed);
        assert_int_equal(has_pass(&plan, HAIR_GL_RESOLVE_TILES), plan.is_computed);
        assert_int_equal(has_pass(&plan, HAIR_GL_SCATTER), plan.blending == HAIR_BLENDING_SORTED);
        assert_int_equal(has_pass(&plan, HAIR_GL_EXPAND_VIEW) || has_pass(&plan, HAIR_GL_EXPAND_VIEW_SIDES),
                         is_per_view);
        assert_int_equal((plan.draw & HAIR_GL_WITH(SHADED)) != 0,
                         has_pass(&plan, HAIR_GL_SHADE) && !plan.is_computed);
        if (s.shader && s.shader->pixels) assert_false(has_pass(&plan, HAIR_GL_SHADE));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_take_the_path_that_the_header_documents),
        cmocka_unit_test(passes_of_plans_make_what_later_passes_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
