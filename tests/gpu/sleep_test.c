// sleep_test.c - hair that has come to rest is not simulated. When something disturbs it, it moves
// as if it had been simulated.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "lib/api/api.h"
#include "tests/support/grooms.h"
#include "tests/support/handmade.h"
#include "tests/support/motion.h"
#include "tests/support/trace.h"

enum { FPS = 60, GUIDES = 7, MAX = 512, PATIENCE = 15 * FPS };

static hair_instance* make(struct hair_test* test, hair_context* context, hair_solver solver, float sleep)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    wanted.guides = GUIDES;
    wanted.turn = 0.1f;
    physics.sleep_threshold = sleep;
    desc.physics = &physics;
    desc.solver = solver;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_test_ok(test, hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

static void turn_head(struct hair_test* test, hair_instance* hair, float angle, float x)
{
    const float head[16] = {cosf(angle), 0, -sinf(angle), 0, 0, 1, 0, 0,
                            sinf(angle), 0, cosf(angle),  0, x, 0, 0, 1};
    hair_test_ok(test, hair_set_transform(hair, head));
}

static void step(struct hair_test* test, hair_instance* hair)
{
    hair_test_ok(test, hair_step(hair, 1.0f / FPS));
}

// Step like an application that shows its frames, so that the GPU is fewer than `max` frames
// behind. A GPU that falls behind without limit would report rest much too late.
static void show(struct hair_test* test, hair_instance* hair, uint32_t frame, uint32_t max)
{
    step(test, hair);
    if (frame % max == 0) glFinish();
}

// Shake the hair for half a second, and then leave it alone. Return the number of frames until it
// sleeps, or PATIENCE if it does not.
static uint32_t let_sleep(struct hair_test* test, hair_instance* hair, uint32_t max)
{
    uint32_t frame = 0;
    for (; frame < FPS / 2; ++frame) {
        turn_head(test, hair, 0.4f * sinf(6.2831853f * (float)(frame + 1) / (FPS / 2)), 0);
        show(test, hair, frame, max);
    }
    for (; frame < PATIENCE && !hair->sim.sleep.asleep; ++frame) show(test, hair, frame, max);
    return frame;
}

static float farthest(struct hair_test* test, hair_instance* a, hair_instance* b)
{
    float at[2][3 * MAX], far = 0;
    uint32_t count[2];
    hair_test_ok(test, hair_read_positions(a, HAIR_READ_SMOOTH, at[0], MAX, &count[0]));
    hair_test_ok(test, hair_read_positions(b, HAIR_READ_SMOOTH, at[1], MAX, &count[1]));
    assert_int_equal(count[0], count[1]);
    assert_in_range(count[0], 2, MAX);
    for (uint32_t i = 0; i < count[0]; ++i)
        far = fmaxf(far, hair_distance(hair_load3(at[0] + 3 * i), hair_load3(at[1] + 3 * i)));
    return far;
}

static hair_collider ball_at(float x)
{
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.05f, ball.position[0] = x, ball.position[1] = -0.01f;
    return ball;
}

// Return the distance of the nearest vertex from the ball.
static float nearest(struct hair_test* test, hair_instance* hair, const hair_collider* ball)
{
    float at[3 * MAX], near = 1;
    uint32_t count;
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_GUIDES, at, MAX, &count));
    for (uint32_t i = 0; i < count; ++i)
        near = fminf(near, hair_distance(hair_load3(at + 3 * i), hair_load3(ball->position)) - ball->size[0]);
    return near;
}

static double now_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

// Check the cost of a step of sleeping hair. The head and colliders are set in every frame, as
// applications do.
static void sleeping_head_steps_without_opengl_in_2_us(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_test_trace_proc);
    hair_instance* hair = make(test, context, HAIR_SOLVER_DIRECT, 1e-4f);
    hair_collider collider = hair_collider_default();
    double us[999];
    collider.size[0] = 0.08f;
    hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
    uint32_t frames = let_sleep(test, hair, 1);
    print_message("    asleep after %u frames\n", frames);
    assert_true(frames < PATIENCE);
    hair_test_trace_clear();
    for (size_t i = 0; i < sizeof us / sizeof *us; ++i) {
        turn_head(test, hair, 0, 0);
        hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
        double start = now_us();
        step(test, hair);
        us[i] = now_us() - start;
    }
    if (hair_test_trace_count("")) fail_msg("calls of %s", hair_test_trace_list());
    qsort(us, sizeof us / sizeof *us, sizeof *us, compare);
    print_message("    %.2f us a step, clock and check of its result included\n",
                  us[sizeof us / sizeof *us / 2]);
    assert_true(us[sizeof us / sizeof *us / 2] <= 2);
    hair_destroy(hair);
    hair_context_destroy(context);
}

