// field_update_test.c - updates of the field: an update equals a new field, writes only what has
// changed, and recovers from refused memory.
#include "tests/support/field_scene.h"
#include "tests/support/fields.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/passes.h"

static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
// A rotated pose, so far away that floats no longer resolve a hundredth of a voxel.
static const struct hair_pose elsewhere = {{30, -20, 10}, {0.36f, 0.48f, 0, 0.8f}};

static uint32_t runs(struct hair_test_field_scene* f)
{
    return hair_test_runs(&f->test->context->gl, hair_field_pass(&f->field, HAIR_GL_VOXELISE));
}

static void assert_as_made_at_once(struct hair_test_field_scene* f, uint32_t count)
{
    struct hair_collider_field fresh;
    hair_field_create(&fresh, &f->test->context->sdf_pool, f->groom, HAIR_TEST_FIELD_VOXEL);
    hair_field_want_numbers(&fresh);
    hair_test_ok(f->test, hair_field_update(&fresh, f->colliders, count, &f->head));
    struct hair_test_field a = hair_test_field_read(&f->field), b = hair_test_field_read(&fresh);
    size_t voxels = hair_test_field_count(&a);
    assert_memory_equal(a.distance, b.distance, voxels * sizeof *a.distance);
    assert_memory_equal(a.number, b.number, voxels * sizeof *a.number);
    hair_test_field_free(&a);
    hair_test_field_free(&b);
    hair_field_destroy(&fresh);
}

static void updated_field_equals_a_new_field_bit_for_bit(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, elsewhere, &f);
    uint32_t count = HAIR_TEST_FIELD_COLLIDERS / 2;
    hair_test_field_update(&f, count);
    for (int round = 0; round < 12; ++round) {
        uint32_t which = (uint32_t)(hair_random(&f.random) * (float)count);
        // Colliders are added or removed.
        if (round % 4 == 3) count = 1 + (uint32_t)(hair_random(&f.random) * (HAIR_TEST_FIELD_COLLIDERS - 1));
        f.colliders[which] = hair_test_any_collider(&f.field.box, &f.head, 0.15f, &f.random);
        if (round % 4 == 2) f.colliders[which].position[1] += 100; // Moves out of the box.
        hair_test_field_update(&f, count);
        assert_as_made_at_once(&f, count);
    }
    hair_test_field_end(&f);
}

// Remove the functions of OpenGL, and check that an update without motion calls none.
// Numbers take twice the memory of distances, and only fluids and applications read them.
static void field_has_numbers_once_they_are_wanted(void** state)
{
    struct hair_test_field_scene f;
    struct hair_collider_field own;
    hair_test_field_begin(*state, elsewhere, &f);
    hair_field_create(&own, &f.test->context->sdf_pool, f.groom, HAIR_TEST_FIELD_VOXEL);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    uint64_t before = f.test->context->gl.memory.bytes;
    hair_test_ok(f.test, hair_field_update(&own, f.colliders, HAIR_TEST_FIELD_COLLIDERS, &f.head));
    uint64_t without = f.test->context->gl.memory.bytes - before;
    assert_int_equal(own.number, 0);
    assert_true(hair_field_is_near(&own));
    for (int round = 0; round < 3; ++round) {
        struct hair_test_field a = hair_test_field_read(&f.field), b = hair_test_field_read(&own);
        size_t voxels = hair_test_field_count(&a);
        assert_memory_equal(a.distance, b.distance, voxels * sizeof *a.distance);
        if (round) assert_memory_equal(a.number, b.number, voxels * sizeof *a.number);
        hair_test_field_free(&a);
        hair_test_field_free(&b);
        hair_field_want_numbers(&own);
        if (round) f.colliders[3].position[1] += 0.02f;
        hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
        hair_test_ok(f.test, hair_field_update(&own, f.colliders, HAIR_TEST_FIELD_COLLIDERS, &f.head));
    }
    uint64_t with = f.test->context->gl.memory.bytes - before;
    printf("    %llu bytes without numbers, %llu with\n", (unsigned long long)without,
           (unsigned long long)with);
    assert_true(2 * with > 5 * without);
    hair_field_destroy(&own);
    hair_test_field_end(&f);
}

