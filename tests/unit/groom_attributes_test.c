// groom_attributes_test.c - attributes of strands by strand and by map.
#include "tests/support/furry.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "lib/asset/strands.h"
#include "lib/base/schema.h"
#include "lib/rod/prepared.h"

static struct hair_test_host test;

static float root_x(const hair_groom* groom, uint32_t guide)
{
    return groom->rest[groom->guides[guide].first].position.x;
}

static void guides_have_products_of_strand_and_map(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_DAMPING, &furry);
    float image[4] = {3, 5, 3, 5};
    for (int source = HAIR_MAP_SOURCE_IMAGE; source <= HAIR_MAP_SOURCE_TRIANGLES; ++source) {
        hair_map* map = &furry.attributes[1].map;
        map->source = (hair_map_source)source;
        if (source == HAIR_MAP_SOURCE_IMAGE) map->values = image, map->width = map->height = 2;
        if (source == HAIR_MAP_SOURCE_VERTICES) map->values = furry.of_vertices;
        if (source == HAIR_MAP_SOURCE_TRIANGLES) map->values = furry.of_triangles;
        hair_groom* groom = hair_test_groom_of(&furry.desc);
        float max = 0;
        assert_int_equal(groom->info.guide_count, HAIR_TEST_FURRY_STRANDS);
        for (uint32_t g = 0; g < HAIR_TEST_FURRY_STRANDS; ++g) {
            const struct hair_guide_factors* factors = &groom->guide_factors[g];
            float x = root_x(groom, g), z = groom->rest[groom->guides[g].first].position.z;
            float u = x * HAIR_TEST_FURRY_CELLS - floorf(x * HAIR_TEST_FURRY_CELLS),
                  v = z * HAIR_TEST_FURRY_CELLS - floorf(z * HAIR_TEST_FURRY_CELLS);
            uint32_t cell = (uint32_t)(x * HAIR_TEST_FURRY_CELLS) +
                            HAIR_TEST_FURRY_CELLS * (uint32_t)(z * HAIR_TEST_FURRY_CELLS);
            float value = 3 + 2 * fminf(fmaxf(x * 2 - 0.5f, 0), 1);
            if (source == HAIR_MAP_SOURCE_VERTICES) value = 1 + 2 * x;
            if (source == HAIR_MAP_SOURCE_TRIANGLES) value = (float)cell + (u + v > 1 ? 0.5f : 0);
            float product = fminf(value * furry.of_strands[g], 100);
            assert_float_equal(factors->damping, product, 1e-3);
            assert_true(factors->stiffness == 1 && factors->shape_frequency == 1 &&
                        factors->gravity_preload == 1);
            max = fmaxf(max, factors->damping);
        }
        assert_true(groom->max_factors.damping == max && groom->min_factors.damping < max);
        hair_groom_destroy(groom);
    }
    hair_test_furry_free(&furry);
}

// Check that chosen guides have the values of their strands, also after strands have been dropped.
static void values_stay_with_their_strands(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_STIFFNESS, &furry);
    hair_import import = hair_import_default();
    import.keep_fraction = 0.3f, import.strand_vertices = 5;
    furry.desc.import = &import;
    furry.desc.strand_set = HAIR_STRAND_SET_FULL;
    furry.desc.guide_count = 20;
    furry.desc.strand_attribute_count = 1;
    for (uint32_t i = 0, first = 0; i < HAIR_TEST_FURRY_STRANDS; first += furry.strands.vertices[i++])
        furry.of_strands[i] = furry.strands.positions[3 * first];
    hair_groom* groom = hair_test_groom_of(&furry.desc);
    assert_true(groom->info.strand_count < HAIR_TEST_FURRY_STRANDS / 2);
    for (uint32_t g = 0; g < groom->info.guide_count; ++g)
        assert_true(groom->guide_factors[g].stiffness == root_x(groom, g));
    hair_groom_destroy(groom);
    hair_test_furry_free(&furry);
}

// Check the rods that a groom prepares for physics, with the damping of each guide.
static void prepared_rods_have_the_factors(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_DAMPING, &furry);
    hair_physics physics = hair_physics_default();
    furry.desc.physics = &physics;
    hair_groom* groom = hair_test_groom_of(&furry.desc);
    for (uint32_t g = 0; g < HAIR_TEST_FURRY_STRANDS; ++g) {
        float damping = groom->prepared->rod[2 * groom->info.guide_vertex_count + g].w;
        assert_true(damping == 4 * groom->guide_factors[g].damping && damping > 4);
    }
    hair_groom_destroy(groom);
    hair_test_furry_free(&furry);
}

// Return the length of a follower at rest, m.
static double follower_length(const struct hair_groom* groom, uint32_t follower)
{
    const struct hair_follower* f = &groom->followers[follower];
    double sum = 0;
    for (int i = 0; i < 200; ++i)
        sum += (double)hair_distance(hair_test_single(groom, f, (float)i / 200),
                                     hair_test_single(groom, f, (float)(i + 1) / 200));
    return sum;
}

