// groom_test.c - grooms as a whole: refused input, general guarantees, memory, and time.
#include "tests/support/grooms.h"

#include <hair/hair_asset.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

static struct hair_test_host test;

// An example for each of the four sources of followers.
struct example {
    struct hair_test_strands strands;
    struct hair_test_scalp scalp;
    hair_groom_desc desc[4];
};

static struct example make_example(uint32_t strands)
{
    struct example example = {hair_test_fur(strands), hair_test_scalp_make(4, 1), {{.host = NULL}}};
    for (int i = 0; i < 4; ++i) example.desc[i] = hair_test_groom_desc(&test, &example.strands);
    example.desc[1].strand_set = HAIR_STRAND_SET_GUIDES;
    example.desc[1].follower_count = 0;
    example.desc[2].strand_set = HAIR_STRAND_SET_GUIDES;
    example.desc[2].follower_count = 3000;
    hair_test_set_scalp(&example.desc[3], &example.scalp);
    example.desc[3].follower_count = 5000;
    return example;
}

static void free_example(struct example* example)
{
    hair_test_strands_free(&example->strands);
    hair_test_scalp_free(&example->scalp);
}

static void groom_without_a_usable_strand_is_refused(void** state)
{
    (void)state;
    float positions[] = {0, 0, 0, 1, NAN, 0, 2, 0, 0, 2, 1e-7f, 0};
    uint32_t vertices[] = {2, 2};
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &test.host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 2;
    hair_test_refuse_groom(
        &test, &desc,
        "none of 2 strands can be used: 1 have fewer than two vertices left, 1 are too short; 1 "
        "vertices were not finite");
}

static void vertex_count_overflow_is_refused(void** state)
{
    (void)state;
    float positions[6] = {0};
    uint32_t vertices[] = {UINT32_MAX, 1};
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &test.host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 2;
    hair_test_refuse_groom(&test, &desc, "hair_groom_desc.strand_vertices add up to 4294967296");
}

static void more_guides_than_262144_are_refused(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(HAIR_MAX_GUIDES + 1);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    hair_test_refuse_groom(&test, &desc, "262145 guides, not in [1, 262144]");
    hair_test_strands_free(&strands);
}

static void invalid_scalp_is_refused_by_index_value_and_range(void** state)
{
    (void)state;
    struct example example = make_example(10);
    hair_groom_desc desc = example.desc[3];
    float density[25];
    for (int i = 0; i < 25; ++i) density[i] = 1;
    desc.scalp_density = density;

    density[7] = 1.5f;
    hair_test_refuse_groom(&test, &desc, "scalp_density[7] is 1.5, not in [0, 1]");
    density[7] = NAN;
    hair_test_refuse_groom(&test, &desc, "scalp_density[7] is");
    density[7] = 1;
    example.scalp.triangles[5] = 25;
    hair_test_refuse_groom(&test, &desc, "scalp_triangles[5] is 25, not in [0, 24]");
    example.scalp.triangles[5] = 0;
    example.scalp.positions[10] = INFINITY;
    hair_test_refuse_groom(&test, &desc, "scalp_positions: vertex 3 is (");
    free_example(&example);
}

static void scalp_where_nothing_can_grow_is_refused(void** state)
{
    (void)state;
    struct example example = make_example(10);
    hair_groom_desc desc = example.desc[3];
    float density[25] = {0};
    desc.scalp_density = density;
    hair_test_refuse_groom(&test, &desc, "none of 32 has an area and a scalp_density above 0");
    free_example(&example);
}

static void patches_cover_every_follower_once(void** state)
{
    (void)state;
    struct example example = make_example(700);
    for (int source = 0; source < 4; ++source) {
        hair_groom* groom = hair_test_groom_of(&example.desc[source]);
        uint32_t next = 0;
        for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
            assert_int_equal(groom->patches[i].first, next);
            assert_in_range(groom->patches[i].count, 1, HAIR_MAX_ISOLINES);
            next += groom->patches[i].count;
        }
        assert_int_equal(next, groom->info.follower_count);
        hair_groom_destroy(groom);
    }
    free_example(&example);
}

static void follower_count_is_the_requested(void** state)
{
    (void)state;
    struct example example = make_example(700);
    uint32_t wanted[4] = {700, 700, 3000, 5000};
    for (int source = 0; source < 4; ++source) {
        hair_groom* groom = hair_test_groom_of(&example.desc[source]);
        assert_int_equal(groom->info.follower_count, wanted[source]);
        hair_groom_destroy(groom);
    }
    free_example(&example);
}

