// groom_grown_test.c - followers grown on a scalp: roots lie on it without gaps, guides are blended
// by their weights, and density is that of the maps.
#include "tests/support/grooms.h"

#include <hair/hair_asset.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_vec3 root_of(const hair_groom* groom, uint32_t guide)
{
    return hair_test_xyz(groom->rest[groom->guides[guide].first].position);
}

// Followers on a scalp ----------------------------------------------------------------------------

// Evaluate an upright strand, rooted at a vertex of a scalp of `cells` by `cells` over 20 cm.
static hair_vec3 upright(float t, uint32_t strand, const void* user)
{
    uint32_t row = *(const uint32_t*)user + 1;
    return hair_v3(0.2f * (float)(strand % row) / (float)(row - 1), 0.1f * t,
                   0.2f * (float)(strand / row) / (float)(row - 1));
}

// Evaluate a strand that is upright where x < 0.1, and hangs down beyond.
static hair_vec3 parted(float t, uint32_t strand, const void* user)
{
    hair_vec3 p = upright(t, strand, user);
    return p.x < 0.1f ? p : hair_v3(p.x, -p.y, p.z);
}

// Evaluate an upright strand whose root is between vertices of the scalp. The spacing is twice as
// large, so only every second vertex has a guide.
static hair_vec3 sparse(float t, uint32_t strand, const void* user)
{
    hair_vec3 p = upright(t, strand, user);
    return hair_v3(p.x + 0.003f, p.y, p.z + 0.003f);
}

struct grown {
    struct hair_test_strands strands;
    struct hair_test_scalp scalp;
    hair_groom_desc desc;
};

static struct grown prepare(uint32_t cells, uint32_t guide_cells, uint32_t followers,
                            hair_vec3 (*point)(float t, uint32_t strand, const void* user))
{
    uint32_t guides = (guide_cells + 1) * (guide_cells + 1);
    struct grown grown = {
        hair_test_strands_make(guides, 6), hair_test_scalp_make(cells, 0.2f), {.host = NULL}};
    for (uint32_t i = 0; i < guides; ++i) hair_test_strands_add(&grown.strands, 6, point, &guide_cells);
    grown.desc = hair_test_groom_desc(&test, &grown.strands);
    hair_test_set_scalp(&grown.desc, &grown.scalp);
    grown.desc.follower_count = followers;
    return grown;
}

static void free_grown(struct grown* grown)
{
    hair_test_strands_free(&grown->strands);
    hair_test_scalp_free(&grown->scalp);
}

static void assert_rooted(const hair_groom* groom)
{
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        hair_vec3 single = hair_test_single(groom, follower, 0), multi = hair_test_multi(groom, follower, 0);
        assert_true(hair_distance(single, multi) < 1e-6f);
        assert_true(fabsf(single.y) < 1e-6f);
        assert_true(single.x >= -1e-6f && single.x <= 0.2f + 1e-6f);
        assert_true(single.z >= -1e-6f && single.z <= 0.2f + 1e-6f);
    }
}

