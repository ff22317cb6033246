// solid_test.c - solids as the application gives them become capsules between two poses of the head.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/collide/solid.h"

static struct hair_test_host test;
static struct hair_solids    solids;
static struct hair_capsule   capsules[HAIR_MAX_SOLIDS];

static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    memset(&solids, 0, sizeof solids);
    return 0;
}

static hair_solid sphere(float x)
{
    return (hair_solid){HAIR_SHAPE_SPHERE, {x, 0, 0}, {0, 0, 0, 1}, {0.5f, 0}};
}

static void set(const hair_solid* from, uint32_t count)
{
    assert_int_equal(hair_solids_set(&test.host, &solids, from, count, sizeof *from), HAIR_OK);
}

static void a_sphere_is_a_capsule_whose_ends_are_alike(void** state)
{
    (void)state;
    hair_solid one = sphere(3);
    one.size[1]    = 99; // means nothing to a sphere
    set(&one, 1);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), 1);
    assert_memory_equal(&capsules[0].start[0], &capsules[0].start[1], sizeof(hair_vec4));
    assert_true(capsules[0].end[0].x == 3 && capsules[0].end[0].w == 0.5f);
}

static void a_capsule_lies_along_its_local_y(void** state)
{
    (void)state;
    float      half = sqrtf(0.5f);
    hair_solid one  = {HAIR_SHAPE_CAPSULE, {1, 2, 3}, {0, 0, half, half}, {0.25f, 2}}; // y to -x
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
    hair_solid       one = sphere(1e6f + 1);
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
    one.shape       = HAIR_SHAPE_CAPSULE;
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
        float      newer[3];
    } two[2] = {{sphere(1), {NAN, NAN, NAN}}, {sphere(2), {NAN, NAN, NAN}}};
    assert_int_equal(hair_solids_set(&test.host, &solids, &two[0].solid, 2, sizeof *two), HAIR_OK);
    assert_true(solids.now[1].position[0] == 2);
}

static void none_is_a_count_too(void** state)
{
    (void)state;
    hair_solid many[HAIR_MAX_SOLIDS];
    for (int i = 0; i < HAIR_MAX_SOLIDS; ++i) many[i] = sphere((float)i);
    set(many, HAIR_MAX_SOLIDS);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), HAIR_MAX_SOLIDS);
    assert_int_equal(hair_solids_set(&test.host, &solids, NULL, 0, 0), HAIR_OK);
    assert_int_equal(hair_solids_capsules(&solids, &origin, &origin, capsules), 0);
}

static void a_wrong_solid_is_named_and_none_is_taken(void** state)
{
    (void)state;
    hair_solid two[2] = {sphere(1), sphere(2)};
    set(two, 1);
    two[0].position[0] = 9;
    two[1].size[0]     = -1;
    assert_int_equal(hair_solids_set(&test.host, &solids, two, 2, sizeof *two), HAIR_ERROR_ARGUMENT);
    assert_string_equal(test.sentence, "solids[1].size[0] is -1, not in (0, 1e6]");
    assert_int_equal(solids.count, 1);
    assert_true(solids.now[0].position[0] == 1);
    two[1]       = sphere(2);
    two[1].shape = (hair_shape)-1;
    assert_int_equal(hair_solids_set(&test.host, &solids, two, 2, sizeof *two), HAIR_ERROR_ARGUMENT);
    assert_int_equal(test.errors, 2);
}

#define TEST(function) cmocka_unit_test_setup(function, start)

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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
