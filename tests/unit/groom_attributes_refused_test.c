// groom_attributes_refused_test.c - attributes of strands that are refused, and memory that is
// refused to them.
#include "tests/support/furry.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static struct hair_test_host test;

static void invalid_attributes_are_refused_by_index_and_range(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD, &furry);
    furry.of_strands[17] = 100.5f;
    hair_test_refuse_groom(
        &test, &furry.desc,
        "hair_groom_desc.strand_attributes[0].strand_values[17] is 100.5, not in [0, 100]");
    furry.of_strands[17] = NAN;
    hair_test_refuse_groom(&test, &furry.desc, "hair_groom_desc.strand_attributes[0].strand_values[17] is");
    furry.of_strands[17] = 1;
    furry.of_vertices[80] = -1;
    hair_test_refuse_groom(&test, &furry.desc,
                           "hair_groom_desc.strand_attributes[1].map.values[80] is -1, not in [0, 100]");
    furry.of_vertices[80] = 1;
    furry.uvs[9] = INFINITY;
    hair_test_refuse_groom(&test, &furry.desc, "scalp_uvs: vertex 4 has inf");
    furry.uvs[9] = 0;
    furry.attributes[1].map.source = HAIR_MAP_SOURCE_IMAGE;
    hair_test_refuse_groom(&test, &furry.desc,
                           "strand_attributes[1].map is an image of 0 by 0, not of [1, 16384] each");
    furry.attributes[1].map.width = furry.attributes[1].map.height = 9;
    furry.desc.scalp_uvs = NULL;
    hair_test_refuse_groom(&test, &furry.desc, "scalp_uvs is NULL but strand_attributes[1].map is an image");
    furry.attributes[1].map.values = NULL;
    hair_test_refuse_groom(&test, &furry.desc, "strand_attributes[1].map.values is NULL");
    furry.attributes[0].kind = (hair_strand_attribute_kind)99;
    hair_test_refuse_groom(&test, &furry.desc,
                           "hair_groom_desc.strand_attributes[0].kind is 99, not in [0, ");
    furry.attributes[0].header.version = 0;
    hair_groom* none = NULL;
    assert_int_equal(hair_groom_create(&furry.desc, &none), HAIR_ERROR_VERSION);
    test.errors = 0;
    furry.desc.strand_attributes = NULL;
    hair_test_refuse_groom(&test, &furry.desc,
                           "hair_groom_desc.strand_attributes is NULL but strand_attribute_count is 2");
    furry.desc.strand_attribute_count = 33;
    hair_test_refuse_groom(&test, &furry.desc,
                           "hair_groom_desc.strand_attribute_count is 33, not in [0, 32]");
    hair_test_furry_free(&furry);
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD, &furry);
    for (uint32_t i = 0; i < 3 * furry.scalp.triangle_count; ++i) furry.scalp.triangles[i] = 0;
    furry.desc.strand_set = HAIR_STRAND_SET_FULL;
    hair_test_refuse_groom(&test, &furry.desc, "scalp_triangles: none of 128 has three different corners");
    furry.desc.strand_attribute_count = 1;
    hair_groom_destroy(hair_test_groom_of(&furry.desc));
    hair_groom_desc bald = hair_test_groom_desc(&test, &furry.strands);
    bald.strand_attributes = furry.attributes, bald.strand_attribute_count = 2;
    hair_test_refuse_groom(&test, &bald,
                           "hair_groom_desc.scalp_positions is NULL but strand_attributes[1].map is not");
    hair_test_furry_free(&furry);
}

static void check_refusals(hair_strand_attribute_kind kind)
{
    struct hair_test_furry furry;
    hair_test_furry_make(&test, kind, &furry);
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_STRANDS; ++i) furry.of_strands[i] = 0.5f;
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_VERTICES; ++i) furry.of_vertices[i] = 1;
    furry.desc.strand_set = HAIR_STRAND_SET_GUIDES, furry.desc.follower_count = 500;
    hair_groom* groom = NULL;
    uint32_t refuse = 0;
    hair_result result = HAIR_ERROR_MEMORY;
    while (result == HAIR_ERROR_MEMORY) {
        test.refuse = test.allocations + ++refuse;
        result = hair_groom_create(&furry.desc, &groom);
        test.errors = 0;
        if (result) assert_int_equal(test.blocks, 0);
    }
    test.refuse = 0;
    assert_int_equal(result, HAIR_OK);
    assert_true(refuse > 20);
    hair_groom_destroy(groom);
    hair_test_furry_free(&furry);
}

static void refused_allocations_of_attributes_leak_nothing(void** state)
{
    (void)state;
    check_refusals(HAIR_STRAND_ATTRIBUTE_STIFFNESS);
    check_refusals(HAIR_STRAND_ATTRIBUTE_DENSITY);
}

#define TEST(function) HAIR_TEST_WITH_HOST(function, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(invalid_attributes_are_refused_by_index_and_range),
        TEST(refused_allocations_of_attributes_leak_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
