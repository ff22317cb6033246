// divided_draws_test.c - what a GPU takes long to draw is divided into many draws, which draw the
// same bits.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"
#include "tests/support/trace.h"

#define SIDE 64 // pixels
#define SEGMENTS 20
#define FIVE_INSTANCES (5 * 2 * HAIR_INSTANCE_STRANDS * (SEGMENTS + 1)) // vertices

// Draw with at most `max` vertices in a draw. Return the number of draws.
static uint32_t draw_in_parts(const struct hair_test_scene* scene, const hair_view* view, uint32_t max,
                              float* pixels)
{
    scene->context->gl.draw_vertices = max;
    hair_test_trace_clear();
    hair_test_draw(scene, view, SIDE, SIDE, view->primitive == HAIR_PRIMITIVE_LINES ? 0 : 4, pixels, NULL);
    return hair_test_trace_count("glDraw") + hair_test_trace_count("glMultiDraw");
}

static struct hair_test_scene start(struct hair_test* test)
{
    struct hair_test_scene scene = hair_test_scene_make(test, hair_test_trace_proc);
    struct hair_test_handmade groom = hair_test_handmade_default();
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    groom.followers = 1000;
    look.strand.segments = SEGMENTS;
    desc.look = &look;
    hair_test_scene_add(&scene, &groom, &desc);
    return scene;
}

// Compare a view with one whose draws are as small as can be. Where draws blend, the order of
// segments with equal distances may differ.
static void check_divided(const struct hair_test_scene* scene, const hair_view* view, const char* name,
                          bool is_sorted)
{
    static float whole[4 * SIDE * SIDE], divided[4 * SIDE * SIDE];
    uint32_t count = draw_in_parts(scene, view, UINT32_MAX, whole);
    uint32_t more = draw_in_parts(scene, view, 1, divided);
    double alpha = hair_test_mean_alpha(whole, sizeof whole / sizeof *whole);
    float away = hair_test_max_difference(whole, divided, sizeof whole / sizeof *whole);
    print_message("    %s, primitive %d: %u draws, divided %u, mean alpha %.4f, %.3g\n", name,
                  view->primitive, count, more, alpha, (double)away);
    assert_true(more >= 8 && more >= 4 * count && alpha > 0.005);
    if (!is_sorted) assert_memory_equal(whole, divided, sizeof whole);
    assert_true(away <= 0.02f);
    draw_in_parts(scene, view, FIVE_INSTANCES, divided); // No draw of the parts before is left.
    if (!is_sorted) assert_memory_equal(whole, divided, sizeof whole);
    assert_true(hair_test_max_difference(whole, divided, sizeof whole / sizeof *whole) <= 0.02f);
}

static void divided_draws_draw_the_same_bits(void** state)
{
    static const struct {
        const char* name;
        int path;
        hair_pass pass;
        hair_coverage coverage;
        bool has_lod;
    } views[] = {
        {"tessellation", HAIR_TEST_TESSELLATION, HAIR_PASS_COLOR, 0, false},
        {"procedural", HAIR_TEST_PROCEDURAL, HAIR_PASS_COLOR, 0, false},
        {"cached", HAIR_TEST_CACHED, HAIR_PASS_COLOR, 0, false},
        {"level of detail", HAIR_TEST_CACHED, HAIR_PASS_COLOR, 0, true},
        {"opacity", HAIR_TEST_CACHED, HAIR_PASS_OPACITY, 0, false},
        {"sorted", HAIR_TEST_CACHED, HAIR_PASS_COLOR, HAIR_COVERAGE_ALPHA, false},
    };
    struct hair_test_scene scene = start(*state);
    hair_lod lod = hair_lod_default();
    lod.per_patch = false;
    lod.strand_fraction = 0.7f;
    lod.segment_fraction = 0.4f;
    for (size_t i = 0; i < sizeof views / sizeof *views; ++i)
        for (int primitive = 0; primitive < 2; ++primitive) {
            hair_view view = hair_test_view_by(hair_test_paths[views[i].path]);
            hair_test_set_orthographic(&view, 4, 0.5f, 0);
            view.primitive = (hair_primitive)primitive;
            view.pass = views[i].pass;
            view.coverage = views[i].coverage;
            if (views[i].has_lod) view.lod = &lod;
            check_divided(&scene, &view, views[i].name, views[i].coverage != 0);
        }
    hair_test_scene_free(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(divided_draws_draw_the_same_bits)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
