// alpha_coverage_test.c - pixels blend strands by coverage. The coverage agrees with finer pixels,
// and the nearest strand is in front in any order of strands. Blending respects colour and depth
// that are already there. Without coverage, nothing runs.
#include "tests/support/scene.h"
#include "tests/support/tessellated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 96
#define FINE 8
#define WIDE 384 // Strands are seven pixels wide at this size.

static struct hair_test_scene start(void** state, uint32_t followers, float radius)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_look look = hair_look_default();
    wanted.followers = followers;
    look.strand.radius = radius;
    look.strand.taper = hair_curve_line(1, 1);
    look.shading.model = HAIR_SHADING_LINES;
    return hair_test_scene_of(*state, &wanted, &look);
}

// Make a view of 1 m around the head, along -z.
static hair_view view_of(hair_coverage coverage)
{
    hair_view view = hair_test_tessellated();
    view.coverage = coverage;
    hair_test_set_orthographic(&view, 2, -0.5f, -0.2f);
    return view;
}

static void draw(const struct hair_test_scene* f, const hair_view* view, GLsizei side, GLsizei samples,
                 float* pixels)
{
    hair_test_draw(f, view, side, side, samples, pixels, NULL);
}

static double mean_alpha(const float* pixels, GLsizei side)
{
    return hair_test_mean_alpha(pixels, (size_t)(4 * side * side));
}

// Check few strands, so that two rarely share a pixel. A pixel is 1/48 m.
static void alpha_of_any_width_equals_supersampled_coverage(void** state)
{
    static float pixels[4 * SIDE * SIDE], fine[4 * SIDE * FINE * SIDE * FINE];
    static const float widths[] = {0.08f, 0.25f, 0.5f, 1, 1.5f};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; ++i) {
        // Finer pixels than these underestimate thinner strands, so coverage is taken to be
        // proportional to the width.
        float seen = fmaxf(widths[i], 0.5f), pixel = 1.0f / SIDE;
        struct hair_test_scene f = start(state, 5, 0.5f * seen * pixel);
        hair_view view = view_of(HAIR_COVERAGE_MSAA);
        draw(&f, &view, FINE * SIDE, 4, fine);
        double expected = mean_alpha(fine, FINE * SIDE) * (double)(widths[i] / seen);
        hair_test_scene_free(&f);
        f = start(state, 5, 0.5f * widths[i] * pixel);
        view.coverage = HAIR_COVERAGE_ALPHA;
        for (GLsizei samples = 0; samples <= 4; samples += 4) {
            draw(&f, &view, SIDE, samples, pixels);
            double covered = mean_alpha(pixels, SIDE);
            print_message("    %g px, %d samples: %.6f, expected %.6f\n", (double)widths[i], samples, covered,
                          expected);
            hair_test_near("coverage", i, covered / expected, 1, 0.04);
        }
        view.opacity = 0.25f;
        draw(&f, &view, SIDE, 0, pixels);
        hair_test_near("coverage at a quarter of the opacity", i, mean_alpha(pixels, SIDE) / expected, 0.25,
                       0.012);
        hair_test_scene_free(&f);
    }
}

// Check wide strands. The nearest strand alone covers whole pixels, as with opaque strands.
static void the_nearest_strand_is_in_front(void** state)
{
    static float opaque[4 * WIDE * WIDE], fractions[4 * WIDE * WIDE];
    struct hair_test_scene f = start(state, 64, 0.009f);
    hair_view view = view_of(HAIR_COVERAGE_MSAA);
    for (int lod = 0; lod < 2; ++lod) {
        hair_lod part = hair_lod_default();
        part.per_patch = false, part.strand_fraction = 0.7f, part.segment_fraction = 0.5f;
        view.render_path = HAIR_RENDER_PATH_PROCEDURAL;
        view.lod = lod ? &part : NULL;
        view.coverage = HAIR_COVERAGE_MSAA;
        draw(&f, &view, WIDE, 4, opaque);
        view.coverage = HAIR_COVERAGE_ALPHA;
        draw(&f, &view, WIDE, 0, fractions);
        double off = 0;
        uint32_t covered = 0;
        for (int i = 0; i < WIDE * WIDE; ++i) {
            if (opaque[4 * i + 3] < 1) continue;
            ++covered;
            for (int k = 0; k < 3; ++k)
                off += fabs((double)opaque[4 * i + k] - (double)fractions[4 * i + k]) / 3;
        }
        double sum = 0;
        for (int i = 0; i < WIDE * WIDE; ++i) sum += opaque[4 * i + 3] < 1 ? 0 : (double)opaque[4 * i + 1];
        print_message("    %u pixels, off by %.4f of the mean\n", covered, off / sum);
        assert_true(covered > 1000);
        assert_true(off / sum < 0.06); // Edges within pixels differ between 4 samples and coverage.
    }
    hair_test_scene_free(&f);
}

static void nearer_geometry_depth_and_state_stay_as_they_were(void** state)
{
    static float pixels[4 * SIDE * SIDE], depths[SIDE * SIDE];
    static const float near = 0.2f, blue[4] = {0, 0, 0.5f, 1};
    struct hair_test_scene f = start(state, 64, 0.002f);
    hair_view view = view_of(HAIR_COVERAGE_ALPHA);
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    glClearNamedFramebufferfv(frame.framebuffer, GL_DEPTH, 0, &near);
    glClearNamedFramebufferfv(frame.framebuffer, GL_COLOR, 0, blue);
    hair_test_blend_begin();
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    assert_true(hair_test_blend_end());
    hair_test_frame_read(&frame, pixels);
    for (int i = 0; i < SIDE * SIDE; ++i) assert_true(pixels[4 * i] == 0 && pixels[4 * i + 2] == 0.5f);
    hair_test_frame_free(&frame);
    hair_test_draw(&f, &view, SIDE, SIDE, 0, pixels, depths);
    double covered = mean_alpha(pixels, SIDE);
    assert_true(covered > 0.005);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        assert_true(depths[i] == 1);
        assert_true(pixels[4 * i + 3] >= 0 && pixels[4 * i + 3] <= 1.0001f);
    }
    hair_test_scene_free(&f);
}

static void segments_are_not_sorted_without_alpha_coverage(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    struct hair_test_scene f = start(state, 64, 0.002f);
    hair_view view = view_of(HAIR_COVERAGE_MSAA);
    view.render_path = HAIR_RENDER_PATH_CACHED;
    draw(&f, &view, SIDE, 0, pixels);
    assert_int_equal(f.hair->renderer.sorted_segments.bucket, 0);
    assert_int_equal(f.hair->renderer.sorted_segments.index, 0);
    view.coverage = HAIR_COVERAGE_ALPHA;
    view.pass = HAIR_PASS_DEPTH; // This pass has no coverage.
    draw(&f, &view, SIDE, 0, pixels);
    assert_int_equal(f.hair->renderer.sorted_segments.bucket, 0);
    hair_test_scene_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(alpha_of_any_width_equals_supersampled_coverage),
        HAIR_TEST(the_nearest_strand_is_in_front),
        HAIR_TEST(nearer_geometry_depth_and_state_stay_as_they_were),
        HAIR_TEST(segments_are_not_sorted_without_alpha_coverage),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