// Guides and full strands have the lengths of their strand times factor and map. Grown followers
// have the fraction of the map at their root, or that of their guides where it is smaller.
static void lengths_are_fractions_in_metres(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_LENGTH, &furry);
    furry.desc.follower_count = 1000;
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_STRANDS; ++i) furry.of_strands[i] = i % 3 ? 1 : 0.4f;
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_VERTICES; ++i)
        furry.of_vertices[i] = 0.2f + 0.8f * furry.scalp.positions[3 * i];
    for (int set = 0; set < 2; ++set) {
        furry.desc.strand_set = set ? HAIR_STRAND_SET_GUIDES : HAIR_STRAND_SET_FULL;
        furry.desc.strand_attribute_count = 0;
        hair_groom* whole = hair_test_groom_of(&furry.desc);
        furry.desc.strand_attribute_count = 2;
        hair_groom* groom = hair_test_groom_of(&furry.desc);
        double off = 0;
        for (uint32_t g = 0; set && g < HAIR_TEST_FURRY_STRANDS; ++g) {
            double wanted = (double)furry.of_strands[g] * (0.2 + 0.8 * (double)root_x(whole, g));
            off = fmax(off, fabs((double)groom->guides[g].arc_length / (double)whole->guides[g].arc_length -
                                 wanted));
        }
        printf("guides are %.1e off\n", off);
        assert_true(off < 5e-3);
        assert_int_equal(groom->info.follower_count, whole->info.follower_count);
        double sum[2] = {0};
        uint32_t shorter = 0;
        for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
            const struct hair_follower* f = &groom->followers[i];
            hair_vec3 root = hair_test_single(groom, f, 0);
            sum[root.x > 0.5f] += follower_length(groom, i);
            if (!set) continue;
            double own = 0.2 + 0.8 * (double)root.x, mean = 0.2;
            const uint32_t guides[3] = {f->guide0, f->guide1, f->guide2};
            const float weights[3] = {1 - f->weight1 - f->weight2, f->weight1, f->weight2};
            for (int k = 0; k < 3; ++k) mean += 0.8 * (double)(weights[k] * root_x(groom, guides[k]));
            double ratio = (double)f->length_ratio / (double)whole->followers[i].length_ratio;
            assert_float_equal(ratio, fmin(1, own / mean), 1e-3);
            shorter += ratio < 0.95;
        }
        if (set) printf("%u followers are shorter than their guides\n", shorter);
        assert_true(!set || shorter > 10);
        double wanted[2] = {0};
        for (uint32_t i = 0, first = 0; i < HAIR_TEST_FURRY_STRANDS; first += furry.strands.vertices[i++]) {
            const float* p = furry.strands.positions + 3 * (size_t)first;
            wanted[p[0] > 0.5f] += hair_strand_length(p, furry.strands.vertices[i]) *
                                   (double)furry.of_strands[i] * (0.2 + 0.8 * (double)p[0]);
        }
        if (!set)
            printf("set %d: %.1f and %.1f mm, not %.1f and %.1f mm\n", set, 1e3 * sum[0], 1e3 * sum[1],
                   1e3 * wanted[0], 1e3 * wanted[1]);
        for (int half = 0; half < 2 && set == 0; ++half)
            assert_true(fabs(sum[half] / wanted[half] - 1) < 0.01);
        hair_groom_destroy(groom);
        hair_groom_destroy(whole);
    }
    hair_test_furry_free(&furry);
}

// Return the mean of values of guides that a grown follower has, or the value of its root.
static double mean_of(const hair_groom* groom, const struct hair_follower* f, const float* values)
{
    if (f->multi != 1) return (double)hair_test_single(groom, f, 0).z;
    return (1 - (double)f->weight1 - (double)f->weight2) * (double)values[f->guide0] +
           (double)f->weight1 * (double)values[f->guide1] + (double)f->weight2 * (double)values[f->guide2];
}

// Check that the followers of a groom are among those of a whole one, with their seeds and places.
static void check_subset(const hair_groom* groom, const hair_groom* whole)
{
    uint32_t there = 0;
    for (uint32_t i = 0; i < groom->info.follower_count; ++i)
        for (uint32_t k = 0; k < whole->info.follower_count; ++k)
            there += groom->followers[i].seed == whole->followers[k].seed &&
                     groom->followers[i].guide0 == whole->followers[k].guide0 &&
                     hair_distance(hair_test_single(groom, &groom->followers[i], 1),
                                   hair_test_single(whole, &whole->followers[k], 1)) == 0;
    assert_int_equal(there, groom->info.follower_count);
}

