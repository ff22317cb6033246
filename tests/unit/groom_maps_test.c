// groom_maps_test.c - maps on the scalp: the followers drawn at each place, their order, and their
// thickness.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

#define SIDE 0.2f // Metres. The scalp's texture coordinates are x / SIDE and z / SIDE.
#define CELLS 5
#define VERTICES ((CELLS + 1) * (CELLS + 1))
#define TRIANGLES (2 * CELLS * CELLS)

// A groom of upright guides at the scalp's vertices and followers between them, or of full strands.
struct grown {
    struct hair_test_strands strands;
    struct hair_test_scalp scalp;
    float uvs[2 * VERTICES];
    hair_map_set set[4];
    hair_groom_desc desc;
};

static hair_vec3 at_vertex(float t, uint32_t strand, const void* user)
{
    (void)user;
    float step = SIDE / CELLS;
    return hair_v3(step * (float)(strand % (CELLS + 1)), 0.1f * t, step * (float)(strand / (CELLS + 1)));
}

static hair_vec3 strewn(float t, uint32_t strand, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(strand);
    float x = SIDE * hair_random(&random);
    return hair_v3(x, 0.001f + 0.1f * t, SIDE * hair_random(&random)); // Slightly above the scalp.
}

static void prepare(struct grown* grown, uint32_t followers, int all)
{
    uint32_t count = all ? followers : VERTICES;
    *grown = (struct grown){.scalp = hair_test_scalp_make(CELLS, SIDE)};
    grown->strands = hair_test_strands_make(count, 6);
    for (uint32_t i = 0; i < count; ++i)
        hair_test_strands_add(&grown->strands, 6, all ? strewn : at_vertex, NULL);
    grown->desc = hair_test_groom_desc(&test, &grown->strands);
    hair_test_set_scalp(&grown->desc, &grown->scalp);
    if (all) grown->desc.strand_set = HAIR_STRAND_SET_FULL;
    grown->desc.follower_count = followers;
    for (uint32_t i = 0; i < VERTICES; ++i) {
        grown->uvs[2 * i] = grown->scalp.positions[3 * i] / SIDE;
        grown->uvs[2 * i + 1] = grown->scalp.positions[3 * i + 2] / SIDE;
    }
    grown->desc.scalp_uvs = grown->uvs;
    for (int i = 0; i < 4; ++i) grown->set[i] = hair_map_set_default();
}

static void free_grown(struct grown* grown)
{
    hair_test_strands_free(&grown->strands);
    hair_test_scalp_free(&grown->scalp);
}

static hair_map image(const float* values, uint32_t width, uint32_t height)
{
    return (hair_map){HAIR_MAP_SOURCE_IMAGE, values, width, height};
}

static hair_vec3 root_of(const hair_groom* groom, uint32_t follower)
{
    return hair_test_single(groom, &groom->followers[follower], 0);
}

// Return how many followers of a patch are drawn with a set, as in glsl/strands/patch.glsl.
static float wanted_of(const struct hair_patch* patch, float map_density, float fraction)
{
    return (float)patch->count * patch->density * map_density * fraction;
}

// Count the drawn followers in each of ten columns.
static void count_columns(const hair_groom* groom, float fraction, double count[10])
{
    memset(count, 0, 10 * sizeof *count);
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        struct hair_patch patch = groom->patches[i];
        float wanted = wanted_of(&patch, patch.map_density.x, fraction);
        for (uint32_t k = 0; (float)k < wanted; ++k) {
            int column = (int)fminf(fmaxf(10 * root_of(groom, patch.first + k).x / SIDE, 0), 9);
            count[column] += (double)fminf(wanted - (float)k, 1);
        }
    }
}

