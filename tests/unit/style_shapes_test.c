// style_shapes_test.c - shapes of built-in haircuts: a bun is wound, strands of a braid cross, a
// fringe ends above the brows, a fade has stubble at its edge, and short hair leaves the face.
#include "lib/groom/style_body.h"
#include "tests/support/cut.h"
#include "tests/support/support.h"

#include <math.h>

#define PI 3.14159265f

static struct hair_test_host test;

static const hair_vec3 tie = {0, 1.672f, -0.106f}, axis = {0, 0.243f, -0.970f};

static hair_vec3 vertex(const struct hair_test_cut* cut, uint32_t guide, uint32_t i)
{
    return hair_load3(cut->info.positions + 3 * ((size_t)guide * cut->each + i));
}

static float guide_length(const struct hair_test_cut* cut, uint32_t guide)
{
    float length = 0;
    for (uint32_t i = 1; i < cut->each; ++i)
        length += hair_distance(vertex(cut, guide, i), vertex(cut, guide, i - 1));
    return length;
}

// Return the angle around the axis of the tie, and write the distance from the axis.
static float angle_at_tie(hair_vec3 p, float* away)
{
    hair_vec3 from = hair_sub(p, tie), up = hair_cross(hair_v3(1, 0, 0), axis);
    float x = from.x, y = hair_dot(from, up);
    *away = sqrtf(x * x + y * y);
    return atan2f(y, x);
}

static void a_bun_is_wound_around_the_tie(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_BUN);
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        float turns = 0, away, before = 0;
        for (uint32_t k = cut.each / 2; k < cut.each; ++k) {
            hair_vec3 p = vertex(&cut, i, k);
            float angle = angle_at_tie(p, &away), step = remainderf(angle - before, 2 * PI);
            float out = hair_dot(hair_sub(p, tie), axis);
            assert_true(away < 0.048f && out > -0.020f && out < 0.042f);
            assert_true(hair_body_distance(p) > 0.002f);
            if (k > cut.each / 2) turns += step / (2 * PI);
            before = angle;
        }
        // All hair winds the same way.
        assert_true(turns > 1 && turns < 3);
    }
    hair_asset_destroy(cut.asset);
}

// Each strand of a braid lies on the left, in the middle and on the right in turn.
static void strands_of_a_braid_cross_from_side_to_side(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_BRAID);
    uint32_t lefts = 0, rights = 0, all = 0;
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        uint32_t crossings = 0;
        int side = 0;
        float middle = 0;
        for (uint32_t k = cut.each / 2; k < cut.each; ++k)
            middle += vertex(&cut, i, k).x / (float)(cut.each - cut.each / 2);
        for (uint32_t k = cut.each / 2; k < cut.each; ++k) {
            hair_vec3 p = vertex(&cut, i, k);
            assert_true(fabsf(p.x) < 0.026f && hair_body_distance(p) > 0.002f);
            float x = p.x - middle;
            if (fabsf(x) < 0.004f) continue;
            crossings += (float)side * x < 0;
            side = x > 0 ? 1 : -1;
        }
        assert_true(crossings >= 2);
        all += crossings;
        // At one height, m, hair is on both sides.
        uint32_t k = cut.each - 1;
        while (k > 1 && vertex(&cut, i, k - 1).y < 1.45f) --k;
        float x = vertex(&cut, i, k).x;
        lefts += x > 0.005f, rights += x < -0.005f;
    }
    assert_true(all > 3 * cut.info.strand_count);
    assert_true(lefts > cut.info.strand_count / 6 && rights > cut.info.strand_count / 6);
    hair_asset_destroy(cut.asset);
}

// The tips of a braid are tied.
static void a_braid_is_narrow_at_its_end(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_BRAID);
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        hair_vec3 tip = vertex(&cut, i, cut.each - 1);
        assert_true(fabsf(tip.x) < 0.014f && tip.y < 1.40f);
    }
    hair_asset_destroy(cut.asset);
}

static void a_fringe_ends_above_the_brows(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_FRINGE);
    uint32_t fringe = 0, low = 0;
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        hair_vec3 tip = vertex(&cut, i, cut.each - 1);
        bool front = tip.z > 0.035f && fabsf(tip.x) < 0.050f;
        assert_true(!front || tip.y > 1.612f);
        fringe += front && tip.y < 1.645f;
        low += tip.y < 1.55f;
    }
    assert_true(fringe >= 10 && low >= 80); // The sides and the back are a bob.
    hair_asset_destroy(cut.asset);
}

static void a_fade_is_long_on_top_and_stubble_at_the_edge(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_FADE);
    uint32_t stubble = 0, longer = 0;
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        float length = guide_length(&cut, i), height = vertex(&cut, i, 0).y;
        if (height < 1.60f) assert_true(length < 0.0065f);
        if (height > 1.715f) assert_true(length > 0.045f);
        stubble += height<1.60f, longer += height> 1.715f;
    }
    assert_true(stubble >= 10 && longer >= 5);
    hair_asset_destroy(cut.asset);
}

// Short hair of the temples is combed off the face. Hair that ran along the hairline drew the
// outline of a wig.
static void short_hair_leaves_the_temples(void** state)
{
    (void)state;
    const hair_style styles[] = {HAIR_STYLE_SHORT, HAIR_STYLE_FADE};
    const float limits[] = {0.55f, 0.46f};
    for (uint32_t s = 0; s < 2; ++s) {
        struct hair_test_cut cut = hair_test_cut_style(&test, styles[s]);
        float back = 0, count = 0;
        for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
            hair_vec3 root = vertex(&cut, i, 0), tip = vertex(&cut, i, cut.each - 1),
                      unit = hair_skull_unit(root);
            float azimuth = fabsf(atan2f(unit.x, unit.z)) * (180 / PI);
            if (azimuth < 35 || azimuth > 75 || root.y > 1.69f) continue;
            back += (root.z - tip.z) / guide_length(&cut, i), count += 1;
        }
        print_message("    %s: %.0f guides of the temples run back by %.2f of their length\n",
                      hair_style_name(styles[s]), (double)count, (double)(back / count));
        assert_true(count >= 6 && back / count > limits[s]);
        hair_asset_destroy(cut.asset);
    }
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_bun_is_wound_around_the_tie),
        TEST(strands_of_a_braid_cross_from_side_to_side),
        TEST(a_braid_is_narrow_at_its_end),
        TEST(a_fringe_ends_above_the_brows),
        TEST(a_fade_is_long_on_top_and_stubble_at_the_edge),
        TEST(short_hair_leaves_the_temples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
