// groom_hostile_test.c - a groom of any numbers is valid, or refused with a message.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define STRANDS 40
#define VERTICES 2000
#define SCALP 12

static struct hair_test_host test;

// Desc and arrays of one case.
struct hostile {
    float positions[3 * VERTICES], scalp[3 * SCALP], density[SCALP];
    float radii[STRANDS], colors[3 * VERTICES];
    uint32_t vertices[STRANDS], triangles[3 * 2 * SCALP];
    uint8_t groups[STRANDS], guides[STRANDS];
    hair_import import;
    hair_groom_desc desc;
    uint32_t random;
};

static uint32_t below(struct hostile* h, uint32_t limit)
{
    return (uint32_t)(hair_random(&h->random) * (float)limit);
}

// Return a random number. With a probability of `wild` / 100 it has an extreme value, or is not
// finite.
static float number(struct hostile* h, uint32_t wild)
{
    static const float extremes[] = {0, 1, -1, 1e-30f, 1e6f, -1e6f, 7e5f, 1e18f, 3e38f, 1e-6f, INFINITY, NAN};
    if (below(h, 100) < wild) return extremes[below(h, sizeof extremes / sizeof *extremes)];
    return 0.2f * hair_random(&h->random) - 0.1f;
}

static void invent(struct hostile* h, uint32_t seed)
{
    static const uint32_t wilds[] = {0, 1, 10, 60};
    memset(h, 0, sizeof *h);
    h->random = seed;
    uint32_t wild = wilds[below(h, 4)], left = VERTICES;
    h->import = hair_import_default();
    h->import.scale = below(h, 3) ? 1 : powf(10, (float)below(h, 13) - 6);
    h->import.up = (hair_up)below(h, 3);
    h->desc = hair_groom_desc_default();
    h->desc.host = &test.host;
    h->desc.import = &h->import;

    h->desc.strand_count = 1 + below(h, STRANDS);
    for (uint32_t i = 0; i < h->desc.strand_count; ++i) {
        h->vertices[i] = below(h, below(h, 4) ? 12 : 300);
        if (h->vertices[i] > left) h->vertices[i] = left;
        left -= h->vertices[i];
    }
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) h->positions[i] = number(h, wild);
    // Some strands have repeated vertices, and some alternate.
    for (uint32_t i = 6; i < 3 * VERTICES; ++i)
        if (seed % 3 == 1 && below(h, 2)) h->positions[i] = h->positions[i - 6];
    h->desc.positions = h->positions;
    h->desc.strand_vertices = h->vertices;
    h->desc.strand_set = (hair_strand_set)below(h, 2);
    h->desc.guide_count = below(h, 2) * below(h, 50);
    h->desc.guide_vertices = 2 + below(h, below(h, 4) ? 63 : 255);
    h->desc.follower_count = below(h, 500);
    h->desc.clump_radius = hair_random(&h->random);
    h->desc.seed = seed;

    for (uint32_t i = 0; i < 3 * VERTICES; ++i)
        h->colors[i] = below(h, 2000) || !wild ? hair_random(&h->random) : number(h, 100);
    for (uint32_t i = 0; i < STRANDS; ++i)
        h->radii[i] = below(h, 60) || !wild ? hair_random(&h->random) : number(h, 100);
    for (uint32_t i = 0; i < STRANDS; ++i)
        h->groups[i] = (uint8_t)(below(h, 400) ? below(h, 8) : below(h, 256));
    for (uint32_t i = 0; i < STRANDS; ++i)
        h->guides[i] = (uint8_t)(below(h, 400) ? below(h, 4) == 0 : below(h, 256));
    if (below(h, 2)) h->desc.strand_guides = h->guides;
    if (below(h, 2)) h->desc.strand_radii = h->radii;
    if (below(h, 2)) h->desc.strand_groups = h->groups;
    if (below(h, 2)) h->desc.colors = h->colors;
    h->desc.color_count = below(h, 2) * below(h, VERTICES / STRANDS);

    if (below(h, 2)) return;
    h->desc.scalp_vertex_count = 3 + below(h, SCALP - 2);
    h->desc.scalp_triangle_count = 1 + below(h, 2 * SCALP);
    for (uint32_t i = 0; i < 3 * SCALP; ++i) h->scalp[i] = number(h, wild / 10);
    for (uint32_t i = 0; i < SCALP; ++i) h->density[i] = wild ? hair_random(&h->random) : (float)below(h, 2);
    for (uint32_t i = 0; i < 6 * SCALP; ++i) h->triangles[i] = below(h, h->desc.scalp_vertex_count);
    if (seed % 17 == 0) h->triangles[2] = UINT32_MAX;
    h->desc.scalp_positions = h->scalp;
    h->desc.scalp_triangles = h->triangles;
    h->desc.scalp_density = below(h, 2) ? h->density : NULL;
}

static void assert_finite(const void* floats, size_t count)
{
    const float* p = floats;
    for (size_t i = 0; i < count; ++i) assert_true(isfinite(p[i]));
}

static void assert_sound(const hair_groom* groom)
{
    const hair_groom_info* info = &groom->info;
    assert_true(info->guide_count && info->follower_count && info->patch_count);
    for (uint32_t i = 0; i < info->guide_count; ++i) {
        assert_finite(&groom->guides[i].root_frame, 4);
        assert_true(isfinite(groom->guides[i].arc_length) && groom->guides[i].arc_length > 0);
        assert_in_range(groom->guides[i].count, 2, groom->max_vertices);
        assert_in_range(groom->guides[i].group, 0, info->group_count - 1);
    }
    assert_finite(groom->rest, 8 * (size_t)info->guide_vertex_count);
    for (uint32_t i = 0; i < info->follower_count; ++i) {
        const struct hair_follower* follower = &groom->followers[i];
        assert_true(follower->guide0 < info->guide_count);
        assert_true(follower->guide1 < info->guide_count);
        assert_true(follower->guide2 < info->guide_count);
        assert_int_equal(groom->guides[follower->guide1].group, groom->guides[follower->guide0].group);
        assert_int_equal(groom->guides[follower->guide2].group, groom->guides[follower->guide0].group);
        assert_finite(&follower->weight1, 20);
        assert_true(follower->length_ratio > 0);
    }
    for (uint32_t i = 0; i < info->patch_count; ++i) {
        assert_in_range(groom->patches[i].count, 1, HAIR_MAX_ISOLINES);
        assert_true(groom->patches[i].density >= 0 && groom->patches[i].density <= 1);
    }
}

static void any_numbers_are_refused_or_make_a_valid_groom(void** state)
{
    (void)state;
    static struct hostile hostile;
    uint32_t made = 0, refused = 0;
    for (uint32_t seed = 1; seed <= 3000; ++seed) {
        hair_groom* groom = NULL;
        hair_test_host_init(&test);
        invent(&hostile, seed);
        hair_result result = hair_groom_create(&hostile.desc, &groom);
        if (result) {
            assert_int_equal(result, HAIR_ERROR_ARGUMENT);
            assert_int_equal(test.errors, 1);
            assert_null(groom);
            ++refused;
        } else {
            assert_sound(groom);
            hair_groom_destroy(groom);
            ++made;
        }
        assert_int_equal(test.blocks, 0);
    }
    printf("%u made, %u refused\n", made, refused);
    assert_true(made > 1000 && refused > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_numbers_are_refused_or_make_a_valid_groom)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
