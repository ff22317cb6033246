// groom_guide_shape_test.c - the shape of guides: their vertices, lengths, root frames and rest
// distances.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_quat frame_of(const struct hair_guide* guide)
{
    hair_vec4 q = guide->root_frame;
    return (hair_quat){q.x, q.y, q.z, q.w};
}

static hair_vec3 vertex(const hair_groom* groom, uint32_t guide, uint32_t i)
{
    return hair_test_xyz(groom->rest[groom->guides[guide].first + i].position);
}

// Evaluate a curl of 2 turns, offset by the strand's number.
static hair_vec3 curl(float t, uint32_t strand, const void* user)
{
    (void)user;
    return hair_v3(0.1f * (float)strand + 0.02f * cosf(12.566f * t), -0.2f * t, 0.02f * sinf(12.566f * t));
}

// Evaluate a straight strand that points away from a sphere, with roots all over the sphere.
static hair_vec3 hedgehog(float t, uint32_t strand, const void* user)
{
    float z = 1 - 2 * ((float)strand + 0.5f) / *(const float*)user, angle = 2.39996f * (float)strand;
    float r = sqrtf(1 - z * z);
    return hair_scale(hair_v3(r * cosf(angle), r * sinf(angle), z), 0.1f + 0.05f * t);
}

// Check the number of vertices. The scalp pins two, so a strand of fewer than four gets more if
// guide_vertices permits, and can move.
static void guide_keeps_its_vertices_between_4_and_guide_vertices(void** state)
{
    (void)state;
    static const uint32_t given[] = {2, 3, 4, 5, 16, 17, 64, 255}, asked[] = {2, 3, 4, 16, 64, 65, 254, 256};
    struct hair_test_strands strands = hair_test_strands_make(8, 256);
    for (int i = 0; i < 8; ++i) hair_test_strands_add(&strands, given[i], curl, NULL);
    for (int k = 0; k < 8; ++k) {
        hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
        desc.strand_set = HAIR_STRAND_SET_GUIDES;
        desc.guide_vertices = asked[k];
        hair_groom* groom = hair_test_groom_of(&desc);
        uint32_t first = 0, max = 0;
        for (uint32_t i = 0; i < 8; ++i) {
            uint32_t kept = given[i] < 4 ? 4 : given[i];
            if (kept > asked[k]) kept = asked[k];
            if (kept > max) max = kept;
            assert_int_equal(groom->guides[i].first, first);
            assert_int_equal(groom->guides[i].count, kept);
            first += kept;
            for (uint32_t j = 0; kept == given[i] && j < kept; ++j)
                assert_true(hair_distance(vertex(groom, i, j), curl((float)j / (float)(kept - 1), i, NULL)) ==
                            0);
            assert_true(hair_distance(vertex(groom, i, 0), curl(0, i, NULL)) == 0);
            assert_true(hair_distance(vertex(groom, i, kept - 1), curl(1, i, NULL)) == 0);
        }
        assert_int_equal(groom->info.guide_vertex_count, first);
        assert_int_equal(groom->max_vertices, max);
        hair_groom_destroy(groom);
    }
    hair_test_strands_free(&strands);
}

static double length_of(const float* p, uint32_t vertices)
{
    double sum = 0;
    for (uint32_t i = 1; i < vertices; ++i)
        sum += (double)hair_distance(hair_load3(p + 3 * i), hair_load3(p + 3 * (i - 1)));
    return sum;
}

