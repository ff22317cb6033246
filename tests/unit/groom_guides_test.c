// groom_guides_test.c - selection of the strands that are simulated.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_vec3 vertex(const hair_groom* groom, uint32_t guide, uint32_t i)
{
    return hair_test_xyz(groom->rest[groom->guides[guide].first + i].position);
}

// Evaluate a straight strand that points away from a sphere, with roots all over the sphere.
static hair_vec3 hedgehog(float t, uint32_t strand, const void* user)
{
    float z = 1 - 2 * ((float)strand + 0.5f) / *(const float*)user, angle = 2.39996f * (float)strand;
    float r = sqrtf(1 - z * z);
    return hair_scale(hair_v3(r * cosf(angle), r * sinf(angle), z), 0.1f + 0.05f * t);
}

static void strands_given_as_guides_are_the_guides_in_their_order(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(100);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_count = 10;
    hair_groom* groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.guide_count, 100);
    const float* p = strands.positions;
    for (uint32_t i = 0; i < 100; p += 3 * strands.vertices[i++])
        assert_true(hair_distance(vertex(groom, i, 0), hair_load3(p)) == 0);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void guide_count_is_the_requested_or_one_in_ten(void** state)
{
    (void)state;
    static const struct {
        uint32_t strands, asked, given;
    } cases[] = {{1, 0, 1},   {50, 0, 50}, {500, 0, 64},    {5000, 0, 500},
                 {500, 7, 7}, {500, 1, 1}, {500, 9999, 500}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        struct hair_test_strands strands = hair_test_fur(cases[i].strands);
        hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
        desc.guide_count = cases[i].asked;
        hair_groom* groom = hair_test_groom_of(&desc);
        assert_int_equal(groom->info.guide_count, cases[i].given);
        hair_groom_destroy(groom);
        hair_test_strands_free(&strands);
    }
}

// Return whether the guides of a groom are the marked strands, in their order.
static bool has_guides(const hair_groom* groom, const struct hair_test_strands* strands, const uint8_t* marks)
{
    const float* p = strands->positions;
    uint32_t guide = 0;
    for (uint32_t i = 0; i < strands->count; p += 3 * strands->vertices[i++]) {
        if (!marks[i]) continue;
        if (guide == groom->info.guide_count || hair_distance(vertex(groom, guide++, 0), hair_load3(p)) > 0)
            return false;
    }
    return guide == groom->info.guide_count;
}

static void marked_strands_of_a_full_haircut_are_its_guides(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(500);
    uint8_t marks[500] = {0};
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    for (int i = 3; i < 500; i += 13) marks[i] = 1;
    desc.strand_guides = marks;
    hair_groom* groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.guide_count, 39);
    assert_int_equal(groom->info.follower_count, 500);
    assert_true(has_guides(groom, &strands, marks));
    hair_groom_destroy(groom);
    desc.guide_count = 39; // A number of guides lets the groom choose them.
    groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.guide_count, 39);
    assert_false(has_guides(groom, &strands, marks));
    hair_groom_destroy(groom);
    memset(marks, 0, sizeof marks);
    desc.guide_count = HAIR_AUTO;
    groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.guide_count, 64);
    hair_groom_destroy(groom);
    marks[499] = 2;
    hair_test_refuse_groom(&test, &desc, "hair_groom_desc.strand_guides[499] is 2, not in [0, 1]");
    desc.strand_set = HAIR_STRAND_SET_GUIDES; // All strands are guides.
    groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.guide_count, 500);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Followers move with guides of their own group, and a group without marks has a guide.
