// scalp_input_test.c - a skinned scalp as the library receives it: from memory or in a buffer of
// any bytes, with invalid values refused. Runs with a scalp can be saved.
#include "tests/support/skinned.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/glstate.h"

#define STEP (1.0f / 30)

struct given {
    GLuint buffer;
    size_t offset, stride;
};

static struct given put_in_buffer(const struct hair_test_skinned* s, size_t offset, size_t stride)
{
    struct given given = {0, offset, stride};
    size_t size = offset + stride * (HAIR_TEST_SCALP_VERTICES - 1) + 12;
    char* bytes = calloc(1, size);
    for (size_t i = 0; i < HAIR_TEST_SCALP_VERTICES; ++i)
        memcpy(bytes + offset + i * stride, s->positions + 3 * i, 12);
    glCreateBuffers(1, &given.buffer);
    glNamedBufferStorage(given.buffer, (GLsizeiptr)size, bytes, 0);
    free(bytes);
    return given;
}

static void scalp_from_a_buffer_equals_scalp_from_memory(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points a, b;
    struct hair_test_skinned memory =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
                             buffer =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    static const size_t layouts[3][2] = {{0, 12}, {20, 32}, {1028, 28}};
    for (int frame = 1; frame <= 9; ++frame) {
        hair_test_skinned_bulge(&memory, STEP * (float)frame);
        hair_test_skinned_set(test, &memory);
        memcpy(buffer.positions, memory.positions, sizeof memory.positions);
        struct given given = put_in_buffer(&buffer, layouts[frame % 3][0], layouts[frame % 3][1]);
        hair_test_ok(test,
                     hair_set_scalp_buffer(buffer.hair, given.buffer, given.offset, given.stride, NULL));
        glDeleteBuffers(1, &given.buffer); // The library has read the buffer.
        hair_test_ok(test, hair_step(memory.hair, STEP));
        hair_test_ok(test, hair_step(buffer.hair, STEP));
        hair_test_read_points(test, memory.hair, HAIR_READ_GUIDES, &a);
        hair_test_read_points(test, buffer.hair, HAIR_READ_GUIDES, &b);
        assert_memory_equal(a.at, b.at, 12 * a.count);
        hair_test_read_points(test, memory.hair, HAIR_READ_FOLLOWERS, &a);
        hair_test_read_points(test, buffer.hair, HAIR_READ_FOLLOWERS, &b);
        assert_memory_equal(a.at, b.at, 12 * a.count);
    }
    hair_destroy(memory.hair), hair_destroy(buffer.hair);
}

// Check that steps queued without waiting for the GPU equal steps with a wait after each. NVIDIA's
// driver let a new scalp overtake dispatches that had yet to read an earlier one.
static void scalps_of_queued_steps_do_not_overtake_each_other(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points waited, queued;
    for (int kind = 0; kind < 2; ++kind) {
        struct hair_test_skinned s[2] = {
            hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
            hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO)};
        for (int waits = 0; waits < 2; ++waits)
            for (int frame = 1; frame <= 8; ++frame) {
                hair_test_skinned_bulge(&s[waits], STEP * (float)frame);
                struct given given = put_in_buffer(&s[waits], 0, 12);
                if (kind == 0)
                    hair_test_skinned_set(test, &s[waits]);
                else
                    hair_test_ok(test, hair_set_scalp_buffer(s[waits].hair, given.buffer, 0, 12, NULL));
                glDeleteBuffers(1, &given.buffer);
                hair_test_ok(test, hair_step(s[waits].hair, STEP));
                if (waits) glFinish();
            }
        hair_test_read_points(test, s[0].hair, HAIR_READ_FOLLOWERS, &queued);
        hair_test_read_points(test, s[1].hair, HAIR_READ_FOLLOWERS, &waited);
        assert_memory_equal(queued.at, waited.at, 12 * waited.count);
        hair_destroy(s[0].hair), hair_destroy(s[1].hair);
    }
}

