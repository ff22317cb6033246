// solid_test.c - solids as the application gives them become capsules between two poses of the head.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/collide/solid.h"

static struct hair_test_host test;
static struct hair_solids solids;
static struct hair_capsule capsules[HAIR_STEP_SOLIDS];

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
    hair_solids_free(&test.host, &solids);
    return test.blocks != 0;
}

static hair_solid sphere(float x)
{
    return (hair_solid){HAIR_SHAPE_SPHERE, {x, 0, 0}, {0, 0, 0, 1}, {0.5f, 0}, .scale = 1, .friction = 1};
}

static void set(const hair_solid* from, uint32_t count)
{
    assert_int_equal(hair_solids_set(&test.host, &solids, from, count, sizeof *from), HAIR_OK);
}

static void a_sphere_is_a_capsule_whose_ends_are_alike(void** state)
{
    (void)state;
    hair_solid one = sphere(3);
    one.size[1] = 99; // means nothing to a sphere
    set(&one, 1);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), 1);
    assert_memory_equal(&capsules[0].start[0], &capsules[0].start[1], sizeof(hair_vec4));
    assert_true(capsules[0].end[0].x == 3 && capsules[0].end[0].w == 0.5f);
}

static void a_capsule_lies_along_its_local_y(void** state)
{
    (void)state;
    float half = sqrtf(0.5f);
    hair_solid one = {HAIR_SHAPE_CAPSULE, {1, 2, 3},  {0, 0, half, half},
                      {0.25f, 2},         .scale = 1, .friction = 1}; // y to -x
    set(&one, 1);
    hair_solids_capsules(&solids, &origin, &origin, capsules);
    hair_test_near("one end", 0, capsules[0].end[0].x, 3, 1e-6);
    hair_test_near("other end", 0, capsules[0].end[1].x, -1, 1e-6);
    hair_test_near("y", 0, capsules[0].end[1].y, 2, 1e-6);
}

static void capsules_are_from_the_head(void** state)
{
    (void)state;
    struct hair_pose before = {{1e6, 0, 0}, {0, 0, 0, 1}}, now = {{1e6 - 0.25, 0, 0}, {0, 0, 0, 1}};
    hair_solid one = sphere(1e6f + 1);
    set(&one, 1);
    hair_solids_settle(&solids);
    hair_solids_capsules(&solids, &before, &now, capsules);
    assert_true(capsules[0].start[0].x == 1 && capsules[0].end[0].x == 1.25f);
}

static void a_solid_moves_from_where_it_was_at_the_last_step(void** state)
{
    (void)state;
    hair_solid two[2] = {sphere(1), sphere(5)};
    set(two, 1);
    hair_solids_settle(&solids);
    two[0].position[0] = 2;
    set(two, 2);
    hair_solids_capsules(&solids, &origin, &origin, capsules);
    assert_true(capsules[0].start[0].x == 1 && capsules[0].end[0].x == 2);
    assert_true(capsules[1].start[0].x == 5); // One more than before starts where it is.
    hair_solids_settle(&solids);
    hair_solids_capsules(&solids, &origin, &origin, capsules);
    assert_true(capsules[0].start[0].x == 2);
}

static void another_shape_is_another_solid(void** state)
{
    (void)state;
    hair_solid one = sphere(1);
    set(&one, 1);
    hair_solids_settle(&solids);
    one.shape = HAIR_SHAPE_CAPSULE;
    one.position[0] = 2;
    set(&one, 1);
    hair_solids_capsules(&solids, &origin, &origin, capsules);
    assert_true(capsules[0].start[0].x == 2);
}

static void a_larger_stride_skips_what_is_newer(void** state)
{
    (void)state;
    struct {
        hair_solid solid;
        float newer[3];
    } two[2] = {{sphere(1), {NAN, NAN, NAN}}, {sphere(2), {NAN, NAN, NAN}}};
    assert_int_equal(hair_solids_set(&test.host, &solids, &two[0].solid, 2, sizeof *two), HAIR_OK);
    assert_true(solids.now.solid[1].position[0] == 2);
}

static void none_is_a_count_too(void** state)
{
    (void)state;
    hair_solid many[HAIR_STEP_SOLIDS];
    for (int i = 0; i < HAIR_STEP_SOLIDS; ++i) many[i] = sphere((float)i);
    set(many, HAIR_STEP_SOLIDS);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), HAIR_STEP_SOLIDS);
    assert_int_equal(hair_solids_set(&test.host, &solids, NULL, 0, 0), HAIR_OK);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), 0);
}

static void a_wrong_solid_is_named_and_none_is_taken(void** state)
{
    (void)state;
    hair_solid two[2] = {sphere(1), sphere(2)};
    set(two, 1);
    two[0].position[0] = 9;
    two[1].size[0] = -1;
    assert_int_equal(hair_solids_set(&test.host, &solids, two, 2, sizeof *two), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "solids[1].size[0] is -1, not in (0, 1e6]");
    assert_int_equal(solids.now.count, 1);
    assert_true(solids.now.solid[0].position[0] == 1);
    two[1] = sphere(2);
    two[1].shape = (hair_shape)-1;
    assert_int_equal(hair_solids_set(&test.host, &solids, two, 2, sizeof *two), HAIR_ERROR_ARGUMENT);
    assert_int_equal(test.errors, 2);
}

