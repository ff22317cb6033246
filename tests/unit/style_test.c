// style_test.c - the built-in haircuts: guides that grow from the scalp, and the look of each
// style.
#include "lib/groom/style_body.h"
#include "tests/support/cut.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_vec3 vertex(const struct hair_test_cut* cut, uint32_t guide, uint32_t i)
{
    return hair_load3(cut->info.positions + 3 * ((size_t)guide * cut->each + i));
}

static hair_vec3 tip(const struct hair_test_cut* cut, uint32_t guide)
{
    return vertex(cut, guide, cut->each - 1);
}

static float guide_length(const struct hair_test_cut* cut, uint32_t guide)
{
    float length = 0;
    for (uint32_t i = 1; i < cut->each; ++i)
        length += hair_distance(vertex(cut, guide, i), vertex(cut, guide, i - 1));
    return length;
}

// Guides ------------------------------------------------------------------------------------------

static void guides_are_finite_and_of_equal_segments(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_cut cut = hair_test_cut_style(&test, (hair_style)style);
        assert_int_equal(cut.info.strand_count, 166);
        assert_int_equal(cut.info.strand_set, HAIR_STRAND_SET_GUIDES);
        assert_int_equal(cut.info.format, HAIR_FORMAT_NONE);
        for (uint32_t guide = 0; guide < cut.info.strand_count; ++guide) {
            float mean = guide_length(&cut, guide) / (float)(cut.each - 1);
            assert_true(mean > 1e-4f && mean < 0.1f);
            for (uint32_t i = 1; i < cut.each; ++i) {
                // A chord is shorter than its arc, especially in the tightest curls, which have 5
                // segments per turn.
                float segment = hair_distance(vertex(&cut, guide, i), vertex(&cut, guide, i - 1));
                assert_true(segment > 0.7f * mean && segment < 1.3f * mean);
            }
        }
        hair_asset_destroy(cut.asset);
    }
}

static void guides_have_the_requested_vertices(void** state)
{
    (void)state;
    const uint32_t counts[] = {2, 3, 32, 256};
    for (uint32_t i = 0; i < 4; ++i) {
        hair_style_desc desc = hair_style_desc_default();
        hair_asset_info info = hair_asset_info_default();
        hair_asset* asset;
        desc.host = &test.host;
        desc.strand_vertices = counts[i];
        assert_int_equal(hair_asset_generate(&desc, &asset), HAIR_OK);
        assert_int_equal(hair_asset_describe(asset, &info), HAIR_OK);
        assert_int_equal(info.min_vertices, counts[i]);
        assert_int_equal(info.max_vertices, counts[i]);
        hair_asset_destroy(asset);
    }
}

static void guides_grow_from_the_vertices_of_the_scalp(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_cut cut = hair_test_cut_style(&test, (hair_style)style);
        assert_int_equal(cut.info.scalp_vertex_count, cut.info.strand_count);
        for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
            hair_vec3 root = vertex(&cut, i, 0), at = hair_test_cut_scalp(&cut, i);
            assert_memory_equal(&root, &at, sizeof root);
        }
        hair_asset_destroy(cut.asset);
    }
}

static void guides_stay_out_of_the_bust(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_cut cut = hair_test_cut_style(&test, (hair_style)style);
        for (uint32_t guide = 0; guide < cut.info.strand_count; ++guide)
            for (uint32_t i = 1; i < cut.each; ++i)
                assert_true(hair_body_distance(vertex(&cut, guide, i)) > -0.0005f);
        hair_asset_destroy(cut.asset);
    }
}

static void guides_leave_the_face_free(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_cut cut = hair_test_cut_style(&test, (hair_style)style);
        float brows = style == HAIR_STYLE_FRINGE ? 1.615f : 1.655f; // m
        for (uint32_t guide = 0; guide < cut.info.strand_count; ++guide)
            for (uint32_t i = 0; i < cut.each; ++i) {
                hair_vec3 p = vertex(&cut, guide, i);
                assert_false(fabsf(p.x) < 0.034f && p.z > 0.05f && p.y > 1.50f && p.y < brows);
            }
        hair_asset_destroy(cut.asset);
    }
}

// Check styles that lie close. A tail stands off, and an afro stands off by its length.
static void guides_hang_close_to_the_bust(void** state)
{
    (void)state;
    const hair_style styles[] = {HAIR_STYLE_LONG, HAIR_STYLE_BOB, HAIR_STYLE_CURLY};
    const float limits[] = {0.070f, 0.070f, 0.090f};
    for (uint32_t s = 0; s < 3; ++s) {
        struct hair_test_cut cut = hair_test_cut_style(&test, styles[s]);
        for (uint32_t i = 0; i < cut.info.vertex_count; ++i)
            assert_true(hair_body_distance(hair_load3(cut.info.positions + 3 * i)) < limits[s]);
        hair_asset_destroy(cut.asset);
    }
}