static void follower_numbers_are_finite_and_in_range(void** state)
{
    (void)state;
    struct example example = make_example(700);
    for (int source = 0; source < 4; ++source) {
        hair_groom* groom = hair_test_groom_of(&example.desc[source]);
        for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
            const struct hair_follower* follower = &groom->followers[i];
            assert_true(follower->guide0 < groom->info.guide_count);
            assert_true(follower->guide1 < groom->info.guide_count);
            assert_true(follower->guide2 < groom->info.guide_count);
            if (follower->multi < 0) { // It has a shape of its own, and weights of displacements.
                assert_true(fabsf(follower->weight1) <= 4 && fabsf(follower->weight2) <= 4);
            } else {
                assert_true(follower->weight1 >= 0 && follower->weight2 >= 0);
                assert_true(follower->weight1 + follower->weight2 <= 1 + 1e-6f);
            }
            assert_true(follower->length_ratio > 0 && follower->length_ratio < 100);
            assert_true(follower->offset[0].w >= 0.8f && follower->offset[0].w <= 1.2f);
            const float* offset = &follower->offset[0].x;
            for (int k = 0; k < 16; ++k) assert_true(isfinite(offset[k]));
        }
        hair_groom_destroy(groom);
    }
    free_example(&example);
}

static int differ(const hair_groom* a, const hair_groom* b)
{
    if (memcmp(&a->info, &b->info, sizeof a->info)) return 1;
    if (memcmp(a->guides, b->guides, a->info.guide_count * sizeof *a->guides)) return 1;
    if (memcmp(a->rest, b->rest, a->info.guide_vertex_count * sizeof *a->rest)) return 1;
    if (memcmp(a->patches, b->patches, a->info.patch_count * sizeof *a->patches)) return 1;
    return memcmp(a->followers, b->followers, a->info.follower_count * sizeof *a->followers) != 0;
}

static void equal_seeds_give_equal_grooms_and_others_differ(void** state)
{
    (void)state;
    struct example example = make_example(700);
    for (int source = 0; source < 4; ++source) {
        hair_groom_desc other = example.desc[source];
        other.seed = 2;
        hair_groom *a = hair_test_groom_of(&example.desc[source]),
                   *b = hair_test_groom_of(&example.desc[source]), *c = hair_test_groom_of(&other);
        assert_false(differ(a, b));
        assert_true(differ(a, c));
        hair_groom_destroy(a);
        hair_groom_destroy(b);
        hair_groom_destroy(c);
    }
    free_example(&example);
}

static void refused_allocations_of_a_groom_leak_nothing(void** state)
{
    (void)state;
    struct example example = make_example(200);
    for (int source = 0; source < 4; ++source)
        for (uint32_t n = 1;; ++n) {
            hair_groom* groom = NULL;
            hair_test_host_init(&test);
            test.refuse = n;
            hair_result result = hair_groom_create(&example.desc[source], &groom);
            if (!result) {
                assert_true(n > 10); // The test has reached the refusals.
                hair_groom_destroy(groom);
                assert_int_equal(test.blocks, 0);
                break;
            }
            assert_int_equal(result, HAIR_ERROR_MEMORY);
            assert_null(groom);
            assert_int_equal(test.errors, 1);
            assert_int_equal(test.blocks, 0);
        }
    free_example(&example);
}

static void groom_info_describes_the_strands(void** state)
{
    (void)state;
    float positions[] = {0, 0, 0, 0, 3, 0, 1, 0, 0, 1, 1, 0, 9, 9, 9};
    uint32_t vertices[] = {2, 2, 1};
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &test.host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 3;
    hair_groom* groom = hair_test_groom_of(&desc);

    const hair_groom_info* info = &groom->info;
    assert_int_equal(info->strand_count, 2);
    assert_int_equal(info->guide_count, 2);
    assert_int_equal(info->guide_vertex_count, 8);
    assert_int_equal(info->follower_count, 2);
    assert_int_equal(info->patch_count, 1);
    assert_int_equal(info->import_stats.dropped_single, 1);
    assert_float_equal(info->length[0], 1, 1e-6);
    assert_float_equal(info->length[1], 2, 1e-6);
    assert_float_equal(info->length[2], 3, 1e-6);
    assert_float_equal(info->upper[0], 1, 0);
    assert_float_equal(info->upper[1], 3, 0);
    assert_float_equal(info->lower[1], 0, 0);
    hair_groom_destroy(groom);
}