// Which are given does not depend on the order they come in; those given keep it.
static void of_many_capsules_the_nearest_to_the_head_are_given(void** state)
{
    (void)state;
    enum { MANY = 1000 };
    static hair_solid many[MANY];
    for (uint32_t i = 0; i < MANY; ++i) many[i] = sphere(1 + (float)(i * 617 % MANY));
    many[5].shape = HAIR_SHAPE_BOX; // No capsule.
    many[5].size[1] = many[5].size[2] = 1;
    set(many, MANY);
    assert_int_equal(solids.capsules, HAIR_STEP_SOLIDS);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), HAIR_STEP_SOLIDS);
    uint32_t found = 0;
    float last = HAIR_STEP_SOLIDS + (many[5].position[0] <= HAIR_STEP_SOLIDS);
    for (uint32_t i = 0; i < MANY; ++i) {
        if (i == 5 || many[i].position[0] > last) continue;
        assert_true(capsules[found++].end[0].x == many[i].position[0]);
    }
    assert_int_equal(found, HAIR_STEP_SOLIDS);
}

static hair_solid keyed(float x, uint64_t key)
{
    hair_solid solid = sphere(x);
    solid.key = key;
    return solid;
}

static void a_solid_is_known_by_its_key_wherever_it_stands(void** state)
{
    (void)state;
    hair_solid before[] = {keyed(1, 7), keyed(2, 0), keyed(3, 9), keyed(4, 0), keyed(5, 8)};
    hair_solid now[] = {keyed(10, 0), keyed(13, 9), keyed(17, 6), keyed(11, 7), keyed(14, 0), keyed(19, 0)};
    float were[] = {2, 3, 17, 1, 4, 19};
    set(before, 5);
    hair_solids_settle(&solids);
    set(now, 6);
    for (uint32_t i = 0; i < 6; ++i) assert_true(hair_solids_before(&solids, i)->position[0] == were[i]);
    hair_solids_settle(&solids);
    for (uint32_t i = 0; i < 6; ++i)
        assert_true(hair_solids_before(&solids, i)->position[0] == now[i].position[0]);
    hair_solids_forget(&solids);
    set(before, 5);
    for (uint32_t i = 0; i < 5; ++i)
        assert_true(hair_solids_before(&solids, i)->position[0] == before[i].position[0]);
}

// Sizes that a shape does not use may be anything.
static void every_shape_wants_its_own_sizes(void** state)
{
    (void)state;
    static const int sizes[] = {1, 2, 3, 2, 2, 0};
    for (int shape = 0; shape < HAIR_SHAPE_FORM; ++shape) {
        hair_solid solid = hair_solid_default();
        solid.shape = (hair_shape)shape;
        for (int k = 0; k < 3; ++k) solid.size[k] = k < sizes[shape] ? 1 : NAN;
        set(&solid, 1);
        for (int k = 0; k < sizes[shape]; ++k) {
            int is_line = shape == HAIR_SHAPE_CAPSULE && k == 1;
            solid.size[k] = 0;
            assert_int_equal(hair_solids_set(&test.host, &solids, &solid, 1, sizeof solid),
                             is_line ? HAIR_OK : HAIR_ERROR_ARGUMENT);
            solid.rounding = 0.1f; // Then it has a size in any case.
            set(&solid, 1);
            solid.rounding = 0, solid.size[k] = 1;
        }
    }
}

static void numbers_of_a_solid_have_ranges(void** state)
{
    (void)state;
    hair_solid wrong[] = {sphere(1), sphere(1), sphere(1), sphere(1), sphere(1), sphere(1)};
    const char* words[] = {"solids[0].rounding is -0.1, not in [0, 1e+06]",
                           "solids[0].friction is 101, not in [0, 100]",
                           "solids[0].scale is 0, not in [1e-06, 1e+06]",
                           "solids[0].form is NULL",
                           "solids[0].form is not NULL, but its shape is not HAIR_SHAPE_FORM",
                           "solids[0].rotation has norm 0, not 1"};
    wrong[0].rounding = -0.1f;
    wrong[1].friction = 101;
    wrong[2].scale = 0;
    wrong[3].shape = HAIR_SHAPE_FORM;
    wrong[4].form = (const hair_form*)&wrong;
    memset(wrong[5].rotation, 0, sizeof wrong[5].rotation);
    for (int i = 0; i < 6; ++i) {
        assert_int_equal(hair_solids_set(&test.host, &solids, &wrong[i], 1, sizeof wrong[i]),
                         HAIR_ERROR_ARGUMENT);
        assert_string_equal(test.sentence, words[i]);
    }
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, start, stop)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_sphere_is_a_capsule_whose_ends_are_alike),
        TEST(a_capsule_lies_along_its_local_y),
        TEST(capsules_are_from_the_head),
        TEST(a_solid_moves_from_where_it_was_at_the_last_step),
        TEST(another_shape_is_another_solid),
        TEST(a_larger_stride_skips_what_is_newer),
        TEST(none_is_a_count_too),
        TEST(a_wrong_solid_is_named_and_none_is_taken),
        TEST(of_many_capsules_the_nearest_to_the_head_are_given),
        TEST(a_solid_is_known_by_its_key_wherever_it_stands),
        TEST(every_shape_wants_its_own_sizes),
        TEST(numbers_of_a_solid_have_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
