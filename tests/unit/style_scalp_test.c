// style_scalp_test.c - the scalp of built-in haircuts: one sheet of triangles on the promised
// skull, with evenly spread roots.
#include "lib/groom/style_body.h"
#include "lib/groom/style_grow.h"
#include "tests/support/cut.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>

static struct hair_test_host test;

// Scalp -------------------------------------------------------------------------------------------

static float corner_angle(hair_vec3 at, hair_vec3 a, hair_vec3 b)
{
    hair_vec3 p = hair_sub(a, at), q = hair_sub(b, at);
    return acosf(hair_dot(p, q) / (hair_length(p) * hair_length(q))) * 57.29578f;
}

static void assert_triangles_are_fat_and_face_outwards(const struct hair_test_cut* cut)
{
    for (uint32_t i = 0; i < cut->info.scalp_triangle_count; ++i) {
        const uint32_t* corner = cut->info.scalp_triangles + 3 * i;
        hair_vec3 p[3] = {hair_test_cut_scalp(cut, corner[0]), hair_test_cut_scalp(cut, corner[1]),
                          hair_test_cut_scalp(cut, corner[2])};
        hair_vec3 normal = hair_cross(hair_sub(p[1], p[0]), hair_sub(p[2], p[0]));
        assert_true(hair_dot(normal, hair_skull_normal(p[0])) > 0);
        for (int k = 0; k < 3; ++k) assert_true(corner_angle(p[k], p[(k + 1) % 3], p[(k + 2) % 3]) > 20);
    }
}

// Check Euler and Poincare: vertices - edges + triangles is 1 for a sheet without holes. An edge
// has at most one triangle on either side.
static void assert_is_one_sheet(const struct hair_test_cut* cut)
{
    uint32_t count = cut->info.scalp_vertex_count, edges = 0, vertices = 0;
    unsigned char* way = calloc((size_t)count * count, 1);
    unsigned char* used = calloc(count, 1);
    for (uint32_t i = 0; i < 3 * cut->info.scalp_triangle_count; ++i) {
        uint32_t a = cut->info.scalp_triangles[i], b = cut->info.scalp_triangles[i % 3 == 2 ? i - 2 : i + 1];
        assert_int_equal(way[(size_t)a * count + b], 0);
        edges += !way[(size_t)b * count + a];
        vertices += !used[a];
        way[(size_t)a * count + b] = 1;
        used[a] = 1;
    }
    assert_int_equal(vertices, count);
    assert_int_equal((int)count - (int)edges + (int)cut->info.scalp_triangle_count, 1);
    free(used);
    free(way);
}

static void the_scalp_is_one_sheet_of_fat_triangles(void** state)
{
    (void)state;
    const uint32_t counts[] = {16, 17, 23, 40, 100, 166, 333, 700};
    for (uint32_t i = 0; i < 8; ++i)
        for (uint32_t seed = 0; seed < 3; ++seed)
            for (uint32_t style = 0; style <= HAIR_STYLE_CURLY;
                 // An afro has the ponytail's scalp.
                 ++style) {
                struct hair_test_cut cut =
                    hair_test_cut_with(&test, (hair_style)style, counts[i], 0.1f, seed);
                assert_int_equal(cut.info.scalp_vertex_count, counts[i]);
                assert_is_one_sheet(&cut);
                assert_triangles_are_fat_and_face_outwards(&cut);
                hair_asset_destroy(cut.asset);
            }
}

// Return the height in metres, approximately, by the numbers of hair_asset.h.
static float height_above_skull(hair_vec3 p)
{
    float x = p.x / 0.077f, y = (p.y - 1.63f) / 0.098f, z = p.z / 0.096f;
    return 0.088f * (sqrtf(x * x + y * y + z * z) - 1);
}