// Densities are the product of the z coordinate of strands' roots and of a map that is x. Sums of
// followers are within three standard deviations.
static void densities_are_fractions_of_followers(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_DENSITY, &furry);
    for (uint32_t i = 0, first = 0; i < HAIR_TEST_FURRY_STRANDS; first += furry.strands.vertices[i++])
        furry.of_strands[i] = furry.strands.positions[3 * (size_t)first + 2];
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_VERTICES; ++i)
        furry.of_vertices[i] = furry.scalp.positions[3 * (size_t)i];
    furry.desc.follower_count = 2000;
    for (int set = 0; set < 2; ++set) {
        furry.desc.strand_set = set ? HAIR_STRAND_SET_GUIDES : HAIR_STRAND_SET_FULL;
        furry.desc.strand_attribute_count = 0;
        hair_groom* whole = hair_test_groom_of(&furry.desc);
        furry.desc.strand_attribute_count = 2;
        hair_groom *groom = hair_test_groom_of(&furry.desc), *again = hair_test_groom_of(&furry.desc);
        double wanted[2] = {0}, variance[2] = {0}, found[2] = {0};
        for (uint32_t i = 0; i < whole->info.follower_count; ++i) {
            const struct hair_follower* f = &whole->followers[i];
            double x = (double)hair_test_single(whole, f, 0).x, own = x * mean_of(whole, f, furry.of_strands);
            wanted[x > 0.5] += own, variance[x > 0.5] += own * (1 - own);
        }
        for (uint32_t i = 0; i < groom->info.follower_count; ++i)
            ++found[hair_test_single(groom, &groom->followers[i], 0).x > 0.5f];
        for (int half = 0; half < 2; ++half) {
            printf("set %d: %.0f followers, not %.1f\n", set, found[half], wanted[half]);
            assert_true(fabs(found[half] - wanted[half]) < 3 * sqrt(variance[half]));
        }
        assert_int_equal(groom->info.guide_count, whole->info.guide_count);
        assert_int_equal(groom->info.follower_count, again->info.follower_count);
        assert_memory_equal(groom->followers, again->followers, hair_groom_follower_bytes(groom));
        check_subset(groom, whole);
        hair_groom_destroy(groom), hair_groom_destroy(again), hair_groom_destroy(whole);
    }
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_STRANDS; ++i) furry.of_strands[i] = 0;
    hair_test_refuse_groom(&test, &furry.desc, "densities leave none of 2000 followers");
    hair_test_furry_free(&furry);
}

// Followers around guides without a scalp have the density of their guide.
static void guides_without_density_have_no_followers(void** state)
{
    (void)state;
    struct hair_test_furry furry;
    hair_test_furry_make(&test, HAIR_STRAND_ATTRIBUTE_DENSITY, &furry);
    hair_groom_desc bald = hair_test_groom_desc(&test, &furry.strands);
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_STRANDS; ++i) furry.of_strands[i] = (float)(i % 2);
    bald.strand_attributes = furry.attributes, bald.strand_attribute_count = 1;
    bald.strand_set = HAIR_STRAND_SET_GUIDES, bald.follower_count = 10 * HAIR_TEST_FURRY_STRANDS;
    hair_groom* groom = hair_test_groom_of(&bald);
    assert_int_equal(groom->info.follower_count, 5 * HAIR_TEST_FURRY_STRANDS);
    for (uint32_t i = 0; i < 5 * HAIR_TEST_FURRY_STRANDS; ++i)
        assert_int_equal(groom->followers[i].guide0 % 2, 1);
    hair_groom_destroy(groom);
    hair_test_furry_free(&furry);
}

static const hair_member* find_member(const struct hair_schema* schema, const char* name)
{
    for (uint32_t i = 0; i < schema->count; ++i)
        if (strcmp(schema->member[i].name, name) == 0) return &schema->member[i];
    return NULL;
}

static void products_stay_within_the_ranges_of_physics(void** state)
{
    (void)state;
    static const struct hair_guide_factors most = {100, 100, 100, 100};
    const struct hair_schema schema = hair_schema_of_hair_physics();
    hair_physics physics = hair_physics_default();
    physics.fiber.youngs_modulus = 9e11f, physics.damping = 900, physics.shape.gravity_preload = 0.9f;
    physics.shape.frequency_root = physics.shape.frequency_tip = 20;
    physics = hair_physics_multiply(&physics, &most);
    const struct {
        const char* name;
        float value;
    } checks[] = {{"fiber.youngs_modulus", physics.fiber.youngs_modulus},
                  {"damping", physics.damping},
                  {"shape.frequency_root", physics.shape.frequency_root},
                  {"shape.frequency_tip", physics.shape.frequency_tip},
                  {"shape.gravity_preload", physics.shape.gravity_preload}};
    for (size_t i = 0; i < sizeof checks / sizeof *checks; ++i)
        assert_true(checks[i].value == (float)find_member(&schema, checks[i].name)->max);
}

#define TEST(function) HAIR_TEST_WITH_HOST(function, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(guides_have_products_of_strand_and_map),
        TEST(values_stay_with_their_strands),
        TEST(prepared_rods_have_the_factors),
        TEST(lengths_are_fractions_in_metres),
        TEST(densities_are_fractions_of_followers),
        TEST(guides_without_density_have_no_followers),
        TEST(products_stay_within_the_ranges_of_physics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
