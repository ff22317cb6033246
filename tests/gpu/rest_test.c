// rest_test.c - the measure of hair at rest: moving hair has its speed, and sleeping hair is still.
#include "tests/support/live_hair.h"

#include <math.h>

// Tools are not linked into tests.
#include "tools/bench/rest.c"

static struct bench_rest hang(struct hair_test* test, const hair_physics* physics)
{
    struct hair_test_strands strands = hair_test_strands_make(2, 8);
    hair_test_add_straight(&strands, 8, hair_v3(0, 0, 0), hair_v3(0, -1, 0), 0.1f);
    hair_test_add_straight(&strands, 8, hair_v3(0.1f, 0, 0), hair_v3(0, -1, 0), 0.1f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, physics);
    struct hair_test_living living;
    struct bench_rest rest;
    struct bench_rest_desc wait = {.seconds = 4, .window = 0.5, .patience = 8};
    hair_test_live(test, &strands, &desc, &living);
    assert_true(bench_measure_rest(living.hair, 2, 8, &wait, &rest));
    hair_test_die(&living);
    hair_test_strands_free(&strands);
    return rest;
}

static void measured_speed_of_falling_hair_is_right(void** state)
{
    hair_physics physics = hair_test_loose(0);
    physics.root = HAIR_ROOT_FREE;
    physics.damping = 0;
    struct bench_rest rest = hang(*state, &physics);
    double fallen = 9.81 * 4; // In m/s.
    print_message("    %.2f m/s of %.2f\n", rest.max_speed, fallen);
    assert_true(fabs(rest.max_speed / fallen - 1) < 0.01);
    assert_true(rest.moving_fraction == 1 && rest.finite && !isfinite(rest.seconds_asleep));
}

static void hanging_hair_sleeps_and_is_still(void** state)
{
    hair_physics physics = hair_test_loose(0);
    struct bench_rest rest = hang(*state, &physics);
    print_message("    asleep after %.2f s\n", rest.seconds_asleep);
    assert_true(rest.max_speed == 0 && rest.moving_fraction == 0 && rest.finite);
    assert_true(rest.seconds_asleep < 2);
}

static void hair_that_may_not_sleep_has_a_measured_speed(void** state)
{
    hair_physics physics = hair_test_loose(0);
    physics.sleep_threshold = 0;
    struct bench_rest rest = hang(*state, &physics);
    assert_true(rest.max_speed < 1e-3 && !isfinite(rest.seconds_asleep));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(measured_speed_of_falling_hair_is_right),
        HAIR_TEST(hanging_hair_sleeps_and_is_still),
        HAIR_TEST(hair_that_may_not_sleep_has_a_measured_speed),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
