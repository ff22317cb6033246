// accumulator_test.c - motion does not depend on the frame rate.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "lib/base/math.h"
#include "tests/support/handmade.h"
#include "tests/support/ways.h"

#define MAX 1024

struct strands {
    float guides[3 * MAX], smooth[3 * 2 * MAX];
    uint32_t guide_vertices, smooth_vertices;
};

static hair_instance* make(struct hair_test* test, hair_groom* groom, int way)
{
    hair_instance* hair = NULL;
    hair_desc desc = hair_test_way(way);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    return hair;
}

static void read(struct hair_test* test, hair_instance* hair, struct strands* out)
{
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_GUIDES, out->guides, MAX, &out->guide_vertices));
    hair_test_ok(test,
                 hair_read_positions(hair, HAIR_READ_SMOOTH, out->smooth, 2 * MAX, &out->smooth_vertices));
    assert_in_range(out->guide_vertices, 1, MAX);
    assert_in_range(out->smooth_vertices, 1, 2 * MAX);
}

// Step a new instance from rest under gravity for `time`, and read its strands. The last portion is
// the remaining time. Portions and times are in substeps.
static void run(struct hair_test* test, hair_groom* groom, int way, float (*portion)(uint32_t i), double time,
                struct strands* out)
{
    hair_instance* hair = make(test, groom, way);
    double substep = hair->sim.substep, left = time;
    for (uint32_t i = 0; left > 1e-7; ++i) {
        float dt = (float)(fmin((double)portion(i), left) * substep);
        hair_test_ok(test, hair_step(hair, dt));
        left -= (double)dt / substep;
    }
    read(test, hair, out);
    hair_destroy(hair);
}

static float one(uint32_t i)
{
    return (void)i, 1;
}
static float two(uint32_t i)
{
    return (void)i, 2;
}
static float four(uint32_t i)
{
    return (void)i, 4;
}
static float an_eighth(uint32_t i)
{
    return (void)i, 0.12f;
}
static float twelve(uint32_t i)
{
    return (void)i, 12;
}
static float irregular(uint32_t i)
{
    uint32_t seed = i;
    return 0.01f + 6 * hair_random(&seed);
}

// Check that every portion of time makes exactly the same substeps. The time within the next
// substep is a sum of rounded portions. Drawn strands agree as the times do, to a millionth of a
// second at a few metres a second.
static void strands_are_the_same(struct hair_test* test, hair_groom* groom, int way)
{
    static float (*const portions[])(uint32_t) = {two, four, twelve, an_eighth, irregular};
    static struct strands expected, got;
    // The times lie between two ends of substeps, so that rounding of the sum cannot change their
    // number.
    static const double times[] = {60.5, 30.25, 7.75};
    for (size_t t = 0; t < sizeof times / sizeof *times; ++t) {
        run(test, groom, way, one, times[t], &expected);
        for (size_t i = 0; i < sizeof portions / sizeof *portions; ++i) {
            run(test, groom, way, portions[i], times[t], &got);
            assert_int_equal(got.guide_vertices, expected.guide_vertices);
            assert_memory_equal(got.guides, expected.guides, 12 * got.guide_vertices);
            for (uint32_t k = 0; k < 3 * got.smooth_vertices; ++k)
                hair_test_near("smooth", k, got.smooth[k], expected.smooth[k], 1e-5);
        }
    }
}