static void followers_are_absent_where_the_density_image_is_black(void** state)
{
    (void)state;
    static const float bands[10] = {0.2f, 0.2f, 0, 0, 0, 0.2f, 0.2f, 0, 0, 0.2f}, grey[1] = {0.4f};
    for (int all = 0; all < 2; ++all) {
        struct grown grown;
        prepare(&grown, 4000, all);
        grown.set[0].density = image(grey, 1, 1);
        grown.set[1].density = image(bands, 10, 1);
        grown.desc.map_sets[0] = &grown.set[0];
        grown.desc.map_sets[1] = &grown.set[1];
        hair_groom* groom = hair_test_groom_of(&grown.desc);
        uint32_t sum = 0;
        for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
            struct hair_patch patch = groom->patches[i];
            assert_int_equal(patch.first, sum);
            sum += patch.count;
            assert_in_range(patch.count, 1, HAIR_MAX_ISOLINES);
            for (uint32_t k = 0; (float)k < wanted_of(&patch, patch.map_density.y, 1); ++k) {
                // The image is black between the middles of its black texels.
                float u = 10 * root_of(groom, patch.first + k).x / SIDE;
                assert_false((u > 2.501f && u < 4.499f) || (u > 7.501f && u < 8.499f));
            }
        }
        assert_int_equal(sum, groom->info.follower_count);
        hair_groom_destroy(groom);
        free_grown(&grown);
    }
}

// Check a ramp. If each of n followers in a column were drawn independently, the error would be
// sqrt(n / 4), which is 14 for 800. Patches divided in four have a smaller error.
static void density_ramp_is_kept_at_any_patch_prefix(void** state)
{
    (void)state;
    static const float ramp[2] = {0, 1};
    struct grown grown;
    prepare(&grown, 8000, 0);
    // The image is 0 up to a quarter, and 1 from three quarters on.
    grown.set[0].density = image(ramp, 2, 1);
    grown.desc.map_sets[0] = &grown.set[0];
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    for (int k = 1; k <= 4; ++k) {
        double count[10];
        count_columns(groom, 0.25f * (float)k, count);
        for (int i = 0; i < 10; ++i) {
            double density = fmin(fmax((i + 0.5) / 10 * 2 - 0.5, 0), 1);
            assert_float_equal(count[i], 800 * density * k / 4, 30);
        }
    }
    hair_groom_destroy(groom);
    free_grown(&grown);
}

// Check stripes narrower than patches, of two densities that are similar enough to share a patch.
static void followers_in_one_patch_keep_the_density_of_their_root(void** state)
{
    (void)state;
    float stripes[40];
    struct grown grown;
    prepare(&grown, 8000, 0);
    for (int i = 0; i < 40; ++i) stripes[i] = i % 4 < 2 ? 0.55f : 0.75f;
    grown.set[0].density = image(stripes, 40, 1);
    grown.desc.map_sets[0] = &grown.set[0];
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    assert_true(groom->info.patch_count < 200);
    for (int k = 1; k <= 4; ++k) {
        double drawn[2] = {0}, all[2] = {0};
        for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
            struct hair_patch patch = groom->patches[i];
            float wanted = wanted_of(&patch, patch.map_density.x, 0.25f * (float)k);
            for (uint32_t j = 0; j < patch.count; ++j) {
                int stripe = (int)(10 * root_of(groom, patch.first + j).x / SIDE * 2) & 1;
                all[stripe] += 1;
                drawn[stripe] += (double)fminf(fmaxf(wanted - (float)j, 0), 1);
            }
        }
        // A quarter of a stripe is the transition to the next stripe.
        assert_float_equal(drawn[0] / all[0], (0.55 * 7 + 0.75) / 8 * k / 4, 0.015);
        assert_float_equal(drawn[1] / all[1], (0.75 * 7 + 0.55) / 8 * k / 4, 0.015);
    }
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void linear_map_is_equal_by_image_and_by_vertices(void** state)
{
    (void)state;
    float values[VERTICES], wide[200];
    struct grown grown;
    prepare(&grown, 3000, 0);
    for (int i = 0; i < VERTICES; ++i) values[i] = 0.1f + 0.8f * grown.uvs[2 * i];
    for (int i = 0; i < 200; ++i) wide[i] = 0.1f + 0.8f * ((float)i + 0.5f) / 200;
    grown.desc.map_sets[0] = &grown.set[0];
    grown.set[0].thickness = (hair_map){HAIR_MAP_SOURCE_VERTICES, values, 0, 0};
    hair_groom* by_vertices = hair_test_groom_of(&grown.desc);
    grown.set[0].thickness = image(wide, 200, 1);
    hair_groom* by_image = hair_test_groom_of(&grown.desc);
    grown.desc.map_sets[0] = NULL;
    hair_groom* plain = hair_test_groom_of(&grown.desc);
    for (uint32_t i = 0; i < 3000; ++i) {
        float u = root_of(plain, i).x / SIDE;
        float thickness = by_vertices->followers[i].offset[0].w / plain->followers[i].offset[0].w;
        assert_float_equal(thickness, 0.1f + 0.8f * u, 1e-4);
        assert_float_equal(by_image->followers[i].offset[0].w, by_vertices->followers[i].offset[0].w, 0.004);
    }
    for (uint32_t i = 0; i < plain->info.patch_count; ++i) {
        assert_float_equal(plain->patches[i].map_thickness.y, 1, 0);
        assert_float_equal(plain->patches[i].map_density.w, 1, 0);
    }
    hair_groom_destroy(by_vertices);
    hair_groom_destroy(by_image);
    hair_groom_destroy(plain);
    free_grown(&grown);
}