static void grown_roots_lie_on_the_scalp_by_either_interpolation(void** state)
{
    (void)state;
    struct grown grown = prepare(6, 6, 4000, upright);
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    assert_rooted(groom);
    hair_groom_destroy(groom);
    free_grown(&grown);

    grown = prepare(9, 4, 4000, sparse);
    groom = hair_test_groom_of(&grown.desc);
    assert_rooted(groom);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void followers_blend_corner_guides_by_barycentric_weight(void** state)
{
    (void)state;
    struct grown grown = prepare(6, 6, 4000, upright);
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    uint32_t first = 0;
    for (uint32_t i = 0; i < 4000; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        float w1 = follower->weight1, w2 = follower->weight2;
        hair_vec3 p = hair_add(hair_scale(root_of(groom, follower->guide0), 1 - w1 - w2),
                               hair_add(hair_scale(root_of(groom, follower->guide1), w1),
                                        hair_scale(root_of(groom, follower->guide2), w2)));
        assert_true(hair_distance(p, hair_test_multi(groom, follower, 0)) < 1e-6f);
        assert_true(follower->multi == 1);
        first += 1 - w1 - w2 >= fmaxf(w1, w2);
    }
    // Guide 0 is drawn by weight. Over a uniform triangle it has the largest of three weights in
    // 11/18 of the cases.
    assert_float_equal(first / 4000.0, 11.0 / 18, 0.03);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void followers_use_surrounding_guides_when_corners_have_none(void** state)
{
    (void)state;
    struct grown grown = prepare(9, 4, 4000, sparse);
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    uint32_t inside = 0, surrounded = 0;
    for (uint32_t i = 0; i < 4000; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        hair_vec3 p = hair_test_multi(groom, follower, 0);
        hair_vec3 own = {follower->offset[1].w, follower->offset[2].w, follower->offset[3].w};
        assert_true(hair_distance(p, root_of(groom, follower->guide0)) < 0.15f);
        if (p.x < 0.005f || p.z < 0.005f) continue;
        ++inside;
        surrounded += hair_length(own) < 0.001f;
    }
    assert_int_equal(surrounded, inside);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

// Check 40,000 followers over 1,600 cells of 25 each. Independent random positions would have a
// standard deviation of 5.
static void grown_roots_are_spread_without_clumps_or_gaps(void** state)
{
    (void)state;
    struct grown grown = prepare(8, 8, 40000, upright);
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    static uint32_t count[1600];
    memset(count, 0, sizeof count);
    for (uint32_t i = 0; i < 40000; ++i) {
        hair_vec3 p = hair_test_multi(groom, &groom->followers[i], 0);
        int x = (int)fminf(p.x * 200, 39), z = (int)fminf(p.z * 200, 39);
        ++count[40 * z + x];
    }
    double squared = 0, max = 0, min = 100;
    for (int i = 0; i < 1600; ++i) {
        squared += (count[i] - 25.0) * (count[i] - 25.0) / 1600;
        max = fmax(max, count[i]);
        min = fmin(min, count[i]);
    }
    printf("followers per cell: 25 +- %.1f, from %.0f to %.0f\n", sqrt(squared), min, max);
    assert_true(sqrt(squared) < 3);
    assert_true(min > 12 && max < 38);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void followers_are_not_blended_across_a_parting(void** state)
{
    (void)state;
    struct grown grown = prepare(6, 6, 4000, parted);
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    uint32_t apart = 0;
    for (uint32_t i = 0; i < 4000; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        float rise = hair_test_multi(groom, follower, 1).y;
        bool up = root_of(groom, follower->guide0).x < 0.0999f;
        assert_float_equal(rise, (up ? 0.1f : -0.1f) * follower->length_ratio, 1e-5);
        apart += follower->weight1 == 0 || follower->weight2 == 0;
    }
    assert_in_range(apart, 400, 1000); // The parting is at most one column of six.
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void followers_grow_only_where_density_is_not_zero(void** state)
{
    (void)state;
    struct grown grown = prepare(4, 4, 4000, upright);
    float density[25] = {0}; // The densities of columns are 0, 0, 1/2, 1 and 1.
    for (int i = 0; i < 25; ++i) density[i] = fminf(fmaxf(0.5f * (float)(i % 5) - 0.5f, 0), 1);
    grown.desc.scalp_density = density;
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    assert_int_equal(groom->info.follower_count, 4000);
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        struct hair_patch patch = groom->patches[i];
        assert_true(patch.density > 0 && patch.density <= 1);
        for (uint32_t j = 0; j < patch.count; ++j) {
            hair_vec3 p = hair_test_multi(groom, &groom->followers[patch.first + j], 0);
            assert_true(p.x > 0.05f - 1e-6f);
            if (p.x > 0.1501f) assert_float_equal(patch.density, 1, 1e-6);
            if (p.x < 0.0999f) assert_true(patch.density < 0.4f);
        }
    }
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void triangles_of_different_density_share_no_patch(void** state)
{
    (void)state;
    struct grown grown = prepare(20, 4, 4000, sparse); // Five followers per triangle.
    float density[441];
    for (int i = 0; i < 441; ++i) density[i] = i % 21 < 10 ? 0.25f : 0.75f;
    grown.desc.scalp_density = density;
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        struct hair_patch patch = groom->patches[i];
        for (uint32_t j = 0; j < patch.count; ++j) {
            hair_vec3 p = hair_test_multi(groom, &groom->followers[patch.first + j], 0);
            if (p.x < 0.0899f) assert_float_equal(patch.density, 0.25f, 1e-6);
            if (p.x > 0.1001f) assert_float_equal(patch.density, 0.75f, 1e-6);
        }
    }
    // Triangles of equal density share patches. Among 800 triangles, the 40 between the two
    // densities have patches of their own.
    assert_true(groom->info.patch_count < 200);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void scalp_is_scaled_and_rotated_like_strands(void** state)
{
    (void)state;
    struct grown grown = prepare(6, 6, 1000, upright);
    // Units are centimetres, with z up. A point (x, y, z) of the library is (x, -z, y) there.
    for (uint32_t i = 0; i < grown.strands.vertex_count + grown.scalp.vertex_count; ++i) {
        float* p = i < grown.strands.vertex_count
                       ? grown.strands.positions + 3 * i
                       : grown.scalp.positions + 3 * (i - grown.strands.vertex_count);
        hair_store3(p, hair_v3(100 * p[0], -100 * p[2], 100 * p[1]));
    }
    hair_import import = hair_import_default();
    import.scale = 0.01f;
    import.up = HAIR_UP_Z;
    grown.desc.import = &import;
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    assert_float_equal(groom->info.upper[1], 0.1, 1e-6);
    assert_rooted(groom);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void one_guide_or_two_are_enough_for_a_scalp(void** state)
{
    (void)state;
    struct grown grown = prepare(3, 1, 500, sparse);
    for (uint32_t guides = 1; guides <= 2; ++guides) {
        grown.desc.strand_count = guides;
        hair_groom* groom = hair_test_groom_of(&grown.desc);
        assert_rooted(groom);
        for (uint32_t i = 0; i < 500; ++i) {
            float w1 = groom->followers[i].weight1, w2 = groom->followers[i].weight2;
            assert_true(w1 >= 0 && w2 >= 0 && w1 + w2 <= 1);
        }
        hair_groom_destroy(groom);
    }
    free_grown(&grown);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(grown_roots_lie_on_the_scalp_by_either_interpolation),
        TEST(followers_blend_corner_guides_by_barycentric_weight),
        TEST(followers_use_surrounding_guides_when_corners_have_none),
        TEST(grown_roots_are_spread_without_clumps_or_gaps),
        TEST(followers_are_not_blended_across_a_parting),
        TEST(followers_grow_only_where_density_is_not_zero),
        TEST(triangles_of_different_density_share_no_patch),
        TEST(scalp_is_scaled_and_rotated_like_strands),
        TEST(one_guide_or_two_are_enough_for_a_scalp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