// Check that rounding does not change the number of substeps. Five floats of 1/120 s exceed one
// float of 1/24 s slightly, and still 1/24 s holds five substeps.
static void portions_are_substeps(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands fine, coarse;
    static const uint32_t each[] = {2, 3, 4, 5, 6, 8};
    for (int k = 0; k < 6; ++k) {
        hair_instance* at_once = make(test, groom, way);
        hair_instance* by_one = make(test, groom, way);
        double substep = at_once->sim.substep;
        for (uint32_t i = 0; i < 20; ++i) hair_test_ok(test, hair_step(at_once, (float)(each[k] * substep)));
        for (uint32_t i = 0; i < 20 * each[k]; ++i) hair_test_ok(test, hair_step(by_one, (float)substep));
        read(test, at_once, &coarse);
        read(test, by_one, &fine);
        // Follow rounds its state between dispatches.
        int exact = hair_test_way(way).solver != HAIR_SOLVER_FOLLOW;
        if (exact) assert_memory_equal(coarse.guides, fine.guides, 12 * fine.guide_vertices);
        for (uint32_t i = 0; i < 3 * fine.guide_vertices; ++i)
            hair_test_near("guides", i, coarse.guides[i], fine.guides[i], exact ? 0 : 1e-5);
        hair_destroy(at_once);
        hair_destroy(by_one);
    }
}

static void steps_give_the_same_bits(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands first, second;
    run(test, groom, way, irregular, 84, &first);
    run(test, groom, way, irregular, 84, &second);
    assert_memory_equal(first.guides, second.guides, 12 * first.guide_vertices);
    assert_memory_equal(first.smooth, second.smooth, 12 * first.smooth_vertices);
}

// Check that substeps are at the same times with a head that moves evenly. Only the interpolation
// between frames is rounded.
static void a_moving_head_is_followed(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands fine, coarse;
    hair_instance* hair[2] = {make(test, groom, way), make(test, groom, way)};
    for (int rate = 0; rate < 2; ++rate) {
        int each = rate ? 4 : 1; // Substeps per step.
        for (int i = 1; i <= 40 / each; ++i) {
            float time = (float)(i * each * hair[rate]->sim.substep); // At 1.2 m/s.
            float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.2f * time, 0, 0, 1};
            hair_test_ok(test, hair_set_transform(hair[rate], transform));
            hair_test_ok(test, hair_step(hair[rate], (float)(each * hair[rate]->sim.substep)));
        }
    }
    read(test, hair[0], &fine);
    read(test, hair[1], &coarse);
    hair_test_near("root", 0, fine.guides[0], (double)groom->rest[0].position.x + 48 * hair[0]->sim.substep,
                   1e-6);
    for (uint32_t k = 0; k < 3 * fine.guide_vertices; ++k)
        hair_test_near("guides", k, coarse.guides[k], fine.guides[k], hair_test_way_rounding(way));
    hair_destroy(hair[0]);
    hair_destroy(hair[1]);
}

static void nothing_changes(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands before, after;
    static const float nothing[] = {0, -0.0f, NAN, -1, -INFINITY};
    hair_instance* hair = make(test, groom, way);
    hair_test_ok(test, hair_step(hair, 0.0123f));
    read(test, hair, &before);
    for (int i = 0; i < 5; ++i) {
        hair_result result = hair_step(hair, nothing[i]);
        assert_int_equal(result, i < 2 ? HAIR_OK : HAIR_ERROR_ARGUMENT);
        read(test, hair, &after);
        assert_memory_equal(&before, &after, sizeof before);
    }
    assert_int_equal(hair_test_forgive(test), 3);
    hair_destroy(hair);
}

static void time_slows(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands slowed, whole;
    hair_instance* hair = make(test, groom, way);
    hair_instance* other = make(test, groom, way);
    uint32_t warnings = test->host.warnings;
    static const float long_ones[] = {0.2f, 1e30f, INFINITY};
    for (int i = 0; i < 3; ++i) {
        hair_test_ok(test, hair_step(hair, long_ones[i]));
        hair_test_ok(test, hair_step(other, 0.1f));
        assert_int_equal(test->host.warnings, warnings + 1);
    }
    read(test, hair, &slowed);
    read(test, other, &whole);
    assert_memory_equal(slowed.guides, whole.guides, 12 * whole.guide_vertices);
    hair_destroy(hair);
    hair_destroy(other);
}