// Check scalps that are not finite or degenerate. Hair on them stays where it is relative to the
// head, and the rest continues.
static void scalp_buffer_of_any_bytes_keeps_hair_finite(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points seen, before;
    for (int redblack = 0; redblack < 2; ++redblack) {
        struct hair_test_skinned s = hair_test_skinned_make(
            test, redblack ? HAIR_SOLVER_REDBLACK : HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
        for (int frame = 1; frame <= 12; ++frame) {
            hair_test_skinned_bulge(&s, STEP * (float)frame);
            float* p = s.positions;
            if (frame % 4 == 1) p[7] = NAN, p[20] = INFINITY, p[33] = 3e38f;
            // Makes triangles that are points.
            if (frame % 4 == 2) memcpy(p + 3, p, 12), memcpy(p + 12, p, 12);
            if (frame % 4 == 3)
                // All on one line.
                for (int i = 0; i < HAIR_TEST_SCALP_VERTICES; ++i) p[3 * i + 1] = p[3 * i + 2] = p[3 * i];
            if (frame > 8)
                for (int i = 0; i < 3 * HAIR_TEST_SCALP_VERTICES; ++i) p[i] = frame % 2 ? NAN : -3e38f;
            struct given given = put_in_buffer(&s, 0, 12);
            hair_test_ok(test, hair_set_scalp_buffer(s.hair, given.buffer, given.offset, given.stride, NULL));
            glDeleteBuffers(1, &given.buffer);
            if (frame == 9) hair_test_read_points(test, s.hair, HAIR_READ_GUIDES, &before);
            hair_test_ok(test, hair_step(s.hair, STEP));
            hair_test_read_points(test, s.hair, HAIR_READ_GUIDES, &seen);
            hair_test_read_points(test, s.hair, HAIR_READ_FOLLOWERS, &seen);
            if (frame == 6) hair_test_ok(test, hair_reset(s.hair));
        }
        hair_test_read_points(test, s.hair, HAIR_READ_GUIDES, &seen);
        for (uint32_t k = 0; k < HAIR_TEST_SCALP_GUIDES;
             ++k) // The root is still where the last good scalp had it.
            assert_true(hair_distance(hair_load3(seen.at + 30 * k), hair_load3(before.at + 30 * k)) < 0.03f);
        hair_destroy(s.hair);
    }
}

static void invalid_scalp_is_refused_by_name_value_and_range(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_skinned s = hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    float m[16] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_instance* h = s.hair;
    float* p = s.positions;
    hair_result bad = HAIR_ERROR_ARGUMENT;
    assert_int_equal(hair_set_scalp(NULL, p, HAIR_TEST_SCALP_VERTICES, 12, NULL), bad);
    assert_int_equal(hair_set_scalp_buffer(NULL, 1, 0, 12, NULL), bad);
    hair_test_refused(test, hair_set_scalp(h, NULL, HAIR_TEST_SCALP_VERTICES, 12, NULL), bad,
                      "positions is NULL");
    hair_test_refused(test, hair_set_scalp(h, p, 24, 12, NULL), bad,
                      "count is 24, not the 25 of the groom's scalp");
    hair_test_refused(test, hair_set_scalp(h, p, HAIR_TEST_SCALP_VERTICES, 8, NULL), bad,
                      "stride is 8, not a multiple of 4 in [12, 4096]");
    hair_test_refused(test, hair_set_scalp(h, p, HAIR_TEST_SCALP_VERTICES, 14, NULL), bad, "stride is 14");
    hair_test_refused(test, hair_set_scalp(h, p, HAIR_TEST_SCALP_VERTICES, 4100, NULL), bad,
                      "stride is 4100");
    hair_test_refused(test, hair_set_scalp(h, p, HAIR_TEST_SCALP_VERTICES, 12, m), bad,
                      "to_world is not a rigid motion");
    p[7] = NAN;
    hair_test_refused(test, hair_set_scalp(h, p, HAIR_TEST_SCALP_VERTICES, 12, NULL), bad,
                      "positions: vertex 2 is (");
    p[7] = 0;
    struct given in = put_in_buffer(&s, 8, 16);
    GLuint of[2];
    glGenBuffers(2, of); // The names have no buffers yet.
    hair_test_refused(test, hair_set_scalp_buffer(h, 0, 0, 12, NULL), bad, "gl_buffer is 0, not a buffer");
    hair_test_refused(test, hair_set_scalp_buffer(h, of[0], 0, 12, NULL), bad, "not a buffer");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, 8, 10, NULL), bad, "stride is 10");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, 6, 16, NULL), bad,
                      "offset is 6, not a multiple of 4");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, 12, 16, NULL), bad,
                      "404 bytes hold the 396 of the scalp");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, SIZE_MAX - 3, 16, NULL), bad, "offset is");
    hair_test_ok(test, hair_set_scalp_buffer(h, in.buffer, 8, 16, NULL));
    GLuint mapped;
    glCreateBuffers(1, &mapped);
    glNamedBufferData(mapped, 4096, NULL, GL_STREAM_DRAW);
    assert_non_null(glMapNamedBuffer(mapped, GL_WRITE_ONLY));
    hair_test_refused(test, hair_set_scalp_buffer(h, mapped, 0, 12, NULL), bad, "is mapped");
    glUnmapNamedBuffer(mapped);
    glDeleteBuffers(1, &mapped);
    glDeleteBuffers(1, &in.buffer);
    glDeleteBuffers(2, of);
    hair_destroy(s.hair);
}

