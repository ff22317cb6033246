// look_test.c - followers do what the look specifies: fractions, radii and lengths. Disabled
// settings change no bit.
#include "tests/support/looks.h"
#include "tests/support/passes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/strands/geometry.h"

#define SEGMENTS 40u
#define EACH (SEGMENTS + 1)

static hair_look plain_look(void)
{
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    look.strays.tip_fraction = look.strays.fraction = 0;
    return look;
}

// Return the fraction of strands that have a moved vertex between `first` and `last`.
static double fraction_moved(const float* a, const float* b, size_t first, size_t last)
{
    uint32_t moved = 0;
    for (size_t n = 0; n < HAIR_TEST_LOOK_FOLLOWERS; ++n) {
        double max = 0;
        for (size_t k = first; k <= last; ++k) max = fmax(max, hair_test_distance_at(a, b, n * EACH + k));
        moved += max > 1e-6;
    }
    return (double)moved / HAIR_TEST_LOOK_FOLLOWERS;
}

static void stray_fraction_is_the_fraction_of_strays(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = plain_look();
    float* plain = hair_test_read_look(&f, &look);
    look.strays.tip_fraction = 0.3f;
    float* tips = hair_test_read_look(&f, &look);
    look.strays.tip_fraction = 0, look.strays.fraction = 0.1f;
    float* whole = hair_test_read_look(&f, &look);
    look.strays.tip_fraction = look.strays.fraction = 1;
    float* all = hair_test_read_look(&f, &look);
    print_message("    %.3f stray at their tips, %.3f all along\n", fraction_moved(plain, tips, 0, SEGMENTS),
                  fraction_moved(plain, whole, 0, SEGMENTS));
    // Tolerances are three standard deviations. For 4,000 strands they are 2.2 % at a fraction of
    // 30 %, and 1.4 % at 10 %.
    hair_test_near("tips", 0, fraction_moved(plain, tips, 0, SEGMENTS), 0.3, 0.022);
    hair_test_near("tips, in the first two fifths", 0, fraction_moved(plain, tips, 0, 2 * SEGMENTS / 5), 0,
                   0);
    hair_test_near("whole", 0, fraction_moved(plain, whole, 0, SEGMENTS), 0.1, 0.014);
    hair_test_near("whole, in the first half", 0, fraction_moved(plain, whole, 0, SEGMENTS / 2), 0.1, 0.014);
    hair_test_near("all", 0, fraction_moved(plain, all, 0, SEGMENTS), 1, 0);
    hair_test_near("roots", 0, fraction_moved(plain, all, 0, 0), 0, 0);
    free(plain), free(tips), free(whole), free(all);
    hair_test_scene_free(&f);
}

// Check the radius of curls all along the strand. Therefore the tip gets no nearer to the root.
static void strands_have_the_length_of_the_look(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = plain_look();
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    float* whole = hair_test_read_look(&f, &look);
    look.strand.length = 0.5f;
    float* half = hair_test_read_look(&f, &look);
    look.strand.length_variation = 0.8f;
    float* thinned = hair_test_read_look(&f, &look);
    double mean = 0;
    for (size_t n = 0; n < HAIR_TEST_LOOK_FOLLOWERS; ++n) {
        // A half strand has as many segments, so every second vertex is a vertex of the whole
        // strand.
        for (size_t k = 0; k <= SEGMENTS / 2; ++k)
            for (size_t i = 0; i < 3; ++i)
                hair_test_near("vertex", n, half[3 * (n * EACH + 2 * k) + i], whole[3 * (n * EACH + k) + i],
                               1e-6);
        size_t root = n * EACH, tip = root + SEGMENTS;
        double a = 0, b = 0;
        for (size_t i = 0; i < 3; ++i) {
            a += pow((double)half[3 * tip + i] - (double)half[3 * root + i], 2);
            b += pow((double)thinned[3 * tip + i] - (double)thinned[3 * root + i], 2);
        }
        mean += sqrt(b / a) / HAIR_TEST_LOOK_FOLLOWERS;
    }
    print_message("    thinned to %.3f on average\n", mean);
    // Lengths are uniformly distributed from 0.2 to 1.
    hair_test_near("thinned", 0, mean, 0.6, 0.03);
    free(whole), free(half), free(thinned);
    hair_test_scene_free(&f);
}

