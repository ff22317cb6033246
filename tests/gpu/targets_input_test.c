// targets_input_test.c - target poses in arrays and in buffers of OpenGL, and those that are
// refused.
#include "tests/support/targets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define EXACT 1e-5 // m

// Targets in a buffer of OpenGL, with a gap between them. Some are not finite.
static void buffer_targets_equal_array_targets(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    struct hair_test_living array, buffer;
    float* wide = calloc(cache.vertices * 5 + 2, sizeof *wide);
    float to_world[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0.1f, 0, 0, 1};
    GLuint name;
    hair_test_targets_live(test, 0, &array), hair_test_targets_live(test, 0, &buffer);
    hair_test_targets_blend(&array, 1, 0), hair_test_targets_blend(&buffer, 1, 0);
    for (uint32_t i = 0; i < cache.vertices; ++i) memcpy(wide + 2 + 5 * i, cache.frame[8] + 3 * i, 12);
    glCreateBuffers(1, &name);
    glNamedBufferData(name, (GLsizeiptr)((cache.vertices * 5 + 2) * sizeof *wide), wide, GL_STATIC_DRAW);
    hair_test_ok(test, hair_set_targets(array.hair, cache.frame[8], cache.vertices, 12, to_world));
    hair_test_ok(test, hair_set_targets_buffer(buffer.hair, name, 8, 20, to_world));
    hair_test_targets_step(&array), hair_test_targets_step(&buffer);
    hair_test_read_guides(&array), hair_test_read_guides(&buffer);
    assert_memory_equal(array.positions, buffer.positions, array.vertices * 3 * sizeof(float));
    const float* c = cache.frame[8] + 3;
    assert_true(fabsf(array.positions[3] - (c[2] + 0.1f)) < (float)EXACT);
    assert_true(fabsf(array.positions[5] + c[0]) < (float)EXACT);

    wide[2 + 5 * 3] = NAN, wide[2 + 5 * 4] = INFINITY, wide[2 + 5 * 5] = -3e38f;
    glNamedBufferSubData(name, 0, (GLsizeiptr)((cache.vertices * 5 + 2) * sizeof *wide), wide);
    for (int i = 0; i < 3; ++i) {
        hair_test_ok(test, hair_set_targets_buffer(buffer.hair, name, 8, 20, to_world));
        hair_test_targets_step(&buffer);
        hair_test_read_guides(&buffer); // Checks that all are finite.
        uint32_t count;
        free(hair_test_targets_read(&buffer, &count));
    }
    hair_test_refused(test, hair_set_targets_buffer(buffer.hair, name, 20, 20, NULL), HAIR_ERROR_ARGUMENT,
                      "offset is 20");
    hair_test_refused(test, hair_set_targets_buffer(buffer.hair, name + 77, 0, 12, NULL), HAIR_ERROR_ARGUMENT,
                      "not a buffer");
    glDeleteBuffers(1, &name);
    hair_test_die(&array), hair_test_die(&buffer);
    free(wide);
    hair_test_targets_forget(&cache);
}

static void wrong_targets_are_refused_with_their_range(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    struct hair_test_living living;
    float weights[2] = {1, -0.5f}, far[16] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_target_blend blend = hair_target_blend_default();
    hair_test_targets_live(test, 0, &living);
    hair_instance* hair = living.hair;
    uint32_t count = cache.vertices;
    float* at = cache.frame[0];
    hair_test_refused(test, hair_set_targets(hair, at, count - 1, 12, NULL), HAIR_ERROR_ARGUMENT, "count is");
    hair_test_refused(test, hair_set_targets(hair, NULL, 1, 12, NULL), HAIR_ERROR_ARGUMENT,
                      "positions is NULL");
    hair_test_refused(test, hair_set_targets(hair, at, count, 10, NULL), HAIR_ERROR_ARGUMENT, "[12, 4096]");
    hair_test_refused(test, hair_set_targets(hair, at, count, 12, far), HAIR_ERROR_ARGUMENT, "to_world");
    at[7] = NAN;
    hair_test_refused(test, hair_set_targets(hair, at, count, 12, NULL), HAIR_ERROR_ARGUMENT, "vertex 2 is");
    assert_false(hair_targets_are_on(&hair->sim));
    blend.guide_weights = weights;
    hair_test_refused(test, hair_set_target_blend(hair, &blend), HAIR_ERROR_ARGUMENT,
                      "guide_count is 0, not the 2");
    blend.guide_count = 2;
    hair_test_refused(test, hair_set_target_blend(hair, &blend), HAIR_ERROR_ARGUMENT,
                      "guide_weights[1] is -0.5, not in [0, 1]");
    weights[1] = 0;
    hair_test_ok(test, hair_set_target_blend(hair, &blend));
    // One guide follows, and the other is free.
    blend.blend_time = 0;
    hair_test_ok(test, hair_set_target_blend(hair, &blend));
    for (int i = 10; i < 20; ++i) hair_test_targets_play(&living, &cache, i);
    hair_test_read_guides(&living);
    uint32_t first, both[2];
    hair_test_ok(test, hair_groom_get_guides(living.groom, &first, 1, NULL, 0));
    hair_test_ok(test, hair_groom_get_guides(living.groom, both, 2, at, count));
    assert_true(first == both[0] && both[0] + both[1] == count);
    assert_true(hair_test_targets_distance(at, &living.groom->rest[0].position.x) < EXACT);
    hair_test_refused(test, hair_groom_get_guides(living.groom, NULL, 1, NULL, 0), HAIR_ERROR_ARGUMENT,
                      "guide_capacity is 1");
    assert_true(hair_test_targets_farthest(living.positions, cache.frame[19], first) < EXACT);
    assert_true(hair_test_targets_farthest(living.positions + 3 * first, cache.frame[19] + 3 * first,
                                           count - first) > 1e-3);
    hair_test_die(&living);
    hair_test_targets_forget(&cache);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(buffer_targets_equal_array_targets),
        HAIR_TEST(wrong_targets_are_refused_with_their_range),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
