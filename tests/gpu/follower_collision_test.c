// follower_collision_test.c - followers that hit colliders are pushed out as in the
// double-precision reference. Without colliders in reach, nothing runs.
#include "tests/support/collided.h"
#include "tests/support/passes.h"

#include <math.h>
#include <stdlib.h>

// SAMPLE is derived in expand_test.c. The factor 2 in TOLERANCE is for the error of repairs.
#define SAMPLE (6 * 4.5 / 16777216)
#define TOLERANCE (2 * (3 * SAMPLE + 0.015 * 8 * SAMPLE / 0.005))

static void compare(struct hair_test_collided* f, uint32_t number, uint32_t k, double t,
                    const struct hair_reference_repair* repair, const float* vertices)
{
    struct hair_reference_point expected;
    size_t at = (size_t)number * (f->look.strand.segments + 1) + k;
    hair_test_collided_point(f, number, t, repair, &expected);
    for (int i = 0; i < 3; ++i)
        hair_test_near("coordinate", at, (double)vertices[3 * at + (size_t)i], expected.position[i],
                       TOLERANCE);
}

static void follower_beyond_its_hit_follows_a_single_guide(void** state)
{
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    float* vertices = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE);
    static float hits[400];
    uint32_t switched = 0;
    hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
    for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
        int hit = (double)hits[n] < HAIR_NO_HIT;
        // The other followers have nothing to switch.
        assert_true(!hit || f.scene.groom->followers[n].multi > 0);
        switched += hit;
        for (uint32_t k = 0; k <= f.look.strand.segments; ++k) {
            struct hair_reference_repair repair;
            double t = (double)k / f.look.strand.segments;
            hair_reference_switch(t, (double)hits[n] / f.look.strand.segments, &repair);
            compare(&f, n, k, t, hit ? &repair : NULL, vertices);
        }
    }
    assert_in_range(switched, 30, 370);
    free(vertices);
    hair_test_collided_finish(&f);
}

static double from_half(uint16_t half)
{
    double mantissa = half & 1023, sign = half >> 15 ? -1 : 1;
    int exponent = half >> 10 & 31;
    return sign * (exponent ? ldexp(1024 + mantissa, exponent - 25) : ldexp(mantissa, -24));
}

static void push_out_curve_is_a_spline(void** state)
{
    static const uint32_t segments[] = {7, 32, 100};
    static float hits[400];
    static uint16_t halves[400][HAIR_REPAIR_CONTROLS][4];
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    for (size_t i = 0; i < sizeof segments / sizeof *segments; ++i) {
        f.look.strand.segments = segments[i];
        float* vertices = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.repair, sizeof *halves,
                                       halves);
        for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
            int hit = (double)hits[n] < HAIR_NO_HIT;
            double controls[HAIR_REPAIR_CONTROLS][4];
            for (int c = 0; c < HAIR_REPAIR_CONTROLS; ++c)
                for (int axis = 0; axis < 4; ++axis) controls[c][axis] = from_half(halves[n][c][axis]);
            for (uint32_t k = 0; k <= f.look.strand.segments; ++k) {
                struct hair_reference_repair repair;
                double t = (double)k / f.look.strand.segments;
                if (hit) t *= 1 + controls[0][0];
                hair_reference_spline(controls, t, &repair);
                compare(&f, n, k, t, hit ? &repair : NULL, vertices);
            }
        }
        free(vertices);
    }
    hair_test_collided_finish(&f);
}

struct strand {
    double deepest, length;
};

static struct strand measure(const struct hair_test_collided* f, const float* vertices, uint32_t number)
{
    struct strand strand = {0};
    const float* p = vertices + (size_t)number * (f->look.strand.segments + 1) * 3;
    for (uint32_t k = 1; k <= f->look.strand.segments; ++k) {
        double at[3] = {(double)p[3 * k], (double)p[3 * k + 1], (double)p[3 * k + 2]}, square = 0;
        for (uint32_t i = 0; i < 3; ++i) square += pow(at[i] - (double)p[3 * (k - 1) + i], 2);
        strand.length += sqrt(square);
        strand.deepest = fmax(strand.deepest, -hair_test_collided_distance(f, at));
    }
    return strand;
}

// Check followers that are pushed out of colliders. Strands whose roots are inside, or nearly
// inside, have no direct way out, and are left out.
static void pushed_out_followers_are_outside_and_keep_their_length(void** state)
{
    struct hair_test_collided f = hair_test_collided_start(*state, 1);
    float* before = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_NONE);
    float* after = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    uint32_t inside = 0, left = 0;
    double deepest = 0, longest = 0;
    for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
        const float* p = before + (size_t)n * (f.look.strand.segments + 1) * 3;
        double root[3] = {(double)p[0], (double)p[1], (double)p[2]};
        struct strand a = measure(&f, before, n), b = measure(&f, after, n);
        if (hair_test_collided_distance(&f, root) < 0.01) continue;
        if (a.deepest == 0)
            assert_memory_equal(p, after + (p - before), 3 * (f.look.strand.segments + 1) * sizeof *p);
        inside += a.deepest > 1e-3;
        left += b.deepest > 1e-4;
        deepest = fmax(deepest, a.deepest);
        longest = fmax(longest, fabs(b.length / a.length - 1));
    }
    print_message("    %u inside, up to %.3f m; %u are left; lengths off by up to %.4f\n", inside, deepest,
                  left, longest);
    assert_true(inside > 10);
    assert_int_equal(left, 0);
    assert_true(longest < 0.01);
    free(before);
    free(after);
    hair_test_collided_finish(&f);
}

