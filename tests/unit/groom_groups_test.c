// groom_groups_test.c - groups of strands: guides of their own, and followers that move with them
// only.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define COUNT 600

static struct hair_test_host test;

// Mix three groups at the same places. Group 2 has no strands, and group 3 only a few.
static uint8_t group_of(uint32_t strand)
{
    return (uint8_t)(strand % 100 == 0 ? 3 : strand % 2);
}

static void fill_groups(uint8_t* groups)
{
    for (uint32_t i = 0; i < COUNT; ++i) groups[i] = group_of(i);
}

static void assert_followers_keep_to_one_group(const hair_groom* groom)
{
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const struct hair_follower* f = &groom->followers[i];
        uint32_t group = groom->guides[f->guide0].group;
        assert_int_equal(groom->guides[f->guide1].group, group);
        assert_int_equal(groom->guides[f->guide2].group, group);
    }
}

// Return the fraction of followers that have a weight on more than one guide.
static double fraction_between_guides(const hair_groom* groom)
{
    double between = 0;
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const struct hair_follower* f = &groom->followers[i];
        between += f->weight1 != 0 || f->weight2 != 0;
    }
    return between / groom->info.follower_count;
}

static void full_strands_follow_guides_of_their_group(void** state)
{
    (void)state;
    uint8_t groups[COUNT], read[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    fill_groups(groups);
    desc.strand_groups = groups;
    for (uint32_t wanted = 1; wanted <= COUNT; wanted = 3 * wanted + 1) {
        desc.guide_count = wanted;
        hair_groom* groom = hair_test_groom_of(&desc);
        uint32_t guides = groom->info.guide_count, followers[8] = {0}, guides_of[8] = {0};
        assert_int_equal(guides, wanted < 3 ? 3 : wanted);
        assert_int_equal(groom->info.group_count, 4);
        assert_int_equal(hair_groom_get_groups(groom, read, COUNT), HAIR_OK);
        for (uint32_t i = 0; i < guides; ++i) {
            assert_int_equal(read[i], groom->guides[i].group);
            ++guides_of[read[i]];
        }
        assert_followers_keep_to_one_group(groom);
        for (uint32_t i = 0; i < COUNT; ++i) ++followers[groom->guides[groom->followers[i].guide0].group];
        assert_true(followers[0] == 294 && followers[1] == 300 && followers[3] == 6);
        assert_true(guides_of[0] && guides_of[1] && guides_of[3] && !guides_of[2]);
        assert_true(guides < 30 || abs((int)guides_of[0] - (int)guides_of[1]) < (int)guides / 5);
        hair_groom_destroy(groom);
    }
    hair_test_strands_free(&strands);
}

static void grown_followers_lie_between_guides_of_one_group(void** state)
{
    (void)state;
    uint8_t groups[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    struct hair_test_scalp scalp = hair_test_scalp_make(8, 1);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_test_set_scalp(&desc, &scalp);
    desc.follower_count = 5000;
    hair_groom* groom = hair_test_groom_of(&desc);
    double without = fraction_between_guides(groom);
    hair_groom_destroy(groom);
    fill_groups(groups);
    desc.strand_groups = groups;
    groom = hair_test_groom_of(&desc);
    double with = fraction_between_guides(groom);
    for (uint32_t i = 0; i < COUNT; ++i) assert_int_equal(groom->guides[i].group, groups[i]);
    assert_followers_keep_to_one_group(groom);
    printf("%.3f of the followers are between guides, %.3f without groups\n", with, without);
    assert_true(with > 0.9 * without && without > 0.5);
    hair_groom_destroy(groom);
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
}

static void groups_stay_with_their_strands_in_repairs(void** state)
{
    (void)state;
    uint8_t groups[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_import import = hair_import_default();
    fill_groups(groups);
    // Strands of group 1 have no length, except one.
    for (uint32_t i = 0, first = 0; i < COUNT; first += strands.vertices[i++])
        for (uint32_t k = 1; groups[i] == 1 && i != 77 && k < strands.vertices[i]; ++k)
            memcpy(strands.positions + 3 * (first + k), strands.positions + 3 * first, 3 * sizeof(float));
    import.strand_vertices = 5;
    desc.import = &import;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.strand_groups = groups;
    hair_groom* groom = hair_test_groom_of(&desc);
    uint32_t guide = 0;
    assert_int_equal(groom->info.guide_count, 301);
    for (uint32_t i = 0; i < COUNT; ++i)
        if (groups[i] != 1 || i == 77) assert_int_equal(groom->guides[guide++].group, groups[i]);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Compare all bytes of a groom whose strands are all in one group with those of a groom without
// groups.
static void one_group_gives_the_bits_of_no_groups(void** state)
{
    (void)state;
    static const uint8_t groups[COUNT] = {0};
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* without = hair_test_groom_of(&desc);
    desc.strand_groups = groups;
    hair_groom* with = hair_test_groom_of(&desc);
    assert_int_equal(with->info.group_count, 1);
    assert_memory_equal(&with->info, &without->info, sizeof with->info);
    assert_memory_equal(with->guides, without->guides, with->info.guide_count * sizeof *with->guides);
    assert_memory_equal(with->rest, without->rest, with->info.guide_vertex_count * sizeof *with->rest);
    assert_memory_equal(with->followers, without->followers, hair_groom_follower_bytes(with));
    hair_groom_destroy(with);
    hair_groom_destroy(without);
    hair_test_strands_free(&strands);
}

static void invalid_groups_are_named(void** state)
{
    (void)state;
    uint8_t groups[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* groom = NULL;
    fill_groups(groups);
    groups[123] = 8;
    desc.strand_groups = groups;
    assert_int_equal(hair_groom_create(&desc, &groom), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "hair_groom_desc.strand_groups[123] is 8, not in [0, 7]"));
    assert_null(groom);
    groups[123] = 7;
    groom = hair_test_groom_of(&desc);
    assert_int_equal(groom->info.group_count, 8);
    assert_int_equal(hair_groom_get_groups(groom, NULL, 1), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "groups is NULL but guide_capacity is 1"));
    assert_int_equal(hair_groom_get_groups(groom, NULL, 0), HAIR_OK);
    assert_int_equal(hair_groom_get_groups(NULL, groups, 1), HAIR_ERROR_ARGUMENT);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(full_strands_follow_guides_of_their_group),
        TEST(grown_followers_lie_between_guides_of_one_group),
        TEST(groups_stay_with_their_strands_in_repairs),
        TEST(one_group_gives_the_bits_of_no_groups),
        TEST(invalid_groups_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
