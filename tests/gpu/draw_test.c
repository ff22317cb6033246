// draw_test.c - the framebuffer after hair_draw: colour and depth agree, and ribbons have their
// true width.
#include "tests/support/scene.h"
#include "tests/support/tessellated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 128

static struct hair_test_scene start(void** state, float radius)
{
    hair_look look = hair_look_default();
    look.strand.radius = radius;
    look.strand.taper = hair_curve_line(1, 1);
    return hair_test_scene_of(*state, NULL, &look);
}

// Make a view of 1 m around the head, along -z.
static hair_view view_of(hair_pass pass, hair_primitive primitive)
{
    hair_view view = hair_test_tessellated();
    view.pass = pass;
    view.primitive = primitive;
    hair_test_set_orthographic(&view, 2, -0.5f, -0.2f);
    return view;
}

static void draw(const struct hair_test_scene* f, const hair_view* view, GLsizei side, GLsizei samples,
                 float* pixels, float* depths)
{
    hair_test_draw(f, view, side, side, samples, pixels, depths);
}

static void colour_and_depth_passes_leave_the_same_depth(void** state)
{
    static float pixels[4 * SIDE * SIDE], none[4 * SIDE * SIDE], depths[2][SIDE * SIDE];
    struct hair_test_scene f = start(state, 0.002f);
    for (int primitive = 0; primitive < 2; ++primitive) {
        hair_view color = view_of(HAIR_PASS_COLOR, (hair_primitive)primitive);
        hair_view depth = view_of(HAIR_PASS_DEPTH, (hair_primitive)primitive);
        draw(&f, &color, SIDE, 0, pixels, depths[0]);
        draw(&f, &depth, SIDE, 0, none, depths[1]);
        int covered = 0;
        for (int i = 0; i < SIDE * SIDE; ++i) {
            int hit = depths[0][i] < 1;
            covered += hit;
            assert_true(depths[0][i] == depths[1][i]);
            assert_true((pixels[4 * i + 3] > 0) == hit);
            for (int c = 0; c < 3; ++c) assert_true(isfinite(pixels[4 * i + c]) && pixels[4 * i + c] >= 0);
        }
        assert_true(covered > 150);
    }
    hair_test_scene_free(&f);
}

static double coverage(const float* pixels, GLsizei side)
{
    return hair_test_mean_alpha(pixels, (size_t)(4 * side * side));
}

// Check that four samples per pixel cover the same area as sixteen pixels in its place. Ribbons of
// about a pixel have their true width in both.
static void multisampling_and_supersampling_see_the_same_width(void** state)
{
    static float pixels[4 * SIDE * SIDE], fine[16 * 4 * SIDE * SIDE];
    struct hair_test_scene f = start(state, 0.002f);
    hair_view view = view_of(HAIR_PASS_COLOR, HAIR_PRIMITIVE_RIBBONS);
    draw(&f, &view, SIDE, 4, pixels, NULL);
    draw(&f, &view, 4 * SIDE, 0, fine, NULL);
    double coarse = coverage(pixels, SIDE), true_one = coverage(fine, 4 * SIDE);
    print_message("    covered: %.5f with 4 samples, %.5f in small pixels\n", coarse, true_one);
    assert_true(true_one > 0.01);
    hair_test_near("coverage", 0, coarse, true_one, 0.03 * true_one);
    hair_test_scene_free(&f);
}

static void a_wider_strand_covers_more(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    double covered[2];
    for (int wide = 0; wide < 2; ++wide) {
        struct hair_test_scene f = start(state, wide ? 0.004f : 0.0005f);
        hair_view view = view_of(HAIR_PASS_COLOR, HAIR_PRIMITIVE_RIBBONS);
        draw(&f, &view, SIDE, 4, pixels, NULL);
        covered[wide] = coverage(pixels, SIDE);
        hair_test_scene_free(&f);
    }
    assert_true(covered[1] > 2 * covered[0]);
}

// Check that guides are grey at rest, and red where they are stretched. Here all guides are
// stretched by a tenth.
static void guides_are_colored_by_their_stretch(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state, 0.001f);
    hair_view view = view_of(HAIR_PASS_GUIDES, HAIR_PRIMITIVE_RIBBONS);
    for (int stretched = 0; stretched < 2; ++stretched) {
        if (stretched) {
            size_t count = f.groom->info.guide_vertex_count;
            struct hair_state* vertices = calloc(count, sizeof *vertices);
            for (size_t i = 0; i < count; ++i) {
                hair_vec4 p = f.groom->rest[i].position;
                vertices[i].position = (hair_vec4){1.1f * p.x, 1.1f * p.y, 1.1f * p.z, 0};
            }
            hair_test_scene_set_state(&f, vertices);
            free(vertices);
        }
        draw(&f, &view, SIDE, 0, pixels, NULL);
        int drawn = 0;
        for (int i = 0; i < SIDE * SIDE; ++i) {
            const float* p = pixels + 4 * i;
            if (p[3] == 0) continue;
            ++drawn;
            hair_test_near("red", (size_t)i, p[0], stretched ? 1 : 0.5, 0.01);
            hair_test_near("blue", (size_t)i, p[2], stretched ? 0.05 : 0.5, 0.01);
        }
        assert_true(drawn > 50);
    }
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(colour_and_depth_passes_leave_the_same_depth),
        HAIR_TEST(multisampling_and_supersampling_see_the_same_width),
        HAIR_TEST(a_wider_strand_covers_more),
        HAIR_TEST(guides_are_colored_by_their_stretch),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