// Shake two instances, leave them alone for seconds, and shake them again. One of them sleeps
// meanwhile, and the other never sleeps. `colliders` adds a ball that hair lies against, and that
// moves too.
static void check_waking(struct hair_test* test, hair_context* context, hair_solver solver, float bound,
                         int colliders)
{
    enum { CALM = 7 * FPS, END = CALM + FPS / 4 };
    hair_instance* hair[2] = {make(test, context, solver, bound), make(test, context, solver, 0)};
    float asleep = 0, awake = 0;
    uint32_t slept = 0;
    for (uint32_t frame = 0; frame < END; ++frame) {
        float time = (float)frame / FPS, later = fmaxf(time - (float)CALM / FPS, 0);
        float angle = frame < FPS / 2 ? 0.4f * sinf(12.566371f * time) : 0.5f * sinf(24 * later);
        hair_collider ball = ball_at(0.2f + 0.2f * later);
        for (int i = 0; i < 2; ++i) {
            if (colliders) hair_test_ok(test, hair_set_colliders(hair[i], &ball, 1, sizeof ball));
            turn_head(test, hair[i], angle, 0.2f * later);
            show(test, hair[i], frame, 1);
        }
        slept += (uint32_t)hair[0]->sim.sleep.asleep;
        if (frame + 1 == CALM && colliders) assert_true(nearest(test, hair[0], &ball) < 2e-3f);
        if (hair[0]->sim.sleep.asleep) asleep = fmaxf(asleep, farthest(test, hair[0], hair[1]));
        if (frame >= CALM) awake = fmaxf(awake, farthest(test, hair[0], hair[1]));
    }
    print_message("    solver %d, %d colliders: slept %u frames of %u; off by %.1e m then, by %.1e m awake\n",
                  (int)solver, colliders, slept, (unsigned)CALM, (double)asleep, (double)awake);
    assert_true(slept > FPS);
    assert_false(hair[0]->sim.sleep.asleep);
    assert_true(asleep <= bound);
    assert_true(awake <= 2 * bound); // The shake enlarges the difference.
    assert_true(hair[0]->sim.accumulator == hair[1]->sim.accumulator);
    for (int i = 0; i < 2; ++i) hair_destroy(hair[i]);
}

static void woken_hair_is_near_hair_that_never_slept(void** state)
{
    hair_context* context = hair_test_context(*state, hair_test_trace_proc);
    check_waking(*state, context, HAIR_SOLVER_DIRECT, 1e-4f, 0);
    check_waking(*state, context, HAIR_SOLVER_DIRECT, 1e-4f, 1);
    check_waking(*state, context, HAIR_SOLVER_DIRECT, 2e-3f, 0);
    check_waking(*state, context, HAIR_SOLVER_ACCURATE, 1e-4f, 0);
    hair_context_destroy(context);
}

// Sleeping hair. Every check destroys its state.
struct dozing {
    struct hair_test* test;
    hair_instance* hair;
    struct hair_test_blob blob;
};

// Check whether the next step wakes the hair. Afterwards put it to sleep again.
static void check_activity(struct dozing* d, const char* what, int stirs)
{
    hair_test_trace_clear();
    step(d->test, d->hair);
    if (stirs == d->hair->sim.sleep.asleep || stirs != (hair_test_trace_count("") > 0))
        fail_msg("%s: the hair %s", what, stirs ? "sleeps on" : "wakes");
    if (!stirs) return;
    hair_test_ok(d->test, hair_load(d->hair, d->blob.bytes, d->blob.size));
    hair_test_ok(d->test, hair_set_colliders(d->hair, NULL, 0, sizeof(hair_collider)));
    step(d->test, d->hair);
    assert_true(d->hair->sim.sleep.asleep);
}

static void put_ball(struct dozing* d, float x)
{
    hair_collider ball = ball_at(x);
    hair_test_ok(d->test, hair_set_colliders(d->hair, &ball, 1, sizeof ball));
}

