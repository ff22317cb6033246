// collider_test.c - colliders of the application become capsules between two poses of the head.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/collide/collider.h"

static struct hair_test_host test;
static struct hair_colliders colliders;
static struct hair_capsule capsules[HAIR_STEP_COLLIDERS];

static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    return 0;
}

static int stop(void** state)
{
    (void)state;
    hair_colliders_free(&test.host, &colliders);
    return test.blocks != 0;
}

static hair_collider sphere(float x)
{
    return (hair_collider){HAIR_SHAPE_SPHERE, {x, 0, 0}, {0, 0, 0, 1}, {0.5f, 0}, .scale = 1, .friction = 1};
}

static void set(const hair_collider* from, uint32_t count)
{
    assert_int_equal(hair_colliders_set(&test.host, &colliders, from, count, sizeof *from), HAIR_OK);
}

static void sphere_is_a_capsule_with_equal_ends(void** state)
{
    (void)state;
    hair_collider one = sphere(3);
    one.size[1] = 99; // A sphere does not use this size.
    set(&one, 1);
    assert_int_equal(hair_colliders_capsules(&colliders, &origin, &origin, capsules), 1);
    assert_memory_equal(&capsules[0].start[0], &capsules[0].start[1], sizeof(hair_vec4));
    assert_true(capsules[0].end[0].x == 3 && capsules[0].end[0].w == 0.5f);
}

static void a_capsule_lies_along_its_local_y(void** state)
{
    (void)state;
    float half = sqrtf(0.5f);
    hair_collider one = {HAIR_SHAPE_CAPSULE, {1, 2, 3},  {0, 0, half, half},
                         {0.25f, 2},         .scale = 1, .friction = 1}; // Rotates y to -x.
    set(&one, 1);
    hair_colliders_capsules(&colliders, &origin, &origin, capsules);
    hair_test_near("one end", 0, capsules[0].end[0].x, 3, 1e-6);
    hair_test_near("other end", 0, capsules[0].end[1].x, -1, 1e-6);
    hair_test_near("y", 0, capsules[0].end[1].y, 2, 1e-6);
}

static void capsules_are_relative_to_the_head(void** state)
{
    (void)state;
    struct hair_pose before = {{1e6, 0, 0}, {0, 0, 0, 1}}, now = {{1e6 - 0.25, 0, 0}, {0, 0, 0, 1}};
    hair_collider one = sphere(1e6f + 1);
    set(&one, 1);
    hair_colliders_end_step(&colliders);
    hair_colliders_capsules(&colliders, &before, &now, capsules);
    assert_true(capsules[0].start[0].x == 1 && capsules[0].end[0].x == 1.25f);
}

static void collider_moves_from_its_pose_at_the_last_step(void** state)
{
    (void)state;
    hair_collider two[2] = {sphere(1), sphere(5)};
    set(two, 1);
    hair_colliders_end_step(&colliders);
    two[0].position[0] = 2;
    set(two, 2);
    hair_colliders_capsules(&colliders, &origin, &origin, capsules);
    assert_true(capsules[0].start[0].x == 1 && capsules[0].end[0].x == 2);
    assert_true(capsules[1].start[0].x == 5); // A new collider starts at its position.
    hair_colliders_end_step(&colliders);
    hair_colliders_capsules(&colliders, &origin, &origin, capsules);
    assert_true(capsules[0].start[0].x == 2);
}

static void collider_of_another_shape_is_not_matched(void** state)
{
    (void)state;
    hair_collider one = sphere(1);
    set(&one, 1);
    hair_colliders_end_step(&colliders);
    one.shape = HAIR_SHAPE_CAPSULE;
    one.position[0] = 2;
    set(&one, 1);
    hair_colliders_capsules(&colliders, &origin, &origin, capsules);
    assert_true(capsules[0].start[0].x == 2);
}

static void larger_stride_skips_members_of_newer_callers(void** state)
{
    (void)state;
    struct {
        hair_collider collider;
        float newer[3];
    } two[2] = {{sphere(1), {NAN, NAN, NAN}}, {sphere(2), {NAN, NAN, NAN}}};
    assert_int_equal(hair_colliders_set(&test.host, &colliders, &two[0].collider, 2, sizeof *two), HAIR_OK);
    assert_true(colliders.current.collider[1].position[0] == 2);
}

static void zero_colliders_are_accepted(void** state)
{
    (void)state;
    hair_collider many[HAIR_STEP_COLLIDERS];
    for (int i = 0; i < HAIR_STEP_COLLIDERS; ++i) many[i] = sphere((float)i);
    set(many, HAIR_STEP_COLLIDERS);
    assert_int_equal(hair_colliders_capsules(&colliders, &origin, &origin, capsules), HAIR_STEP_COLLIDERS);
    assert_int_equal(hair_colliders_set(&test.host, &colliders, NULL, 0, 0), HAIR_OK);
    assert_int_equal(hair_colliders_capsules(&colliders, &origin, &origin, capsules), 0);
}

static void invalid_collider_is_named_and_none_is_set(void** state)
{
    (void)state;
    hair_collider two[2] = {sphere(1), sphere(2)};
    set(two, 1);
    two[0].position[0] = 9;
    two[1].size[0] = -1;
    assert_int_equal(hair_colliders_set(&test.host, &colliders, two, 2, sizeof *two), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "colliders[1].size[0] is -1, not in [0, 1000000]");
    assert_int_equal(colliders.current.count, 1);
    assert_true(colliders.current.collider[0].position[0] == 1);
    two[1] = sphere(2);
    two[1].shape = (hair_shape)-1;
    assert_int_equal(hair_colliders_set(&test.host, &colliders, two, 2, sizeof *two), HAIR_ERROR_ARGUMENT);
    assert_int_equal(test.errors, 2);
}