// Check neighbours, which are guides of one triangle. They may part only on the shoulders and
// around the crown, one in ten.
static void neighbouring_guides_are_similar(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_cut cut = hair_test_cut_style(&test, (hair_style)style);
        uint32_t edges = 3 * cut.info.scalp_triangle_count, apart = 0;
        for (uint32_t i = 0; i < edges; ++i) {
            uint32_t a = cut.info.scalp_triangles[i];
            uint32_t b = cut.info.scalp_triangles[i % 3 == 2 ? i - 2 : i + 1];
            float length = fmaxf(guide_length(&cut, a), guide_length(&cut, b));
            apart += hair_distance(tip(&cut, a), tip(&cut, b)) > 0.03f + 0.2f * length;
        }
        assert_true(apart * 10 < edges);
        hair_asset_destroy(cut.asset);
    }
}

static void length_scales_the_guides(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_cut one = hair_test_cut_style(&test, (hair_style)style),
                             two = hair_test_cut_with(&test, (hair_style)style, 166, 1.5f, 1);
        float ratio = two.info.length[1] / one.info.length[1];
        // Hair that is tied up is first combed to its tie, at any length. Curls have their full
        // radius only once.
        if (style == HAIR_STYLE_PONYTAIL || style == HAIR_STYLE_BUN || style == HAIR_STYLE_BRAID)
            assert_true(ratio > 1.2f && ratio < 1.5f);
        else
            assert_true(ratio > 1.35f && ratio < 1.65f);
        hair_asset_destroy(two.asset);
        hair_asset_destroy(one.asset);
    }
}

static void extreme_lengths_are_finite(void** state)
{
    (void)state;
    const float lengths[] = {0.1f, 4};
    for (uint32_t i = 0; i < 2 * HAIR_STYLE_COUNT; ++i) {
        struct hair_test_cut cut = hair_test_cut_with(&test, (hair_style)(i / 2), 40, lengths[i % 2], 7);
        for (uint32_t k = 0; k < 3 * cut.info.vertex_count; ++k) assert_true(isfinite(cut.info.positions[k]));
        assert_true(cut.info.length[0] > 0.001f && cut.info.length[2] < 4.1f);
        hair_asset_destroy(cut.asset);
    }
}

static int is_same(const struct hair_test_cut* a, const struct hair_test_cut* b)
{
    size_t size = 3 * sizeof(float) * a->info.vertex_count;
    return a->info.vertex_count == b->info.vertex_count &&
           !memcmp(a->info.positions, b->info.positions, size);
}

static void styles_differ_only_by_their_seed(void** state)
{
    (void)state;
    struct hair_test_cut a = hair_test_cut_with(&test, HAIR_STYLE_CURLY, 64, 1, 3),
                         b = hair_test_cut_with(&test, HAIR_STYLE_CURLY, 64, 1, 3);
    struct hair_test_cut c = hair_test_cut_with(&test, HAIR_STYLE_CURLY, 64, 1, 4);
    assert_true(is_same(&a, &b));
    assert_false(is_same(&a, &c));
    hair_asset_destroy(c.asset);
    hair_asset_destroy(b.asset);
    hair_asset_destroy(a.asset);
}

// Looks -------------------------------------------------------------------------------------------

static void long_hair_reaches_below_the_shoulders(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_LONG);
    assert_true(cut.info.length[1] > 0.30f && cut.info.length[1] < 0.50f);
    uint32_t low = 0, before = 0, behind = 0;
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        hair_vec3 end = tip(&cut, i);
        low += end.y < 1.38f;
        before += end.z > 0.02f;
        behind += end.z < -0.06f;
    }
    assert_true(low > 150 && before > 15 && behind > 60);
    hair_asset_destroy(cut.asset);
}

static void a_bob_ends_at_the_chin(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_BOB);
    for (uint32_t i = 0; i < cut.info.strand_count; ++i)
        assert_true(tip(&cut, i).y > 1.47f && tip(&cut, i).y < 1.55f);
    hair_asset_destroy(cut.asset);
}

static void short_hair_lies_close_to_the_skull(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_SHORT);
    assert_true(cut.info.length[0] > 0.015f && cut.info.length[2] < 0.085f);
    for (uint32_t i = 0; i < cut.info.strand_count; ++i)
        for (uint32_t k = 0; k < cut.each; ++k) assert_true(hair_body_distance(vertex(&cut, i, k)) < 0.032f);
    hair_asset_destroy(cut.asset);
}