static float of_set(const hair_vec4* v, int set)
{
    return (&v->x)[set];
}

// Check that each set has its own density and thickness, with one order of followers for all sets.
static void patches_know_every_map_set(void** state)
{
    (void)state;
    static const float left[2] = {1, 0}, right[2] = {0, 1}, thick[4] = {0.5f, 2, 0.5f, 2};
    float values[TRIANGLES];
    struct grown grown;
    prepare(&grown, 6000, 0);
    for (uint32_t i = 0; i < TRIANGLES; ++i) values[i] = i % 2 ? 1 : 0.3f;
    grown.set[0].density = image(left, 2, 1);
    grown.set[1].density = image(right, 2, 1);
    grown.set[1].thickness = image(thick, 2, 2);
    grown.set[2].density = (hair_map){HAIR_MAP_SOURCE_TRIANGLES, values, 0, 0};
    for (int i = 0; i < 3; ++i) grown.desc.map_sets[i] = &grown.set[i];
    hair_groom* groom = hair_test_groom_of(&grown.desc);
    assert_int_equal(groom->map_sets, 3);
    double sum[4] = {0};
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        const struct hair_patch* patch = &groom->patches[i];
        for (int set = 0; set < 4; ++set)
            sum[set] += (double)(of_set(&patch->map_density, set) * (float)patch->count);
        // Missing sets repeat the last set.
        assert_float_equal(patch->map_density.w, patch->map_density.z, 0);
        for (uint32_t k = 0; k < patch->count; ++k) {
            float u = root_of(groom, patch->first + k).x / SIDE;
            float ramp = fminf(fmaxf(2 * u - 0.5f, 0), 1);
            assert_float_equal(patch->map_density.x, 1 - ramp, 0.2501);
            assert_float_equal(patch->map_density.y, ramp, 0.2501);
            // Maximum over all sets, which the follower's own radius includes.
            float max = fmaxf(1, 0.5f + 1.5f * ramp);
            assert_float_equal(patch->map_thickness.x, 1 / max, 0.1251);
            assert_float_equal(patch->map_thickness.y, (0.5f + 1.5f * ramp) / max, 0.1251);
        }
    }
    assert_float_equal(sum[0] / 6000, 0.5, 0.01);
    assert_float_equal(sum[1] / 6000, 0.5, 0.01);
    assert_float_equal(sum[2] / 6000, 0.65, 0.01);
    hair_groom_destroy(groom);
    free_grown(&grown);
}