static void follower_without_offset_is_its_guide(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = plain_look();
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    look.clump.width = hair_curve_line(0, 0);
    float* positions = hair_test_read_look(&f, &look);
    uint32_t count, each = 2 * f.groom->max_vertices - 1;
    float* smooth = malloc(3 * sizeof *smooth * each * f.groom->info.guide_count);
    hair_test_ok(f.test, hair_read_positions(f.hair, HAIR_READ_SMOOTH, smooth,
                                             each * f.groom->info.guide_count, &count));
    for (size_t n = 0; n < HAIR_TEST_LOOK_FOLLOWERS; ++n)
        for (size_t k = 0; k < EACH; ++k) {
            const struct hair_follower* follower = &f.groom->followers[n];
            double u = (double)follower->length_ratio * (double)k / SEGMENTS * (each - 1);
            size_t at = follower->guide0 * each + (u < each - 2 ? (size_t)u : each - 2);
            double w = u - floor(fmin(u, each - 2)); // A straight guide continues beyond its tip.
            for (size_t i = 0; i < 3; ++i) {
                double expected = (1 - w) * smooth[3 * at + i] + w * smooth[3 * at + 3 + i];
                hair_test_near("coordinate", n, positions[3 * (n * EACH + k) + i], expected, 1e-6);
            }
        }
    free(positions), free(smooth);
    hair_test_scene_free(&f);
}

static void interpolation_modes_are_the_ends_of_the_blend(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = plain_look();
    for (int single = 0; single < 2; ++single) {
        look.clump.interpolation = single ? HAIR_INTERPOLATION_SINGLE : HAIR_INTERPOLATION_MULTI;
        float* pure = hair_test_read_look(&f, &look);
        look.clump.interpolation = HAIR_INTERPOLATION_MIXED;
        look.clump.weight = hair_curve_line((float)single, (float)single);
        float* mixed = hair_test_read_look(&f, &look);
        assert_memory_equal(pure, mixed, 3 * sizeof *pure * HAIR_TEST_LOOK_FOLLOWERS * EACH);
        free(pure), free(mixed);
    }
    hair_test_scene_free(&f);
}

static void disabled_look_has_no_effect_and_no_program(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = plain_look(), off = look;
    uint32_t styled = hair_test_runs_of(&f.test->context->gl, "_styled");
    size_t size = 3 * sizeof(float) * HAIR_TEST_LOOK_FOLLOWERS * EACH;
    float* plain = hair_test_read_look(&f, &look);
    // No strand strays.
    off.strays.tip_distance = off.strays.distance = hair_curve_line(0.1f, 0.2f);
    off.strays.frizz_wavelength = 0.1f;
    off.curl.profile = hair_curve_line(2, 1); // The radius is 0.
    off.curl.wavelength = 0.01f;
    off.curl.turns = 7, off.curl.flatness = 0.5f, off.curl.left_fraction = 0.5f, off.curl.strand_phase = 1,
    off.curl.spread = 0.5f;
    float* same = hair_test_read_look(&f, &off);
    assert_memory_equal(plain, same, size);
    off.strays.tip_fraction = off.strays.fraction = 1;
    off.strays.tip_distance = off.strays.distance = hair_curve_line(0, 0); // The distance is 0.
    off.curl.radius = 0.1f;
    off.curl.profile = hair_curve_line(0, 0);
    free(same);
    same = hair_test_read_look(&f, &off);
    assert_memory_equal(plain, same, size);
    assert_int_equal(hair_test_runs_of(&f.test->context->gl, "_styled"), styled);
    off.curl.profile = hair_curve_line(0, 0.1f);
    free(same);
    same = hair_test_read_look(&f, &off);
    assert_memory_not_equal(plain, same, size);
    assert_true(hair_test_runs_of(&f.test->context->gl, "_styled") == styled + 1);
    free(plain), free(same);
    hair_test_scene_free(&f);
}

static void invalid_looks_are_refused_by_name(void** state)
{
    struct hair_test_scene f = hair_test_look_scene(*state, 7);
    hair_look look = plain_look();
    look.strand.taper.at[3] = NAN;
    hair_test_refused(f.test, hair_set_look(f.hair, &look), HAIR_ERROR_ARGUMENT,
                      "hair_look.strand.taper.at[3]");
    look = plain_look();
    look.curl.radius = -1;
    hair_test_refused(f.test, hair_set_look(f.hair, &look), HAIR_ERROR_ARGUMENT,
                      "hair_look.curl.radius is -1, not in [0, 0.1");
    look = plain_look();
    look.curl.profile_x[15] = 1.5f;
    hair_test_refused(f.test, hair_set_look(f.hair, &look), HAIR_ERROR_ARGUMENT,
                      "hair_look.curl.profile_x[15] is 1.5");
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(stray_fraction_is_the_fraction_of_strays),
        HAIR_TEST(strands_have_the_length_of_the_look),
        HAIR_TEST(follower_without_offset_is_its_guide),
        HAIR_TEST(interpolation_modes_are_the_ends_of_the_blend),
        HAIR_TEST(disabled_look_has_no_effect_and_no_program),
        HAIR_TEST(invalid_looks_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