// Check roots on the skull. Followers grow all over triangles, whose middles lie lower than their
// corners.
static void roots_lie_on_the_promised_skull(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_LONG);
    float sum = 0, n = (float)cut.info.scalp_triangle_count;
    for (uint32_t i = 0; i < cut.info.scalp_triangle_count; ++i) {
        hair_vec3 middle = {0, 0, 0};
        for (uint32_t k = 0; k < 3; ++k)
            middle = hair_add(
                middle, hair_scale(hair_test_cut_scalp(&cut, cut.info.scalp_triangles[3 * i + k]), 1.0f / 3));
        float height = height_above_skull(middle);
        assert_true(fabsf(height) < 6e-4f);
        sum += height / n;
    }
    print_message("    middles of triangles on average %.3f mm above it\n", 1e3 * (double)sum);
    assert_true(fabsf(sum) < 1e-4f);
    for (uint32_t i = 0; i < cut.info.scalp_vertex_count; ++i) {
        hair_vec3 p = hair_test_cut_scalp(&cut, i);
        assert_true(height_above_skull(p) > 0 && height_above_skull(p) < 1e-3f);
        // The face and the area below the nape are bare.
        assert_false(p.z > 0.06f && p.y < 1.66f);
        assert_true(p.y > 1.55f);
    }
    hair_asset_destroy(cut.asset);
}

// Behind the ears hair grows from the level of their middle, about 1.60 m, and lower. Hair that is
// combed up bared the skin there.
static void hair_grows_behind_the_ears(void** state)
{
    (void)state;
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_BUN);
    for (float degrees = 108; degrees <= 125; degrees += 1) {
        float azimuth = degrees / 57.29578f, lowest = INFINITY;
        for (uint32_t i = 0; i < cut.info.scalp_vertex_count; ++i) {
            hair_vec3 p = hair_test_cut_scalp(&cut, i), u = hair_skull_unit(p);
            if (fabsf(fabsf(atan2f(u.x, u.z)) - azimuth) < 0.2f) lowest = fminf(lowest, p.y);
        }
        assert_true(hair_scalp_hairline(azimuth) < 1.61f && lowest < 1.61f);
    }
    hair_asset_destroy(cut.asset);
}

// Check a style without a parting. The sides of a parting are a comb's line apart.
static void roots_are_spread_evenly(void** state)
{
    (void)state;
    const uint32_t counts[] = {40, 166, 1000};
    for (uint32_t i = 0; i < 3; ++i) {
        struct hair_test_cut cut = hair_test_cut_with(&test, HAIR_STYLE_AFRO, counts[i], 1, 1);
        uint32_t n = cut.info.scalp_vertex_count;
        float sum = 0, min = INFINITY, max = 0;
        for (uint32_t a = 0; a < n; ++a) {
            float nearest = INFINITY;
            for (uint32_t b = 0; b < n; ++b)
                if (a != b)
                    nearest = fminf(
                        nearest, hair_distance(hair_test_cut_scalp(&cut, a), hair_test_cut_scalp(&cut, b)));
            sum += nearest;
            min = fminf(min, nearest);
            max = fmaxf(max, nearest);
        }
        assert_true(min > 0.65f * sum / (float)n);
        assert_true(max < 1.35f * sum / (float)n);
        hair_asset_destroy(cut.asset);
    }
}

static void no_triangle_lies_across_the_parting(void** state)
{
    (void)state;
    const struct hair_parting parting = hair_style_parting(HAIR_STYLE_LONG);
    struct hair_test_cut cut = hair_test_cut_style(&test, HAIR_STYLE_LONG);
    for (uint32_t i = 0; i < 3 * cut.info.scalp_triangle_count; ++i) {
        hair_vec3 a = hair_test_cut_scalp(&cut, cut.info.scalp_triangles[i]);
        hair_vec3 b = hair_test_cut_scalp(&cut, cut.info.scalp_triangles[i % 3 == 2 ? i - 2 : i + 1]);
        if (a.z < -0.03f || b.z < -0.03f || a.y < 1.66f || b.y < 1.66f) continue;
        assert_true((a.x > hair_parting_x(parting, a.z)) == (b.x > hair_parting_x(parting, b.z)));
    }
    hair_asset_destroy(cut.asset);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_scalp_is_one_sheet_of_fat_triangles),
        TEST(roots_lie_on_the_promised_skull),
        TEST(hair_grows_behind_the_ears),
        TEST(roots_are_spread_evenly),
        TEST(no_triangle_lies_across_the_parting),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