static void invalid_maps_are_refused_by_set_index_and_range(void** state)
{
    (void)state;
    float values[VERTICES] = {0};
    struct grown grown;
    prepare(&grown, 100, 0);
    hair_map_set* set = &grown.set[0];
    grown.desc.map_sets[1] = &grown.set[1];
    hair_test_refuse_groom(&test, &grown.desc, "map_sets[0] is NULL but [1] is not");
    grown.desc.map_sets[0] = set;
    set->density = (hair_map){HAIR_MAP_SOURCE_VERTICES, NULL, 0, 0};
    hair_test_refuse_groom(&test, &grown.desc, "map_sets[0].density.values is NULL");
    set->density.source = (hair_map_source)7;
    hair_test_refuse_groom(&test, &grown.desc, "map_sets[0].density.source is 7, not in [0, 3]");
    set->density = (hair_map){HAIR_MAP_SOURCE_VERTICES, values, 0, 0};
    values[7] = 1.5f;
    hair_test_refuse_groom(&test, &grown.desc, "map_sets[0].density.values[7] is 1.5, not in [0, 1]");
    values[7] = NAN;
    hair_test_refuse_groom(&test, &grown.desc, "map_sets[0].density.values[7] is");
    values[7] = 0;
    grown.set[1].thickness = image(values, 4, 2);
    values[6] = 4.5f;
    set->density = (hair_map){0};
    hair_test_refuse_groom(&test, &grown.desc, "map_sets[1].thickness.values[6] is 4.5, not in [0, 4]");
    grown.set[1].thickness = image(values, 0, 2);
    hair_test_refuse_groom(&test, &grown.desc,
                           "map_sets[1].thickness is an image of 0 by 2, not of [1, 16384] each");
    grown.set[1].thickness = image(values, 2, 1);
    grown.desc.scalp_uvs = NULL;
    hair_test_refuse_groom(&test, &grown.desc, "scalp_uvs is NULL but map_sets[1].thickness is an image");
    grown.desc.scalp_uvs = grown.uvs;
    grown.uvs[9] = INFINITY;
    hair_test_refuse_groom(&test, &grown.desc, "scalp_uvs: vertex 4 has inf, not in [-1e6, 1e6]");
    grown.desc.scalp_positions = NULL;
    hair_test_refuse_groom(&test, &grown.desc, "scalp_positions is NULL");
    hair_groom_desc plain = hair_test_groom_desc(&test, &grown.strands);
    plain.map_sets[0] = set;
    hair_test_refuse_groom(&test, &plain, "scalp_positions is NULL but map_sets[0] is not");
    free_grown(&grown);
}

static void refused_allocations_of_maps_leak_nothing(void** state)
{
    (void)state;
    static const float noise[9] = {1, 0, 0.3f, 0.7f, 0, 1, 0.2f, 0.9f, 0.5f};
    for (int all = 0; all < 2; ++all) {
        struct grown grown;
        prepare(&grown, 300, all);
        grown.set[0].density = grown.set[0].thickness = image(noise, 3, 3);
        grown.desc.map_sets[0] = grown.desc.map_sets[1] = &grown.set[0];
        for (uint32_t n = 1;; ++n) {
            hair_groom* groom = NULL;
            test.allocations = 0;
            test.refuse = n;
            hair_result result = hair_groom_create(&grown.desc, &groom);
            int went_round = test.allocations < n;
            test.refuse = 0;
            test.errors = 0;
            hair_groom_destroy(groom);
            assert_int_equal(test.blocks, 0);
            if (went_round) {
                assert_int_equal(result, HAIR_OK);
                break;
            }
            assert_int_equal(result, HAIR_ERROR_MEMORY);
        }
        free_grown(&grown);
    }
}

#define TEST(function) HAIR_TEST_WITH_HOST(function, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(followers_are_absent_where_the_density_image_is_black),
        TEST(density_ramp_is_kept_at_any_patch_prefix),
        TEST(followers_in_one_patch_keep_the_density_of_their_root),
        TEST(linear_map_is_equal_by_image_and_by_vertices),
        TEST(patches_know_every_map_set),
        TEST(invalid_maps_are_refused_by_set_index_and_range),
        TEST(refused_allocations_of_maps_leak_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