// Check the tie, where the guides are closest to each other. It is a ring of 11 mm behind the
// crown.
static void a_ponytail_is_gathered_at_the_back(void** state)
{
    (void)state;
    const hair_vec3 tie = {0, 1.672f, -0.106f};
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_PONYTAIL);
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        float nearest = INFINITY;
        for (uint32_t k = 0; k < cut.each; ++k)
            nearest = fminf(nearest, hair_distance(vertex(&cut, i, k), tie));
        assert_true(nearest < 0.018f);
        assert_true(tip(&cut, i).y < 1.52f && tip(&cut, i).z < -0.10f && fabsf(tip(&cut, i).x) < 0.04f);
    }
    hair_asset_destroy(cut.asset);
}

static void curly_hair_has_several_turns(void** state)
{
    (void)state;
    const hair_style styles[] = {HAIR_STYLE_CURLY, HAIR_STYLE_AFRO};
    for (uint32_t s = 0; s < 2; ++s) {
        struct hair_test_cut cut = hair_test_cut_style(&test, styles[s]);
        for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
            float turn = 0;
            for (uint32_t k = 2; k < cut.each; ++k) {
                hair_vec3 a = hair_sub(vertex(&cut, i, k - 1), vertex(&cut, i, k - 2));
                hair_vec3 b = hair_sub(vertex(&cut, i, k), vertex(&cut, i, k - 1));
                turn += acosf(fminf(fmaxf(hair_dot(a, b) / (hair_length(a) * hair_length(b)), -1), 1));
            }
            assert_true(turn > 3 * 6.2832f);
        }
        hair_asset_destroy(cut.asset);
    }
}

static void an_afro_is_round(void** state)
{
    (void)state;
    const hair_vec3 middle = {0, 1.648f, -0.014f};
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_AFRO);
    for (uint32_t i = 0; i < cut.info.strand_count; ++i) {
        float radius = hair_distance(tip(&cut, i), middle);
        assert_true(radius > 0.145f && radius < 0.180f);
    }
    hair_asset_destroy(cut.asset);
}

// Limits ------------------------------------------------------------------------------------------

static void maximum_number_of_guides_takes_seconds(void** state)
{
    (void)state;
    struct timespec from, to;
    timespec_get(&from, TIME_UTC);
    struct hair_test_cut cut = hair_test_cut_with(&test, HAIR_STYLE_LONG, 4096, 1, 1);
    timespec_get(&to, TIME_UTC);
    // The limit includes sanitizers and a shared machine, but not valgrind.
    assert_true(getenv("HAIR_TEST_SLOW") || difftime(to.tv_sec, from.tv_sec) < 20);
    assert_int_equal(cut.info.strand_count, 4096);
    hair_asset_destroy(cut.asset);
}

static void refused_allocations_of_a_style_are_errors(void** state)
{
    (void)state;
    hair_style_desc desc = hair_style_desc_default();
    desc.host = &test.host;
    desc.guide_count = 20;
    hair_result result = HAIR_ERROR_MEMORY;
    for (uint32_t refuse = 1; result; ++refuse) {
        hair_asset* asset = NULL;
        test.allocations = 0;
        test.errors = 0;
        test.refuse = refuse;
        result = hair_asset_generate(&desc, &asset);
        if (!result) {
            hair_asset_destroy(asset);
            assert_true(refuse > 10);
            break;
        }
        assert_int_equal(result, HAIR_ERROR_MEMORY);
        assert_null(asset);
        assert_int_equal(test.errors, 1);
        assert_int_equal(test.blocks, 0);
    }
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(guides_are_finite_and_of_equal_segments),
        TEST(guides_have_the_requested_vertices),
        TEST(guides_grow_from_the_vertices_of_the_scalp),
        TEST(guides_stay_out_of_the_bust),
        TEST(guides_leave_the_face_free),
        TEST(guides_hang_close_to_the_bust),
        TEST(neighbouring_guides_are_similar),
        TEST(length_scales_the_guides),
        TEST(extreme_lengths_are_finite),
        TEST(styles_differ_only_by_their_seed),
        TEST(long_hair_reaches_below_the_shoulders),
        TEST(a_bob_ends_at_the_chin),
        TEST(short_hair_lies_close_to_the_skull),
        TEST(a_ponytail_is_gathered_at_the_back),
        TEST(curly_hair_has_several_turns),
        TEST(an_afro_is_round),
        TEST(maximum_number_of_guides_takes_seconds),
        TEST(refused_allocations_of_a_style_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