// Check lengths. Arcs have 4 pi / 31 of rotation per segment, at a slope. A chord is shorter by
// (rotation per segment)^2 / 24, times the circular fraction of the motion.
static void guide_keeps_the_length_of_its_strand(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(3, 200);
    hair_test_strands_add(&strands, 3, curl, NULL);
    hair_test_strands_add(&strands, 32, curl, NULL);
    hair_test_strands_add(&strands, 200, curl, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    hair_groom* groom = hair_test_groom_of(&desc);
    assert_float_equal(groom->guides[0].arc_length / length_of(strands.positions, 3), 1, 1e-6);
    assert_float_equal(groom->guides[1].arc_length / length_of(strands.positions + 9, 32), 1, 1e-6);

    double turn = 12.566 / 31, around = 0.02 * 12.566,
           fraction = around * around / (around * around + 0.2 * 0.2);
    double loss = 1 - groom->guides[2].arc_length / length_of(strands.positions + 3 * 35, 200);
    printf("200 vertices brought down to 32: %.2f %% shorter\n", 100 * loss);
    assert_float_equal(loss, fraction * turn * turn / 24, 0.1 * turn * turn / 24);
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void every_root_frame_is_a_rotation_of_y_onto_the_first_segment(void** state)
{
    (void)state;
    float count = 1000;
    struct hair_test_strands strands = hair_test_strands_make(1000, 5);
    for (int i = 0; i < 1000; ++i) hair_test_strands_add(&strands, 5, hedgehog, &count);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    hair_groom* groom = hair_test_groom_of(&desc);
    for (uint32_t i = 0; i < 1000; ++i) {
        hair_quat q = frame_of(&groom->guides[i]);
        hair_vec3 along =
            hair_normalize(hair_sub(vertex(groom, i, 1), vertex(groom, i, 0)), hair_v3(0, 0, 0));
        assert_float_equal(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6);
        assert_true(hair_distance(hair_rotate(q, hair_v3(0, 1, 0)), along) < 2e-6f);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Check frames over the upper half of the sphere. The frames of neighbours may differ by slightly
// more than their directions.
static void root_frames_vary_as_smoothly_as_the_roots(void** state)
{
    (void)state;
    float count = 4000;
    struct hair_test_strands strands = hair_test_strands_make(2000, 5);
    for (int i = 0; i < 2000; ++i) hair_test_strands_add(&strands, 5, hedgehog, &count);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    hair_groom* groom = hair_test_groom_of(&desc);
    for (uint32_t i = 0; i < 2000; ++i)
        for (uint32_t j = 0; j < i; ++j) {
            hair_quat a = frame_of(&groom->guides[i]), b = frame_of(&groom->guides[j]);
            float along = hair_distance(hair_rotate(a, hair_v3(0, 1, 0)), hair_rotate(b, hair_v3(0, 1, 0)));
            float across = hair_distance(hair_rotate(a, hair_v3(1, 0, 0)), hair_rotate(b, hair_v3(1, 0, 0)));
            if (along < 0.1f) assert_true(across < 1.5f * along);
        }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

// Return 1 or -1 if both are the same rotation.
static float same_turn(hair_quat a, hair_vec4 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

// Check F_i = T_i F_(i-1), the frames along a guide, where T_i is the rotation at vertex i. Lengths
// and directions alone reproduce the vertices from the root frame.
static void guide_is_rebuilt_from_lengths_and_directions(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(20, 60);
    for (uint32_t i = 0; i < 20; ++i) hair_test_strands_add(&strands, 3 + 3 * i, curl, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    hair_groom* groom = hair_test_groom_of(&desc);
    for (uint32_t i = 0; i < 20; ++i) {
        const struct hair_rest* rest = groom->rest + groom->guides[i].first;
        hair_quat frame = frame_of(&groom->guides[i]);
        hair_vec3 at = hair_test_xyz(rest[0].position), before = hair_rotate(frame, hair_v3(0, 1, 0));
        for (uint32_t j = 0; j + 1 < groom->guides[i].count; ++j) {
            hair_vec4 own = rest[j].frame;
            hair_vec3 to = hair_rotate((hair_quat){own.x, own.y, own.z, own.w}, hair_v3(0, 1, 0));
            frame = hair_quat_multiply(hair_quat_between(before, to), frame);
            at = hair_add(at, hair_scale(to, rest[j].position.w));
            before = to;
            assert_true(hair_distance(at, hair_test_xyz(rest[j + 1].position)) < 5e-6f);
            assert_float_equal(fabsf(same_turn(frame, rest[j].frame)), 1, 1e-6);
        }
        assert_memory_equal(&rest[groom->guides[i].count - 1].frame, &rest[groom->guides[i].count - 2].frame,
                            sizeof rest->frame);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static void rest_distances_are_those_between_vertices(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(1, 20);
    hair_test_strands_add(&strands, 20, curl, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_groom* groom = hair_test_groom_of(&desc);
    const struct hair_rest* rest = groom->rest;
    for (uint32_t i = 0; i < 20; ++i) {
        float one = i < 19 ? hair_distance(vertex(groom, 0, i), vertex(groom, 0, i + 1)) : 0;
        assert_float_equal(rest[i].position.w, one, 0);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

static hair_vec3 zigzag(float t, uint32_t strand, const void* user)
{
    uint32_t vertices = *(const uint32_t*)user;
    return hair_v3(0.1f * (float)strand, (uint32_t)(t * (float)(vertices - 1) + 0.5f) % 2 ? 0.1f : 0, 0);
}

// Check zigzag strands. Equidistant samples may all fall on both ends of the zigzag, or on one end.
static void folded_strands_become_valid_guides(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_strands_make(3, 256);
    // With 240 segments, 41 samples take every sixth vertex.
    static const uint32_t vertices[] = {4, 32, 241};
    for (int i = 0; i < 3; ++i) hair_test_strands_add(&strands, vertices[i], zigzag, &vertices[i]);
    for (uint32_t guide_vertices = 2; guide_vertices <= HAIR_MAX_GUIDE_VERTICES; ++guide_vertices) {
        hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
        desc.guide_vertices = guide_vertices;
        hair_groom* groom = hair_test_groom_of(&desc);
        for (uint32_t i = 0; i < groom->info.guide_count; ++i) {
            const struct hair_guide* guide = &groom->guides[i];
            assert_in_range(guide->count, guide_vertices < 4 ? guide_vertices : 4, guide_vertices);
            for (uint32_t j = 0; j < guide->count; ++j) {
                const float* rest = &groom->rest[guide->first + j].position.x;
                for (size_t k = 0; k < sizeof *groom->rest / sizeof *rest; ++k)
                    assert_true(isfinite(rest[k]));
                if (j + 1 < guide->count) assert_true(rest[3] > 0);
            }
        }
        hair_groom_destroy(groom);
    }
    hair_test_strands_free(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

// Evaluate a strand whose vertices are bunched: all except the tip at the root, all except the root
// at the tip, or in pairs.
static hair_vec3 bunch(float t, uint32_t strand, const void* user)
{
    uint32_t i = (uint32_t)(t * *(const float*)user + 0.5f);
    float d = 2e-5f * (float)i;
    if (strand == 0) return hair_v3(0, t == 1 ? -1 : -d, 0);
    if (strand == 1) return hair_v3(1, t == 0 ? 0 : -1 - d, 0);
    return hair_v3(2, -0.1f * (float)(i / 2) - (i % 2 ? 2e-5f : 0), 0);
}

static void guide_vertices_are_distinct_and_end_at_the_tip(void** state)
{
    (void)state;
    const float last = 23;
    struct hair_test_strands strands = hair_test_strands_make(3, 24);
    for (int k = 0; k < 3; ++k) hair_test_strands_add(&strands, 24, bunch, &last);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    hair_groom* groom = hair_test_groom_of(&desc);
    for (uint32_t g = 0; g < 3; ++g) {
        float mean = groom->guides[g].arc_length / last;
        assert_int_equal(groom->guides[g].count, 24);
        for (uint32_t i = 0; i < 23; ++i)
            assert_true(hair_distance(vertex(groom, g, i), vertex(groom, g, i + 1)) >= 0.09f * mean);
        assert_true(hair_distance(vertex(groom, g, 23), bunch(1, g, &last)) < 1e-6f);
        assert_true(hair_distance(vertex(groom, g, 0), bunch(0, g, &last)) < 1e-6f);
    }
    hair_groom_destroy(groom);
    hair_test_strands_free(&strands);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(guide_keeps_its_vertices_between_4_and_guide_vertices),
        TEST(guide_keeps_the_length_of_its_strand),
        TEST(guide_vertices_are_distinct_and_end_at_the_tip),
        TEST(every_root_frame_is_a_rotation_of_y_onto_the_first_segment),
        TEST(root_frames_vary_as_smoothly_as_the_roots),
        TEST(guide_is_rebuilt_from_lengths_and_directions),
        TEST(rest_distances_are_those_between_vertices),
        TEST(folded_strands_become_valid_guides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