static void check_colliders(struct dozing* d)
{
    put_ball(d, 5);
    check_activity(d, "a ball has come into being far off", 0);
    put_ball(d, 4.9f);
    check_activity(d, "a ball moves far off", 0);
    put_ball(d, -5);
    check_activity(d, "a ball flies right through", 1);
    put_ball(d, 0.4f);
    check_activity(d, "a ball has come into being near by", 1);
    hair_collider plane = hair_collider_default();
    plane.shape = HAIR_SHAPE_PLANE, plane.position[1] = -50;
    hair_test_ok(d->test, hair_set_colliders(d->hair, &plane, 1, sizeof plane));
    check_activity(d, "there is a plane, which is everywhere", 1);
}

static void check_settings(struct dozing* d)
{
    hair_physics physics = d->hair->sim.physics;
    hair_pin pin = hair_pin_default();
    hair_wind wind = hair_wind_default();
    hair_test_ok(d->test, hair_set_physics(d->hair, &physics));
    check_activity(d, "the same physics", 0);
    physics.damping += 0.01f;
    hair_test_ok(d->test, hair_set_physics(d->hair, &physics));
    check_activity(d, "other physics", 1);
    hair_test_ok(d->test, hair_set_group_physics(d->hair, 1, &physics));
    check_activity(d, "the same physics for a group", 0);
    physics.shape.stiffness_tip += 0.01f;
    hair_test_ok(d->test, hair_set_group_physics(d->hair, 1, &physics));
    check_activity(d, "other physics for a group", 1);
    hair_test_ok(d->test, hair_set_wind(d->hair, NULL));
    check_activity(d, "no wind once more", 0);
    wind.velocity[2] = 0.01f;
    hair_test_ok(d->test, hair_set_wind(d->hair, &wind));
    check_activity(d, "wind", 1);
    hair_test_ok(d->test, hair_set_pins(d->hair, NULL, 0, sizeof pin));
    check_activity(d, "no pins once more", 0);
    hair_test_ok(d->test, hair_set_pins(d->hair, &pin, 1, sizeof pin));
    check_activity(d, "a pin", 1);
    hair_test_ok(d->test, hair_reset(d->hair));
    check_activity(d, "a reset", 1);
    float head[16];
    hair_test_pose(1, head);
    hair_test_ok(d->test, hair_teleport(d->hair, head));
    check_activity(d, "a teleport", 1);
}

static void only_inputs_that_move_hair_wake_it(void** state)
{
    struct dozing d = {.test = *state};
    hair_context* context = hair_test_context(d.test, hair_test_trace_proc);
    d.hair = make(d.test, context, HAIR_SOLVER_DIRECT, 1e-4f);
    assert_true(let_sleep(d.test, d.hair, 1) < PATIENCE);
    d.blob = hair_test_save(d.test, d.hair);
    turn_head(d.test, d.hair, 0, 0);
    check_activity(&d, "the head is set where it is", 0);
    turn_head(d.test, d.hair, 0, 0.2e-4f);
    check_activity(&d, "the head moves by a fifth of the bound", 0);
    turn_head(d.test, d.hair, 0, 0.3e-4f);
    check_activity(&d, "the head moves by a third of the bound", 1);
    turn_head(d.test, d.hair, 1e-3f, 0);
    check_activity(&d, "the head turns", 1);
    check_colliders(&d);
    check_settings(&d);
    hair_destroy(d.hair);
    hair_context_destroy(context);
    free(d.blob.bytes);
}

static void sleep_begins_at_the_same_step_on_any_gpu_timing(void** state)
{
    static struct hair_test_seen seen[2];
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_test_trace_proc);
    uint32_t frames[2];
    for (uint32_t i = 0; i < 2; ++i) { // The GPU is at most one frame behind, or three.
        hair_instance* hair = make(test, context, HAIR_SOLVER_DIRECT, 1e-4f);
        frames[i] = let_sleep(test, hair, 1 + 2 * i);
        hair_test_look(test, hair, &seen[i]);
        hair_destroy(hair);
    }
    assert_true(frames[0] < PATIENCE);
    assert_int_equal(frames[0], frames[1]);
    hair_test_same(&seen[0], &seen[1]);
    hair_context_destroy(context);
}

