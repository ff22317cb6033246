// groom_strand_attributes_test.c - followers take the radii and colours of the strands that they
// are made of.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define COUNT 300
#define PLACES (HAIR_CURVE_INTERVALS + 1)

static struct hair_test_host test;

// Make a groom. A strand's red at the root is its x coordinate, and its green at the tip is its z
// coordinate.
static hair_groom* make(struct hair_test_strands* strands, hair_groom_desc* desc, float* colors, float* radii)
{
    hair_groom* groom = NULL;
    *desc = hair_test_groom_desc(&test, strands);
    for (uint32_t i = 0, first = 0; i < COUNT; first += strands->vertices[i++]) {
        const float* root = strands->positions + 3 * first;
        float own[6] = {root[0], 0.5f, 0, 0, 0, root[2]};
        memcpy(colors + 6 * i, own, sizeof own);
        radii[i] = 1 + root[0];
    }
    desc->colors = colors, desc->color_count = 2, desc->strand_radii = radii;
    assert_int_equal(hair_groom_create(desc, &groom), HAIR_OK);
    return groom;
}

static void followers_have_the_attributes_of_their_strand(void** state)
{
    (void)state;
    static float colors[6 * COUNT], radii[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc;
    hair_groom* groom = make(&strands, &desc, colors, radii);
    double mean = 0;
    for (uint32_t i = 0; i < COUNT; ++i) mean += (double)radii[i] / COUNT;
    assert_int_equal(groom->info.follower_count, COUNT);
    for (uint32_t i = 0; i < COUNT; ++i) {
        hair_vec3 root = hair_test_single(groom, &groom->followers[i], 0);
        const uint16_t* paint = groom->colors + 4 * PLACES * i;
        assert_float_equal(paint[0] / 65535.0, root.x, 1e-4);
        assert_float_equal(paint[1] / 65535.0, 0.5, 1e-4);
        assert_float_equal(paint[4 * (PLACES - 1) + 2] / 65535.0, root.z, 1e-4);
        assert_float_equal(paint[4 + 1] / 65535.0, 0.5 * (PLACES - 2) / (PLACES - 1), 1e-4);
        assert_float_equal(groom->followers[i].offset[0].w, (1 + root.x) / mean, 1e-4);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Check followers between guides. Their red is approximately the x coordinate of their root, as the
// weights interpolate it.
static void followers_between_guides_blend_their_attributes(void** state)
{
    (void)state;
    static float colors[6 * COUNT], radii[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    struct hair_test_scalp scalp = hair_test_scalp_make(8, 1);
    hair_groom_desc desc;
    hair_groom* groom = make(&strands, &desc, colors, radii);
    hair_groom_destroy(groom);
    hair_test_set_scalp(&desc, &scalp);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 2000;
    assert_int_equal(hair_groom_create(&desc, &groom), HAIR_OK);
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const struct hair_follower* f = &groom->followers[i];
        const uint16_t* paint = groom->colors + 4 * PLACES * i;
        double red = 0, weight[3] = {1 - (double)f->weight1 - (double)f->weight2, (double)f->weight1,
                                     (double)f->weight2};
        uint32_t guide[3] = {f->guide0, f->guide1, f->guide2};
        for (int k = 0; k < 3; ++k)
            red += weight[k] * (double)groom->rest[groom->guides[guide[k]].first].position.x;
        assert_float_equal(paint[0] / 65535.0, red, 1e-4);
    }
    hair_groom_destroy(groom);
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
}

static void groom_without_attributes_keeps_none(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* groom = NULL;
    assert_int_equal(hair_groom_create(&desc, &groom), HAIR_OK);
    assert_null(groom->colors);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void invalid_attributes_are_named(void** state)
{
    (void)state;
    static const float bad[] = {NAN, INFINITY, -1e-3f, 1e7f};
    static float colors[6 * COUNT], radii[COUNT];
    struct hair_test_strands strands = hair_test_fur(COUNT);
    hair_groom_desc desc;
    hair_groom* groom = make(&strands, &desc, colors, radii);
    hair_groom_destroy(groom);
    groom = NULL;
    for (int i = 0; i < 4; ++i) {
        colors[77] = bad[i];
        assert_int_equal(hair_groom_create(&desc, &groom), HAIR_ERROR_ARGUMENT);
        assert_non_null(strstr(test.sentence, "hair_groom_desc.colors[77] is"));
        colors[77] = 0, radii[5] = bad[i];
        assert_int_equal(hair_groom_create(&desc, &groom), HAIR_ERROR_ARGUMENT);
        assert_non_null(strstr(test.sentence, "hair_groom_desc.strand_radii[5] is"));
        radii[5] = 1;
    }
    assert_null(groom);
    memset(radii, 0, sizeof radii); // All radii are equal then.
    assert_int_equal(hair_groom_create(&desc, &groom), HAIR_OK);
    assert_float_equal(groom->followers[3].offset[0].w, 1, 0);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(followers_have_the_attributes_of_their_strand),
        TEST(followers_between_guides_blend_their_attributes),
        TEST(groom_without_attributes_keeps_none),
        TEST(invalid_attributes_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