static void marked_guides_serve_their_own_groups(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(300);
    uint8_t marks[300] = {0}, groups[300];
    for (int i = 0; i < 300; ++i) {
        groups[i] = i % 3 == 2 ? 5 : (uint8_t)(i % 3);
        marks[i] = i % 3 != 1 && i % 10 == 0; // Strands of group 1 have no marks.
    }
    strands.groups = groups;
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_guides = marks;
    hair_groom* groom = hair_test_groom_of(&desc);
    uint32_t guides[6] = {0}, followers[6] = {0};
    for (uint32_t i = 0; i < groom->info.guide_count; ++i) ++guides[groom->guides[i].group];
    assert_int_equal(groom->info.guide_count, 21);
    assert_int_equal(guides[0], 10);
    assert_int_equal(guides[1], 1);
    assert_int_equal(guides[5], 10);
    for (uint32_t i = 0; i < 300; ++i) ++followers[groom->guides[groom->followers[i].guide0].group];
    assert_int_equal(followers[0], 100);
    assert_int_equal(followers[1], 100);
    assert_int_equal(followers[5], 100);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Evaluate a strand. 990 strands hang, and 10 at the same place stand up.
static hair_vec3 few_stand(float t, uint32_t strand, const void* user)
{
    (void)user;
    float x = 0.001f * (float)(strand % 30), z = 0.001f * (float)(strand / 30 % 30);
    return hair_v3(x, strand < 10 ? 0.1f * t : -0.1f * t, z);
}

static void a_few_strands_of_another_shape_get_guides_of_their_own(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(1000, 8);
    for (int i = 0; i < 1000; ++i) hair_test_strands_add(&strands, 8, few_stand, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.guide_count = 20;
    hair_groom* groom = hair_test_groom_of(&desc);
    uint32_t standing = 0, hanging = 0;
    for (uint32_t i = 0; i < 20; ++i) *(vertex(groom, i, 7).y > 0 ? &standing : &hanging) += 1;
    assert_in_range(standing, 1, 4);
    assert_int_equal(hanging, 20 - standing);
    for (uint32_t i = 0; i < 1000; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        bool stands = hair_test_single(groom, follower, 1).y > 0;
        assert_int_equal(stands, vertex(groom, follower->guide0, 7).y > 0);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Evaluate a strand that stands up. Roots are in a square of 1 m.
static hair_vec3 upright(float t, uint32_t strand, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(strand);
    hair_vec3 root = {hair_random(&random), 0, 0};
    root.z = hair_random(&random);
    return hair_add(root, hair_v3(0, 0.1f * t, 0));
}

// Check the mean distance to the nearest guide, relative to the spacing density^-1/2. It is half
// for independent random points in a plane, and 0.38 for a square lattice.
static void guides_lie_more_evenly_than_by_chance(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(10000, 4);
    for (int i = 0; i < 10000; ++i) hair_test_strands_add(&strands, 4, upright, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* groom = hair_test_groom_of(&desc);
    double sum = 0;
    for (uint32_t i = 0; i < 10000; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        hair_vec3 root = hair_test_single(groom, follower, 0);
        sum += (double)hair_distance(root, vertex(groom, follower->guide0, 0)) / 10000;
    }
    printf("guides are %.2f of their spacing away\n", sum * sqrt(1000));
    assert_true(sum * sqrt(1000) < 0.45);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Evaluate a strand. Roots alternate between a square of 10 cm and one of 1 cm beside it.
static hair_vec3 wide_and_narrow(float t, uint32_t strand, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(strand);
    float size = strand % 2 ? 0.1f : 0.01f, x = strand % 2 ? 0.2f : 0;
    return hair_v3(x + size * hair_random(&random), 0.1f * t, size * hair_random(&random));
}

// Check the distribution of guides. With equal numbers of strands, the square of 10 cm has
// (10^2)^(2/3) = 22 times as many guides as the square of 1 cm.
static void guides_are_selected_where_strands_differ(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(4000, 4);
    for (int i = 0; i < 4000; ++i) hair_test_strands_add(&strands, 4, wide_and_narrow, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.guide_count = 230;
    hair_groom* groom = hair_test_groom_of(&desc);
    uint32_t narrow = 0;
    for (uint32_t i = 0; i < 230; ++i) narrow += vertex(groom, i, 0).x < 0.1f;
    assert_in_range(narrow, 5, 20);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void identical_strands_are_divided_among_guides(void** state)
{
    (void)state;
    float count = 1;
    struct hair_test_strands strands = hair_test_strands_make(300, 5);
    for (int i = 0; i < 300; ++i) {
        hair_test_strands_add(&strands, 5, hedgehog, &count);
        strands.count -= 1; // The next strand is the same one.
        strands.vertices[i] = 5;
    }
    strands.count = 300;
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.guide_count = 100;
    hair_groom* groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.guide_count, 100);
    assert_int_equal(groom->info.follower_count, 300);
    uint32_t drawn = 0;
    bool seen[100] = {false};
    for (uint32_t i = 0; i < 300; ++i) {
        drawn += !seen[groom->followers[i].guide0];
        seen[groom->followers[i].guide0] = true;
    }
    assert_int_equal(drawn, 100);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(strands_given_as_guides_are_the_guides_in_their_order),
        TEST(guide_count_is_the_requested_or_one_in_ten),
        TEST(marked_strands_of_a_full_haircut_are_its_guides),
        TEST(marked_guides_serve_their_own_groups),
        TEST(a_few_strands_of_another_shape_get_guides_of_their_own),
        TEST(guides_lie_more_evenly_than_by_chance),
        TEST(guides_are_selected_where_strands_differ),
        TEST(identical_strands_are_divided_among_guides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