static void field_update_without_motion_calls_no_opengl(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, elsewhere, &f);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    uint32_t before = runs(&f);
    struct hair_gl *gl = &f.test->context->gl, kept = *gl;
#define FUNCTION(type, name, parameters) gl->name = NULL;
#include "lib/gl/functions.inl"
#undef FUNCTION
    hair_result result = hair_field_update(&f.field, f.colliders, HAIR_TEST_FIELD_COLLIDERS, &f.head);
    // Motion within rounding does not count either.
    f.colliders[3].position[0] += 1e-6f;
    hair_result again = hair_field_update(&f.field, f.colliders, HAIR_TEST_FIELD_COLLIDERS, &f.head);
    *gl = kept;
    assert_int_equal(result, HAIR_OK);
    assert_int_equal(again, HAIR_OK);
    f.colliders[3].position[0] += 1e-3f;
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    assert_int_equal(runs(&f), before + 1);
    hair_test_field_end(&f);
}

// Check colliders that move with the head. Their position in the world is rounded at each step, and
// the errors must not add up.
static void colliders_that_move_with_the_head_are_not_rewritten(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    uint32_t before = runs(&f);
    hair_collider rest[HAIR_TEST_FIELD_COLLIDERS];
    memcpy(rest, f.colliders, sizeof rest);
    for (int step = 1; step <= 20; ++step) {
        float angle = 0.3f * (float)step;
        f.head.rotation = (hair_quat){0, sinf(angle / 2), 0, cosf(angle / 2)};
        f.head.position[0] = 0.1 * step;
        for (int i = 0; i < HAIR_TEST_FIELD_COLLIDERS; ++i) {
            hair_vec3 at = hair_rotate(f.head.rotation, hair_load3(rest[i].position));
            hair_quat own = {rest[i].rotation[0], rest[i].rotation[1], rest[i].rotation[2],
                             rest[i].rotation[3]};
            own = hair_quat_multiply(f.head.rotation, own);
            hair_store3(f.colliders[i].position, hair_add(at, hair_v3((float)f.head.position[0], 0, 0)));
            memcpy(f.colliders[i].rotation, &own, sizeof own);
        }
        hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    }
    assert_int_equal(runs(&f), before);
    hair_test_field_check(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_end(&f);
}

static void field_is_absent_without_a_collider_near(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    size_t bytes = f.test->host.live;
    uint32_t before = runs(&f);
    hair_test_field_update(&f, 0);
    assert_false(hair_field_is_near(&f.field));
    for (int i = 0; i < HAIR_TEST_FIELD_COLLIDERS; ++i) f.colliders[i].position[2] += 50;
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    assert_false(hair_field_is_near(&f.field));
    assert_int_equal(f.field.distance, 0);
    assert_int_equal(runs(&f), before);
    f.colliders[0].position[2] -= 50; // A collider comes near, and leaves.
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    assert_true(hair_field_is_near(&f.field));
    f.colliders[0].position[2] += 50;
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    assert_false(hair_field_is_near(&f.field));
    hair_test_field_update(&f, 0);
    assert_int_equal(f.field.distance, 0);
    assert_int_equal(f.test->host.live, bytes);
    hair_test_field_end(&f);
}

static void APIENTRY make_nothing(GLuint texture, GLsizei levels, GLenum format, GLsizei x, GLsizei y,
                                  GLsizei z)
{
    (void)texture, (void)levels, (void)format, (void)x, (void)y, (void)z;
}

static void field_recovers_from_refused_driver_memory(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    struct hair_gl* gl = &f.test->context->gl;
    size_t bytes = f.test->host.live;
    void(APIENTRY * kept)(GLuint, GLsizei, GLenum, GLsizei, GLsizei, GLsizei) = gl->TextureStorage3D;
    gl->TextureStorage3D = make_nothing;
    hair_result result = hair_field_update(&f.field, f.colliders, HAIR_TEST_FIELD_COLLIDERS, &f.head);
    gl->TextureStorage3D = kept;
    hair_test_refused(f.test, result, HAIR_ERROR_MEMORY, "the driver has no");
    assert_int_equal(f.test->host.live, bytes);
    hair_test_field_update(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_check(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_end(&f);
}

static void field_recovers_from_refused_host_memory(void** state)
{
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    size_t bytes = f.test->host.live;
    uint32_t refused = 0;
    for (;; ++refused) {
        f.test->host.refuse = f.test->host.allocations + 1 + refused;
        hair_result result = hair_field_update(&f.field, f.colliders, HAIR_TEST_FIELD_COLLIDERS, &f.head);
        f.test->host.refuse = 0;
        if (result == HAIR_OK) break;
        hair_test_refused(f.test, result, HAIR_ERROR_MEMORY, "out of memory for");
        assert_int_equal(f.test->host.live, bytes);
    }
    assert_true(refused > 5);
    hair_test_field_check(&f, HAIR_TEST_FIELD_COLLIDERS);
    hair_test_field_end(&f);
}

// A GPU tests at most 512 colliders of a brick in a dispatch.
static void field_of_a_gpu_has_the_same_distances_in_more_rounds(void** state)
{
    enum { MANY = 1200 };
    struct hair_test_field_scene f;
    hair_test_field_begin(*state, origin, &f);
    struct hair_gl* gl = &f.test->context->gl;
    int software = gl->software;
    hair_collider* many = test_calloc(MANY, sizeof *many);
    for (uint32_t i = 0; i < MANY; ++i) {
        many[i] = f.colliders[0];
        many[i].shape = HAIR_SHAPE_SPHERE;
        many[i].size[0] = 0.001f;
        for (int k = 0; k < 3; ++k) many[i].position[k] += 0.03f * (hair_random(&f.random) - 0.5f);
    }
    struct hair_test_field read[2];
    uint32_t run[2];
    for (int gpu = 0; gpu < 2; ++gpu) {
        struct hair_collider_field field;
        uint32_t before = runs(&f);
        hair_field_create(&field, &f.test->context->sdf_pool, f.groom, HAIR_TEST_FIELD_VOXEL);
        hair_field_want_numbers(&field);
        gl->software = gpu ? 0 : software;
        hair_test_ok(f.test, hair_field_update(&field, many, MANY, &f.head));
        gl->software = software;
        read[gpu] = hair_test_field_read(&field);
        run[gpu] = runs(&f) - before;
        hair_field_destroy(&field);
    }
    size_t voxels = hair_test_field_count(&read[0]);
    printf("    %zu voxels, %u and %u dispatches\n", voxels, run[0], run[1]);
    assert_memory_equal(read[0].distance, read[1].distance, voxels * sizeof *read[0].distance);
    assert_true(run[1] >= run[0] && run[1] >= 3);
    for (int gpu = 0; gpu < 2; ++gpu) hair_test_field_free(&read[gpu]);
    test_free(many);
    hair_test_field_end(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(updated_field_equals_a_new_field_bit_for_bit),
        HAIR_TEST(field_has_numbers_once_they_are_wanted),
        HAIR_TEST(field_update_without_motion_calls_no_opengl),
        HAIR_TEST(colliders_that_move_with_the_head_are_not_rewritten),
        HAIR_TEST(field_is_absent_without_a_collider_near),
        HAIR_TEST(field_recovers_from_refused_driver_memory),
        HAIR_TEST(field_recovers_from_refused_host_memory),
        HAIR_TEST(field_of_a_gpu_has_the_same_distances_in_more_rounds),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
