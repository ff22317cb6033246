// cut_scene.c - hair to cut: two guides, and a square of hanging hair whose drawn strands are read.
#include "tests/support/cut_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/grooms.h"
#include "tests/support/ways.h"

#define VERTICES 16
#define FRAME (1.0f / 60)

void hair_test_cut_live(struct hair_test* test, int way, struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_straight_and_curl();
    hair_desc desc = hair_test_way(way);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

void hair_test_cut_shake(struct hair_test_living* living, int from, int to)
{
    for (int i = from; i < to; ++i) {
        struct hair_reference_rod_pose head = hair_test_shaken(i * (double)FRAME);
        hair_test_advance(living, &head, (double)FRAME);
    }
}

void hair_test_cut_lengths(struct hair_test_living* living, float straight, float curl)
{
    const float fractions[HAIR_TEST_CUT_CURL] = {straight, curl};
    hair_test_ok(living->test, hair_set_lengths(living->hair, 0, HAIR_TEST_CUT_CURL, fractions));
}

// Copy the attributes and the scalp of a desc.
static void add_attributes(const hair_groom_desc* from, hair_groom_desc* out)
{
    out->strand_attributes = from->strand_attributes;
    out->strand_attribute_count = from->strand_attribute_count;
    out->scalp_positions = from->scalp_positions, out->scalp_vertex_count = from->scalp_vertex_count;
    out->scalp_triangles = from->scalp_triangles, out->scalp_triangle_count = from->scalp_triangle_count;
    out->scalp_uvs = from->scalp_uvs;
}

struct hair_test_scene hair_test_cut_scene(struct hair_test* test, hair_strand_set set, const hair_desc* desc,
                                           const hair_look* look, const float transform[16])
{
    return hair_test_cut_scene_with(test, set, desc, look, transform, NULL);
}

struct hair_test_scene hair_test_cut_scene_with(struct hair_test* test, hair_strand_set set,
                                                const hair_desc* desc, const hair_look* look,
                                                const float transform[16], const hair_groom_desc* attributes)
{
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    struct hair_test_strands strands = hair_test_strands_make(HAIR_TEST_CUT_GUIDES, VERTICES);
    uint8_t groups[HAIR_TEST_CUT_GUIDES];
    float radii[HAIR_TEST_CUT_GUIDES], colors[6 * HAIR_TEST_CUT_GUIDES];
    for (uint32_t i = 0; i < HAIR_TEST_CUT_GUIDES; ++i) {
        for (uint32_t k = 0; k < VERTICES; ++k)
            hair_store3(strands.positions + 3 * strands.vertex_count++,
                        hair_v3(0.02f * (float)(i % HAIR_TEST_CUT_ROW),
                                HAIR_TEST_CUT_HEIGHT - HAIR_TEST_CUT_LENGTH * (float)k / (VERTICES - 1),
                                0.02f * (float)(i / HAIR_TEST_CUT_ROW)));
        strands.vertices[strands.count++] = VERTICES;
        groups[i] = i % 2;
        radii[i] = 1 + 0.5f * (float)(i % 3);
        hair_store3(colors + 6 * (size_t)i, hair_v3((float)i / HAIR_TEST_CUT_GUIDES, 0, 0));
        hair_store3(colors + 6 * (size_t)i + 3, hair_v3((float)i / HAIR_TEST_CUT_GUIDES, 1, 0.5f));
    }
    strands.groups = groups;
    hair_groom_desc groom = hair_test_groom_desc(&test->host, &strands);
    groom.strand_set = set;
    groom.follower_count = 8 * HAIR_TEST_CUT_GUIDES, groom.guide_count = 4;
    groom.strand_radii = radii, groom.colors = colors, groom.color_count = 2;
    if (attributes) add_attributes(attributes, &groom);
    scene.groom = hair_test_groom_of(&groom);
    hair_desc of = desc ? *desc : hair_desc_default();
    of.look = look;
    if (transform) memcpy(of.transform, transform, sizeof of.transform);
    hair_test_ok(test, hair_create(test->context, scene.groom, &of, &scene.hair));
    hair_test_strands_free(&strands);
    return scene;
}

void hair_test_cut_swing(const struct hair_test_scene* scene, int frames)
{
    float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (int i = 0; i < frames; ++i) {
        transform[12] = 0.05f * sinf(6 * FRAME * (float)i);
        hair_test_ok(scene->test, hair_set_transform(scene->hair, transform));
        hair_test_ok(scene->test, hair_step(scene->hair, FRAME));
    }
}

struct hair_test_drawn hair_test_read_drawn(const struct hair_test* test, hair_instance* hair)
{
    struct hair_test_drawn out = {.count = hair->groom->info.follower_count};
    uint32_t all;
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_FOLLOWERS, NULL, 0, &all));
    out.positions = calloc(all, 3 * sizeof *out.positions);
    out.vertices = all / out.count;
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_FOLLOWERS, out.positions, all, &all));
    return out;
}

hair_vec3 hair_test_drawn_at(const struct hair_test_drawn* drawn, uint32_t strand, uint32_t vertex)
{
    return hair_load3(drawn->positions + 3 * ((size_t)strand * drawn->vertices + vertex));
}

double hair_test_drawn_length(const struct hair_test_drawn* drawn, uint32_t strand)
{
    double sum = 0;
    for (uint32_t k = 0; k + 1 < drawn->vertices; ++k)
        sum += (double)hair_distance(hair_test_drawn_at(drawn, strand, k),
                                     hair_test_drawn_at(drawn, strand, k + 1));
    return sum;
}

double hair_test_drawn_length_of_all(const struct hair_test_drawn* drawn)
{
    double sum = 0;
    for (uint32_t i = 0; i < drawn->count; ++i) sum += hair_test_drawn_length(drawn, i);
    return sum;
}