// Check that the selection does not depend on the order of colliders, and that the selected
// capsules keep their order.
static void nearest_capsules_to_the_head_are_kept(void** state)
{
    (void)state;
    enum { MANY = 1000 };
    static hair_collider many[MANY];
    for (uint32_t i = 0; i < MANY; ++i) many[i] = sphere(1 + (float)(i * 617 % MANY));
    many[5].shape = HAIR_SHAPE_BOX; // Not a capsule.
    many[5].size[1] = many[5].size[2] = 1;
    set(many, MANY);
    assert_int_equal(colliders.capsules, HAIR_STEP_COLLIDERS);
    assert_int_equal(hair_colliders_capsules(&colliders, &origin, &origin, capsules), HAIR_STEP_COLLIDERS);
    uint32_t found = 0;
    float last = HAIR_STEP_COLLIDERS + (many[5].position[0] <= HAIR_STEP_COLLIDERS);
    for (uint32_t i = 0; i < MANY; ++i) {
        if (i == 5 || many[i].position[0] > last) continue;
        assert_true(capsules[found++].end[0].x == many[i].position[0]);
    }
    assert_int_equal(found, HAIR_STEP_COLLIDERS);
}

static hair_collider keyed(float x, uint64_t key)
{
    hair_collider collider = sphere(x);
    collider.key = key;
    return collider;
}

static void collider_is_matched_by_key_at_any_index(void** state)
{
    (void)state;
    hair_collider before[] = {keyed(1, 7), keyed(2, 0), keyed(3, 9), keyed(4, 0), keyed(5, 8)};
    hair_collider now[] = {keyed(10, 0), keyed(13, 9), keyed(17, 6),
                           keyed(11, 7), keyed(14, 0), keyed(19, 0)};
    float were[] = {2, 3, 17, 1, 4, 19};
    set(before, 5);
    hair_colliders_end_step(&colliders);
    set(now, 6);
    for (uint32_t i = 0; i < 6; ++i)
        assert_true(hair_colliders_previous(&colliders, i)->position[0] == were[i]);
    hair_colliders_end_step(&colliders);
    for (uint32_t i = 0; i < 6; ++i)
        assert_true(hair_colliders_previous(&colliders, i)->position[0] == now[i].position[0]);
    hair_colliders_reset(&colliders);
    set(before, 5);
    for (uint32_t i = 0; i < 5; ++i)
        assert_true(hair_colliders_previous(&colliders, i)->position[0] == before[i].position[0]);
}

// Check that sizes which a shape does not use may have any value.
static void each_shape_checks_its_own_sizes(void** state)
{
    (void)state;
    static const int sizes[] = {1, 2, 3, 2, 2, 0, 0, 3};
    for (int shape = 0; shape <= HAIR_SHAPE_ELLIPSOID; ++shape) {
        if (shape == HAIR_SHAPE_MESH) continue;
        hair_collider collider = hair_collider_default();
        collider.shape = (hair_shape)shape;
        for (int k = 0; k < 3; ++k) collider.size[k] = k < sizes[shape] ? 1 : NAN;
        set(&collider, 1);
        for (int k = 0; k < sizes[shape]; ++k) {
            int is_line = shape == HAIR_SHAPE_CAPSULE && k == 1;
            collider.size[k] = 0;
            assert_int_equal(hair_colliders_set(&test.host, &colliders, &collider, 1, sizeof collider),
                             is_line ? HAIR_OK : HAIR_ERROR_ARGUMENT);
            collider.rounding = 0.1f; // With rounding, any shape has a size.
            set(&collider, 1);
            collider.rounding = 0, collider.size[k] = 1;
        }
    }
}

static void collider_numbers_outside_their_range_are_refused(void** state)
{
    (void)state;
    hair_collider wrong[] = {sphere(1), sphere(1), sphere(1), sphere(1), sphere(1), sphere(1)};
    const char* words[] = {"colliders[0].rounding is -0.100000001, not in [0, 1000000]",
                           "colliders[0].friction is 101, not in [0, 100]",
                           "colliders[0].scale is 0, not in [1e-06, 1000000]",
                           "colliders[0].mesh is NULL",
                           "colliders[0].mesh is not NULL, but its shape is not HAIR_SHAPE_MESH",
                           "colliders[0].rotation has norm 0, not 1"};
    wrong[0].rounding = -0.1f;
    wrong[1].friction = 101;
    wrong[2].scale = 0;
    wrong[3].shape = HAIR_SHAPE_MESH;
    wrong[4].mesh = (const hair_collision_mesh*)&wrong;
    memset(wrong[5].rotation, 0, sizeof wrong[5].rotation);
    for (int i = 0; i < 6; ++i) {
        assert_int_equal(hair_colliders_set(&test.host, &colliders, &wrong[i], 1, sizeof wrong[i]),
                         HAIR_ERROR_ARGUMENT);
        assert_string_equal(test.sentence, words[i]);
    }
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, start, stop)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(sphere_is_a_capsule_with_equal_ends),
        TEST(a_capsule_lies_along_its_local_y),
        TEST(capsules_are_relative_to_the_head),
        TEST(collider_moves_from_its_pose_at_the_last_step),
        TEST(collider_of_another_shape_is_not_matched),
        TEST(larger_stride_skips_members_of_newer_callers),
        TEST(zero_colliders_are_accepted),
        TEST(invalid_collider_is_named_and_none_is_set),
        TEST(nearest_capsules_to_the_head_are_kept),
        TEST(collider_is_matched_by_key_at_any_index),
        TEST(each_shape_checks_its_own_sizes),
        TEST(collider_numbers_outside_their_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
