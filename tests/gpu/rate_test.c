// rate_test.c - hair at a lower substep rate moves alike, as smoothly, for less work.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <hair/hair_egl.h>

enum { GUIDES = 7, FRAMES = 1440, PER_SECOND = 240, MAX = 1024 };

// Positions of the drawn tips in every frame, relative to the head.
struct run {
    hair_vec3 tip[FRAMES][GUIDES];
    uint32_t runs; // Number of the solver's runs.
};

static struct hair_test_scene start(void** state)
{
    struct hair_test_scene f = hair_test_scene_make(*state, hair_egl_get_proc);
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = GUIDES;
    wanted.turn = 0.1f;
    f.groom = hair_test_groom(&f.test->host.host, wanted);
    return f;
}

// Return the angle of the head. It turns to and fro for two seconds, by at most half a radian, with
// a soft start and end. Then it is still.
static float angle_at(uint32_t frame)
{
    float s = sinf(3.14159265f * (float)frame / (2 * PER_SECOND));
    return frame < 2 * PER_SECOND ? 0.5f * s * s * sinf(2 * 3.14159265f * (float)frame / PER_SECOND) : 0;
}

static uint32_t count_runs(hair_context* context)
{
    hair_timing timings[1024];
    uint32_t count = hair_get_timings(context, timings, 1024), runs = 0;
    for (uint32_t i = 0; i < count && i < 1024; ++i)
        if (!strncmp(timings[i].pass, "sim/mixed", 9)) runs += timings[i].runs;
    return runs;
}

static void read_tips(struct hair_test_scene* f, hair_instance* hair, hair_vec3 tip[GUIDES])
{
    float at[3 * MAX];
    uint32_t count = 0, each = hair->sim.smooth_vertices;
    hair_test_ok(f->test, hair_read_positions(hair, HAIR_READ_SMOOTH, at, MAX, &count));
    assert_int_equal(count, GUIDES * each);
    for (uint32_t i = 0; i < GUIDES; ++i) tip[i] = hair_load3(at + 3 * ((i + 1) * each - 1));
}

// Simulate all frames. `rate_at` returns a frame's substep rate. `is_seen` returns whether hair is
// visible in a frame, and a quarter of the rate is enough otherwise. NULL: always visible.
static void run(struct hair_test_scene* f, float (*rate_at)(uint32_t frame), int (*is_seen)(uint32_t frame),
                struct run* out)
{
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    physics.sleep_threshold = 0; // Sleep would skip runs too.
    physics.substep_rate = rate_at(0);
    physics.offscreen_substep_rate = is_seen ? 0.25f : 1;
    desc.physics = &physics;
    hair_test_ok(f->test, hair_create(f->context, f->groom, &desc, &hair));
    uint32_t before = count_runs(f->context);
    for (uint32_t i = 0; i < FRAMES; ++i) {
        float angle = angle_at(i);
        float head[16] = {cosf(angle), 0, -sinf(angle), 0, 0, 1, 0, 0,
                          sinf(angle), 0, cosf(angle),  0, 0, 0, 0, 1};
        physics.substep_rate = rate_at(i);
        hair_test_ok(f->test, hair_set_physics(hair, &physics));
        hair_test_ok(f->test, hair_set_transform(hair, head));
        hair_test_ok(f->test, hair_step(hair, 1.0f / PER_SECOND));
        double unseen = hair->sim.unseen; // The test's own read must not count as a view.
        read_tips(f, hair, out->tip[i]);
        if (is_seen && !is_seen(i)) hair->sim.unseen = unseen;
        for (int g = 0; g < GUIDES; ++g) {
            hair_vec3 t = out->tip[i][g];
            out->tip[i][g] =
                hair_v3(cosf(angle) * t.x - sinf(angle) * t.z, t.y, sinf(angle) * t.x + cosf(angle) * t.z);
        }
    }
    out->runs = count_runs(f->context) - before;
    hair_solver_stats solver_stats = hair_solver_stats_default();
    hair_test_ok(f->test, hair_get_solver_stats(hair, &solver_stats));
    assert_int_equal(solver_stats.euler_fallbacks, 0);
    assert_int_equal(solver_stats.parts, 0);
    assert_int_equal(solver_stats.follow_fallbacks, 0);
    assert_int_equal(solver_stats.reset, 0);
    hair_destroy(hair);
}

static float at_one(uint32_t frame)
{
    return (void)frame, 1;
}
static float at_half(uint32_t frame)
{
    return (void)frame, 0.5f;
}
static float at_quarter(uint32_t frame)
{
    return (void)frame, 0.25f;
}
// Return a rate that falls and rises, twice while the head turns.
static float at_any(uint32_t frame)
{
    static const float rates[] = {1, 0.5f, 0.25f, 0.5f};
    return rates[frame * 16 / FRAMES % 4];
}