static double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void fur_of_50000_strands_fills_its_patches(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(50000);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    double before = now();
    hair_groom* groom = hair_test_groom_of(&desc);
    double fill = (double)groom->info.follower_count / HAIR_MAX_ISOLINES / groom->info.patch_count;
    printf("50,000 strands, %u guides: %.0f ms, %.1f MB at most, patches %.0f %% full\n",
           groom->info.guide_count, 1e3 * (now() - before), 1e-6 * (double)test.peak, 100 * fill);
    assert_int_equal(groom->info.guide_count, 5000);
    assert_int_equal(groom->info.follower_count, 50000);
    assert_true(fill > 0.7);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void followers_of_a_patch_are_neighbours(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(20000);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* groom = hair_test_groom_of(&desc);
    // 64 of 20,000 strands per square metre take a square of 57 mm.
    double sum = 0;
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        struct hair_patch patch = groom->patches[i];
        hair_vec3 first = hair_test_single(groom, &groom->followers[patch.first], 0);
        double max = 0;
        for (uint32_t j = 1; j < patch.count; ++j)
            max = fmax(max,
                       hair_distance(first, hair_test_single(groom, &groom->followers[patch.first + j], 0)));
        sum += max;
    }
    double mean = sum / groom->info.patch_count;
    printf("patches reach %.0f mm from their first follower\n", 1e3 * mean);
    assert_true(mean < 0.085);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void prefix_of_a_patch_thins_it_evenly(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(500);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 5000;
    hair_groom* groom = hair_test_groom_of(&desc);
    // The first half of a patch has some of the ten followers of a guide, but not all.
    uint32_t *first = calloc(500, sizeof *first), split = 0;
    for (uint32_t i = 0; i < groom->info.patch_count; ++i)
        for (uint32_t j = 0; j < groom->patches[i].count / 2; ++j)
            ++first[groom->followers[groom->patches[i].first + j].guide0];
    for (int i = 0; i < 500; ++i) split += first[i] > 0 && first[i] < 10;
    assert_true(split > 490);
    free(first);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static int compare(const void* a, const void* b)
{
    uint32_t x = *(const uint32_t*)a, y = *(const uint32_t*)b;
    return (x > y) - (x < y);
}

static void follower_seeds_differ_and_follow_the_groom_seed(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(2000);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    static uint32_t seeds[4000];
    for (uint32_t seed = 0; seed < 2; ++seed) {
        desc.seed = seed;
        hair_groom* groom = hair_test_groom_of(&desc);
        for (uint32_t i = 0; i < 2000; ++i) seeds[2000 * seed + i] = groom->followers[i].seed;
        hair_groom_destroy(groom);
    }
    qsort(seeds, 4000, sizeof *seeds, compare);
    uint32_t alike = 0;
    for (int i = 1; i < 4000; ++i) alike += seeds[i] == seeds[i - 1];
    assert_in_range(alike, 0, 2); // About 4000^2 / 2^33 pairs of 32 bits are equal by chance.
    hair_test_strands_free(&strands);
}

static void built_in_haircuts_become_grooms(void** state)
{
    (void)state;
    for (uint32_t style = 0; style < HAIR_STYLE_COUNT; ++style) {
        hair_style_desc style_desc = hair_style_desc_default();
        style_desc.host = &test.host;
        style_desc.style = (hair_style)style;
        hair_asset* asset = NULL;
        assert_int_equal(hair_asset_generate(&style_desc, &asset), HAIR_OK);
        hair_groom_desc desc = hair_groom_desc_default();
        desc.host = &test.host;
        assert_int_equal(hair_asset_to_groom_desc(asset, &desc), HAIR_OK);
        double before = now();
        hair_groom* groom = hair_test_groom_of(&desc);
        uint32_t parted = 0;
        for (uint32_t i = 0; i < groom->info.follower_count; ++i)
            parted += groom->followers[i].weight1 == 0 || groom->followers[i].weight2 == 0;
        printf("%-9s %4u guides %5u patches, %4.1f %% of the followers at a parting, %.0f ms\n",
               hair_style_name((hair_style)style), groom->info.guide_count, groom->info.patch_count,
               100.0 * parted / groom->info.follower_count, 1e3 * (now() - before));
        assert_int_equal(groom->info.follower_count, 18000);
        assert_true(parted < groom->info.follower_count / 4);
        hair_groom_destroy(groom);
        hair_asset_destroy(asset);
    }
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(groom_without_a_usable_strand_is_refused),
        TEST(vertex_count_overflow_is_refused),
        TEST(more_guides_than_262144_are_refused),
        TEST(invalid_scalp_is_refused_by_index_value_and_range),
        TEST(scalp_where_nothing_can_grow_is_refused),
        TEST(patches_cover_every_follower_once),
        TEST(follower_count_is_the_requested),
        TEST(follower_numbers_are_finite_and_in_range),
        TEST(equal_seeds_give_equal_grooms_and_others_differ),
        TEST(refused_allocations_of_a_groom_leak_nothing),
        TEST(groom_info_describes_the_strands),
        TEST(fur_of_50000_strands_fills_its_patches),
        TEST(followers_of_a_patch_are_neighbours),
        TEST(prefix_of_a_patch_thins_it_evenly),
        TEST(follower_seeds_differ_and_follow_the_groom_seed),
        TEST(built_in_haircuts_become_grooms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