static void groom_without_a_scalp_refuses_skinning(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_strands strands = hair_test_fur(20);
    hair_groom_desc groom = hair_test_groom_desc(&test->host, &strands);
    hair_desc desc = hair_desc_default();
    hair_groom* plain = NULL;
    hair_instance* hair = NULL;
    float p[9] = {0};
    hair_test_ok(test, hair_groom_create(&groom, &plain));
    hair_test_ok(test, hair_create(test->context, plain, &desc, &hair));
    hair_test_refused(test, hair_set_scalp(hair, p, 3, 12, NULL), HAIR_ERROR_ARGUMENT,
                      "its groom has no scalp");
    hair_destroy(hair);
    hair_groom_destroy(plain);
    hair_test_strands_free(&strands);
}

static void run(struct hair_test* test, struct hair_test_skinned* s, int from, int to)
{
    for (int frame = from; frame < to; ++frame) {
        hair_test_skinned_bulge(s, STEP * (float)frame);
        hair_test_skinned_set(test, s);
        hair_test_ok(test, hair_step(s->hair, frame % 3 ? STEP : 0.002f));
    }
}

// Save between a scalp and its step. Load into the same instance, another one, and one that has
// never had a scalp.
static void saved_run_with_a_scalp_continues_bit_for_bit(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points straight[2], again[2];
    struct hair_test_skinned s = hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    size_t size = 0, plain_size = 0;
    hair_test_ok(test, hair_save(s.hair, NULL, 0, &plain_size));
    char* plain = malloc(plain_size);
    hair_test_ok(test, hair_save(s.hair, plain, plain_size, &plain_size));
    run(test, &s, 1, 7);
    hair_test_skinned_bulge(&s, 7 * STEP);
    hair_test_skinned_set(test, &s);
    hair_test_ok(test, hair_save(s.hair, NULL, 0, &size));
    char* bytes = malloc(size);
    hair_test_ok(test, hair_save(s.hair, bytes, size, &size));
    for (int k = 0; k < 3; ++k) {
        struct hair_test_skinned other =
            hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
        struct hair_test_skinned* in = k == 2 ? &other : &s;
        struct hair_test_points* to = k ? again : straight;
        if (k) hair_test_ok(test, hair_load(in->hair, bytes, size));
        hair_test_ok(test, hair_step(in->hair, STEP));
        hair_test_read_points(test, in->hair, HAIR_READ_FOLLOWERS, &to[0]);
        run(test, in, 8, 11);
        hair_test_read_points(test, in->hair, HAIR_READ_GUIDES, &to[1]);
        for (int i = 0; i < 2 && k; ++i)
            assert_memory_equal(again[i].at, straight[i].at, 12 * again[i].count);
        hair_destroy(other.hair);
    }
    // A state saved before there was a scalp has a scalp at rest.
    hair_test_ok(test, hair_load(s.hair, plain, plain_size));
    hair_test_read_points(test, s.hair, HAIR_READ_FOLLOWERS, &straight[0]);
    struct hair_test_skinned fresh =
        hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    hair_test_read_points(test, fresh.hair, HAIR_READ_FOLLOWERS, &again[0]);
    assert_true(hair_test_points_distance(&straight[0], &again[0]) < 1e-6);
    hair_destroy(fresh.hair), hair_destroy(s.hair);
    free(bytes), free(plain);
}

static void skinned_scalp_changes_no_opengl_state(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_skinned s = hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    struct given in = put_in_buffer(&s, 0, 12);
    static struct hair_test_glstate before, after;
    static struct hair_test_points seen;
    hair_test_glstate_disturb();
    hair_test_glstate_read(&before);
    hair_test_ok(test, hair_set_scalp_buffer(s.hair, in.buffer, 0, 12, NULL));
    hair_test_ok(test, hair_step(s.hair, STEP));
    hair_test_read_points(test, s.hair, HAIR_READ_FOLLOWERS, &seen);
    hair_test_glstate_read(&after);
    size_t other = hair_test_glstate_differ(&before, &after, 0);
    if (other < before.count) fail_msg("%s has changed", before.values[other].name);
    glDeleteBuffers(1, &in.buffer);
    hair_destroy(s.hair);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(scalp_from_a_buffer_equals_scalp_from_memory),
        HAIR_TEST(scalps_of_queued_steps_do_not_overtake_each_other),
        HAIR_TEST(scalp_buffer_of_any_bytes_keeps_hair_finite),
        HAIR_TEST(invalid_scalp_is_refused_by_name_value_and_range),
        HAIR_TEST(groom_without_a_scalp_refuses_skinning),
        HAIR_TEST(saved_run_with_a_scalp_continues_bit_for_bit),
        HAIR_TEST(skinned_scalp_changes_no_opengl_state),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