// Return whether hair is visible. It is invisible for half a second after the first second, while
// the head turns. The library treats the first quarter of a second as visible.
static int is_now_and_then_seen(uint32_t frame)
{
    return frame < PER_SECOND || frame >= 3 * PER_SECOND / 2;
}

// Return the mean distance of tips from their mean positions. `mean` is the mean positions.
static double swing_of(const struct run* run, hair_vec3 mean[GUIDES])
{
    double sum = 0;
    for (int g = 0; g < GUIDES; ++g) {
        mean[g] = hair_v3(0, 0, 0);
        for (uint32_t i = 0; i < FRAMES; ++i)
            mean[g] = hair_add(mean[g], hair_scale(run->tip[i][g], 1.0f / FRAMES));
        for (uint32_t i = 0; i < FRAMES; ++i)
            sum += (double)hair_distance(run->tip[i][g], mean[g]) / (FRAMES * GUIDES);
    }
    return sum;
}

// Return the maximum change of a tip's step from one frame to the next.
static double jerk_of(const struct run* run)
{
    double max = 0;
    for (uint32_t i = 2; i < FRAMES; ++i)
        for (int g = 0; g < GUIDES; ++g) {
            hair_vec3 step = hair_sub(run->tip[i][g], run->tip[i - 1][g]);
            hair_vec3 before = hair_sub(run->tip[i - 1][g], run->tip[i - 2][g]);
            max = fmax(max, (double)hair_distance(step, before));
        }
    return max;
}

static double fastest_of(const struct run* run)
{
    double max = 0;
    for (uint32_t i = 1; i < FRAMES; ++i)
        for (int g = 0; g < GUIDES; ++g)
            max = fmax(max, (double)hair_distance(run->tip[i][g], run->tip[i - 1][g]));
    return max;
}

// Maximum differences of a run at a lower rate.
struct bounds {
    double swing; // Relative difference of the mean swing.
    double mean, last; // Differences of the mean and the last position of tips, in metres.
    // Maximum change between consecutive steps, as a fraction of the longest step of a frame.
    double step;
};

static void compare(const char* name, const struct run* full, const struct run* low, struct bounds bounds)
{
    hair_vec3 mean[2][GUIDES];
    double swing[2] = {swing_of(full, mean[0]), swing_of(low, mean[1])}, off = 0, last = 0;
    double step = jerk_of(low) / fastest_of(full);
    for (int g = 0; g < GUIDES; ++g) {
        off = fmax(off, (double)hair_distance(mean[0][g], mean[1][g]));
        last = fmax(last, (double)hair_distance(full->tip[FRAMES - 1][g], low->tip[FRAMES - 1][g]));
    }
    print_message(
        "    %s: %u runs for %u; swing %.2f mm for %.2f; tips on average %.2f mm off, at the end %.2f; "
        "steps change by %.2f of the longest, at rate 1 by %.2f\n",
        name, low->runs, full->runs, 1e3 * swing[1], 1e3 * swing[0], 1e3 * off, 1e3 * last, step,
        jerk_of(full) / fastest_of(full));
    assert_true(fabs(swing[1] / swing[0] - 1) <= bounds.swing);
    assert_true(off <= bounds.mean);
    assert_true(last <= bounds.last);
    assert_true(step <= bounds.step);
}

static void lower_substep_rate_moves_hair_alike_with_fewer_runs(void** state)
{
    static struct run full, low;
    struct hair_test_scene f = start(state);
    run(&f, at_one, NULL, &full);
    assert_int_equal(full.runs, FRAMES);
    run(&f, at_half, NULL, &low);
    compare("half", &full, &low, (struct bounds){0.04, 5e-4, 1e-4, 0.15});
    assert_int_equal(low.runs, FRAMES / 2);
    run(&f, at_quarter, NULL, &low);
    compare("quarter", &full, &low, (struct bounds){0.08, 1e-3, 2.5e-4, 0.22});
    assert_int_equal(low.runs, FRAMES / 4);
    hair_test_scene_free(&f);
}

// Check changes of the rate. Time runs at most twice as fast while substeps become shorter, and at
// half speed while they become longer.
static void hair_does_not_jump_when_the_substep_rate_changes(void** state)
{
    static struct run full, low;
    struct hair_test_scene f = start(state);
    run(&f, at_one, NULL, &full);
    run(&f, at_any, NULL, &low);
    compare("changing", &full, &low, (struct bounds){0.05, 5e-4, 3e-4, 1.05});
    run(&f, at_one, is_now_and_then_seen, &low);
    compare("unseen", &full, &low, (struct bounds){0.05, 5e-4, 3e-4, 1.05});
    assert_in_range(low.runs, FRAMES - PER_SECOND / 4 * 3 / 4 - 5, FRAMES - PER_SECOND / 4 * 3 / 4 + 5);
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(lower_substep_rate_moves_hair_alike_with_fewer_runs),
        HAIR_TEST(hair_does_not_jump_when_the_substep_rate_changes),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