// Check that a work group and a thread push a follower out by the same curve. Drivers with and
// without a GPU use one of them each.
static void threads_of_a_group_push_as_one_thread_does(void** state)
{
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    struct hair_gl* gl = &f.scene.test->context->gl;
    float* own = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    float* none = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_NONE);
    gl->software = !gl->software;
    float* other = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    gl->software = !gl->software;
    size_t values = 3 * f.scene.groom->info.follower_count * (f.look.strand.segments + 1);
    double worst = 0, farthest = 0;
    for (size_t i = 0; i < values; ++i) {
        worst = fmax(worst, fabs((double)(own[i] - other[i])));
        farthest = fmax(farthest, fabs((double)(own[i] - none[i])));
    }
    print_message("    moved by up to %.4f m, alike to %.2g m\n", farthest, worst);
    assert_true(farthest > 0.01 && worst < 1e-5);
    free(other);
    free(none);
    free(own);
    hair_test_collided_finish(&f);
}

// Check that followers move continuously with a collider. Strands that the collider covers beyond
// its middle are left out, because they leave on the other side. Simulated guides do not occur
// there.
static void small_collider_motion_moves_followers_little(void** state)
{
    struct hair_test_collided f = hair_test_collided_start(*state, 1);
    float* before = NULL;
    double worst = 0;
    size_t each = f.look.strand.segments + 1;
    float* freely = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_NONE);
    for (int frame = 0; frame < 60; ++frame) {
        f.colliders[0].position[0] = 0.25f - 0.002f * (float)frame;
        hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, f.colliders, HAIR_TEST_COLLIDED_COLLIDERS,
                                                      sizeof *f.colliders));
        float* now = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
        for (size_t i = 0; before && i < each * f.scene.groom->info.follower_count; ++i) {
            double square = 0;
            if (measure(&f, freely, (uint32_t)(i / each)).deepest > 0.01) continue;
            for (size_t k = 3 * i; k < 3 * i + 3; ++k) square += pow((double)now[k] - (double)before[k], 2);
            worst = fmax(worst, sqrt(square));
        }
        free(before);
        before = now;
    }
    print_message("    steps of 2 mm move followers by up to %.1f mm\n", 1000 * worst);
    assert_true(worst < 0.01);
    free(freely);
    free(before);
    hair_test_collided_finish(&f);
}

static void follower_collision_costs_nothing_out_of_reach(void** state)
{
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    uint32_t hits = hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"),
             repairs = hair_test_runs_of(&f.scene.test->context->gl, "repair");
    float* without = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_NONE);
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, NULL, 0, 0));
    float* none = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    for (int i = 0; i < HAIR_TEST_COLLIDED_COLLIDERS; ++i) f.colliders[i].position[1] += 3;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, f.colliders, HAIR_TEST_COLLIDED_COLLIDERS,
                                                  sizeof *f.colliders));
    float* far = hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    size_t size = 3 * sizeof *far * f.scene.groom->info.follower_count * (f.look.strand.segments + 1);
    assert_memory_equal(none, without, size);
    assert_memory_equal(far, without, size);
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"), hits);
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "repair"), repairs);
    assert_int_equal(f.scene.hair->geometry.follower_collision.hit +
                         f.scene.hair->geometry.follower_collision.repair +
                         f.scene.hair->geometry.follower_collision.list,
                     0);
    free(far);
    free(none);
    free(without);
    hair_test_collided_finish(&f);
}

// Check that hits are found once for all views and reads of a step.
static void follower_collision_runs_once_per_pose(void** state)
{
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    free(hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT));
    uint32_t count, hits = hair_test_runs_of(&f.scene.test->context->gl, "strands/hit");
    float some[3];
    for (int i = 0; i < 3; ++i)
        hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, some, 1, &count));
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"), hits);
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 0.01f));
    for (int i = 0; i < 3; ++i)
        hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, some, 1, &count));
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"), hits + 1);
    hair_test_collided_finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(follower_beyond_its_hit_follows_a_single_guide),
        HAIR_TEST(push_out_curve_is_a_spline),
        HAIR_TEST(pushed_out_followers_are_outside_and_keep_their_length),
        HAIR_TEST(threads_of_a_group_push_as_one_thread_does),
        HAIR_TEST(small_collider_motion_moves_followers_little),
        HAIR_TEST(follower_collision_costs_nothing_out_of_reach),
        HAIR_TEST(follower_collision_runs_once_per_pose),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