// Check a step that has more substeps than one dispatch takes.
static void a_long_step_is_many_steps(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands one, many;
    hair_desc desc = hair_test_way(way);
    hair_instance* hair[2] = {NULL, NULL};
    desc.substep = 0.001f;
    desc.max_dt = 1;
    for (int i = 0; i < 2; ++i) hair_test_ok(test, hair_create(test->context, groom, &desc, &hair[i]));
    hair_test_ok(test, hair_step(hair[0], 0.2005f)); // 200 substeps, at most 64 per dispatch.
    for (int i = 0; i < 200; ++i) hair_test_ok(test, hair_step(hair[1], i ? 0.001f : 0.0015f));
    read(test, hair[0], &one);
    read(test, hair[1], &many);
    assert_memory_equal(one.guides, many.guides, 12 * one.guide_vertices);
    hair_destroy(hair[0]);
    hair_destroy(hair[1]);
}

// Check that the head moves evenly through a step of several dispatches.
static void a_long_step_moves_the_head_evenly(struct hair_test* test, hair_groom* groom, int way)
{
    static struct strands one, many;
    hair_desc desc = hair_test_way(way);
    hair_instance* hair[2] = {NULL, NULL};
    desc.substep = 0.001f;
    desc.max_dt = 1;
    for (int i = 0; i < 2; ++i) {
        uint32_t steps = i ? 200 : 1;
        hair_test_ok(test, hair_create(test->context, groom, &desc, &hair[i]));
        for (uint32_t k = 1; k <= steps; ++k) { // 200 substeps and a half.
            float time = i ? 0.001f * (float)k + 0.0005f : 0.2005f, place = 1.2f * time;
            float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, place, 0, 0, 1};
            hair_test_ok(test, hair_set_transform(hair[i], transform));
            hair_test_ok(test, hair_step(hair[i], !i ? 0.2005f : k > 1 ? 0.001f : 0.0015f));
        }
    }
    read(test, hair[0], &one);
    read(test, hair[1], &many);
    for (uint32_t k = 0; k < 3 * one.guide_vertices; ++k)
        hair_test_near("coordinate", k, one.guides[k], (double)many.guides[k], 1e-3);
    hair_destroy(hair[0]);
    hair_destroy(hair[1]);
}

static void in_every_way(void** state, void (*check)(struct hair_test* test, hair_groom* groom, int way))
{
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        print_message("    %s\n", hair_test_way_name(way));
        check(test, groom, way);
    }
    hair_groom_destroy(groom);
}

static void strands_move_equally_at_every_frame_rate(void** state)
{
    in_every_way(state, strands_are_the_same);
}
static void frames_of_whole_substeps_leave_no_remainder(void** state)
{
    in_every_way(state, portions_are_substeps);
}
static void equal_steps_give_equal_bits(void** state)
{
    in_every_way(state, steps_give_the_same_bits);
}
static void strands_follow_a_moving_head_at_every_frame_rate(void** state)
{
    in_every_way(state, a_moving_head_is_followed);
}
static void step_of_no_time_changes_nothing(void** state)
{
    in_every_way(state, nothing_changes);
}
static void step_longer_than_max_dt_is_cut_and_logged_once(void** state)
{
    in_every_way(state, time_slows);
}
static void step_of_many_substeps_equals_many_steps(void** state)
{
    in_every_way(state, a_long_step_is_many_steps);
}
static void long_step_moves_the_head_evenly(void** state)
{
    in_every_way(state, a_long_step_moves_the_head_evenly);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(strands_move_equally_at_every_frame_rate),
        HAIR_TEST(frames_of_whole_substeps_leave_no_remainder),
        HAIR_TEST(equal_steps_give_equal_bits),
        HAIR_TEST(strands_follow_a_moving_head_at_every_frame_rate),
        HAIR_TEST(step_of_no_time_changes_nothing),
        HAIR_TEST(step_longer_than_max_dt_is_cut_and_logged_once),
        HAIR_TEST(step_of_many_substeps_equals_many_steps),
        HAIR_TEST(long_step_moves_the_head_evenly),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