// Check a GPU that is behind. A late answer prolongs a round of measurements. The next round must
// not be compared with the prolonged one, because decaying motion is fastest at its beginning.
static void slow_gpu_delays_sleep_without_a_wait(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_test_trace_proc);
    hair_instance* hair[2];
    uint32_t asleep[2] = {0, 0}, frame = 0;
    for (int i = 0; i < 2; ++i) {
        hair[i] = make(test, context, HAIR_SOLVER_DIRECT, 2e-3f);
        turn_head(test, hair[i], 0.3f, 0);
    }
    hair_test_trace_clear();
    for (; frame < 4 * FPS; ++frame) {
        uint32_t looks = hair[1]->sim.sleep.samples;
        for (int i = 0; i < 2; ++i) {
            hair_test_trace_hold(i && frame > FPS / 2 && frame < 3 * FPS / 2);
            show(test, hair[i], frame, 1);
            if (!asleep[i] && hair[i]->sim.sleep.asleep) asleep[i] = frame;
        }
        if (frame > FPS && frame < 3 * FPS / 2) assert_int_equal(hair[1]->sim.sleep.samples, looks);
    }
    if (hair_test_trace_waits()) fail_msg("%u waits: %s", hair_test_trace_waits(), hair_test_trace_list());
    float apart = farthest(test, hair[0], hair[1]);
    print_message("    asleep after %u and %u frames, %.1e m apart\n", asleep[0], asleep[1], (double)apart);
    assert_true(asleep[0] > 0 && asleep[1] > asleep[0]);
    assert_true(apart <= 2e-3f);
    for (int i = 0; i < 2; ++i) hair_destroy(hair[i]);
    hair_context_destroy(context);
}

static void loaded_hair_falls_asleep_at_the_same_step(void** state)
{
    static struct hair_test_seen straight, loaded;
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_test_trace_proc);
    hair_instance* hair = make(test, context, HAIR_SOLVER_DIRECT, 1e-3f);
    hair_instance* other = make(test, context, HAIR_SOLVER_DIRECT, 1e-3f);
    uint32_t slept = 0;
    for (uint32_t frame = 0; frame < 6 * FPS && slept < 3; ++frame) {
        turn_head(test, hair, frame < FPS / 2 ? 0.4f * sinf(0.2f * (float)frame) : 0, 0);
        show(test, hair, frame, 1);
        slept += (uint32_t)hair->sim.sleep.asleep;
        if (frame < FPS || (frame % 9 && !slept)) continue;
        struct hair_test_blob blob = hair_test_save(test, hair);
        hair_test_ok(test, hair_load(other, blob.bytes, blob.size));
        free(blob.bytes);
        for (int k = 0; k < 4; ++k, ++frame) {
            show(test, hair, frame, 1);
            show(test, other, frame, 1);
            assert_int_equal(hair->sim.sleep.asleep, other->sim.sleep.asleep);
        }
        hair_test_look(test, hair, &straight);
        hair_test_look(test, other, &loaded);
        assert_int_equal(straight.count, loaded.count);
        // The drawn position of sleeping hair does not change with time.
        if (hair->sim.sleep.asleep)
            for (size_t i = 0; i < straight.count; ++i)
                hair_test_near("shown", i, (double)straight.number[i], (double)loaded.number[i], 1e-9);
        else
            hair_test_same(&straight, &loaded);
    }
    assert_true(slept >= 3);
    hair_destroy(hair);
    hair_destroy(other);
    hair_context_destroy(context);
}

// Check undamped hair, which swings by more than the bound for ever.
static void hair_that_swings_or_may_not_sleep_stays_awake(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_test_trace_proc);
    hair_instance* swings = make(test, context, HAIR_SOLVER_ACCURATE, 1e-4f);
    hair_instance* may_not = make(test, context, HAIR_SOLVER_DIRECT, 0);
    hair_physics physics = hair_physics_default();
    physics.damping = 0;
    hair_test_ok(test, hair_set_physics(swings, &physics));
    assert_int_equal(let_sleep(test, swings, 1), PATIENCE);
    assert_int_equal(let_sleep(test, may_not, 1), PATIENCE);
    assert_int_equal(may_not->sim.sleep.anchor, 0);
    hair_destroy(swings);
    hair_destroy(may_not);
    hair_context_destroy(context);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(sleeping_head_steps_without_opengl_in_2_us),
        HAIR_TEST(woken_hair_is_near_hair_that_never_slept),
        HAIR_TEST(only_inputs_that_move_hair_wake_it),
        HAIR_TEST(sleep_begins_at_the_same_step_on_any_gpu_timing),
        HAIR_TEST(slow_gpu_delays_sleep_without_a_wait),
        HAIR_TEST(loaded_hair_falls_asleep_at_the_same_step),
        HAIR_TEST(hair_that_swings_or_may_not_sleep_stays_awake),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
