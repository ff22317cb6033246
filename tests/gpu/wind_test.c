// wind_test.c - drag of the wind on strands agrees with the reference, and no wind harms hair.
#include "tests/support/live_hair.h"

#include <math.h>

#include "lib/api/api.h"

#define FRAME (1.0 / 60)
#define PI 3.14159265358979

static hair_wind blowing(float x, float y, float z)
{
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = x, wind.velocity[1] = y, wind.velocity[2] = z;
    return wind;
}

static struct hair_test_living straight(struct hair_test* test, uint32_t vertices, hair_vec3 way,
                                        const hair_physics* physics, hair_solver solver)
{
    struct hair_test_living living;
    struct hair_test_strands strands = hair_test_straight(vertices, hair_v3(0, 0, 0), way, 0.2f);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, physics);
    hair_test_live(test, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    return living;
}

// Check a free strand, across the wind and at an angle, which starts at rest. The test takes a
// quarter of a second.
static void wind_carries_a_free_strand_like_the_reference(void** state)
{
    static const float speeds[] = {0.05f, 1, 12}; // Reynolds numbers from 0.26 to 64.
    static const hair_vec3 ways[] = {{1, 0, 0}, {1, 0, 1}};
    hair_physics physics = hair_test_bare();
    physics.gravity[1] = 0, physics.damping = 0, physics.drag = 1;
    physics.fiber.radius = 4e-5f;
    physics.root = HAIR_ROOT_FREE;
    for (int k = 0; k < 6; ++k)
        for (int solver = 0; solver < 2; ++solver) {
            hair_wind wind = blowing(0, 0, speeds[k / 2]);
            struct hair_test_living living = straight(*state, 8, ways[k % 2], &physics, (hair_solver)solver);
            hair_test_wind_coupling(&living, &wind);
            struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
            double off = 0, way = (double)speeds[k / 2] * 15 * FRAME;
            for (int i = 0; i < 15; ++i) {
                hair_test_advance(&living, NULL, FRAME);
                hair_test_read_guides(&living);
                assert_true(hair_reference_rod_advance(rod, NULL, FRAME, 256));
                off = fmax(off, hair_test_off(&living, 0, rod));
            }
            print_message("    %g m/s, way %d, solver %d: off by %.2g of the wind's way\n",
                          (double)speeds[k / 2], k % 2, solver, off / way);
            assert_true(off < (solver == HAIR_SOLVER_DIRECT ? 1e-2 : 2e-3) * way);
            hair_reference_rod_destroy(rod);
            hair_test_die(&living);
        }
}

// Check the equilibrium of a hanging strand in a uniform wind. The error is relative to the
// deflection of its tip.
static void wind_deflects_a_strand_like_the_reference(void** state)
{
    static const struct {
        float drag, speed;
    } cases[] = {{1, 0.15f}, {1, 0.5f}, {0.1f, 2}, {0.3f, 6}};
    for (int k = 0; k < 4; ++k)
        for (int solver = 0; solver < 2; ++solver) {
            hair_physics physics = hair_test_bare();
            physics.damping = 6, physics.drag = cases[k].drag, physics.fiber.radius = 4e-5f;
            hair_wind wind = blowing(0.8f * cases[k].speed, 0, 0.6f * cases[k].speed);
            struct hair_test_living living =
                straight(*state, 16, hair_v3(0.1f, -1, 0), &physics, (hair_solver)solver);
            hair_test_wind_coupling(&living, &wind);
            struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
            for (int i = 0; i < 120; ++i) assert_true(hair_reference_rod_advance(rod, NULL, FRAME, 192));
            hair_test_wait(&living, 120);
            hair_test_read_guides(&living);
            double off = hair_test_off(&living, 0, rod), deflected = hair_test_from_rest(&living);
            print_message(
                "    %g m/s, drag %g, solver %d: tip deflected by %.3g of the length, off by %.2g of that\n",
                (double)cases[k].speed, (double)cases[k].drag, solver, deflected / 0.2, off / deflected);
            assert_true(deflected > 0.01);
            assert_true(off < 0.02 * deflected);
            hair_test_healthy(&living);
            hair_reference_rod_destroy(rod);
            hair_test_die(&living);
        }
}

// Return the rate of the law across a hair that moves at `speed`, in 1/s.
static double rate_of_law(const hair_physics* physics, const hair_wind* wind, double speed)
{
    double diameter = 2 * (double)physics->fiber.radius, density = (double)wind->density;
    double reynolds = speed * diameter * density / (double)wind->viscosity;
    double force = hair_reference_drag_across(reynolds) * density * diameter / 2 * speed;
    return (double)physics->drag * force / ((double)physics->fiber.density * PI * diameter * diameter / 4);
}

// Return the terminal speed of a level hair, on which the greater of damping and the law acts.
static double terminal_speed(const hair_physics* physics, const hair_wind* wind)
{
    double low = 0, high = 100;
    for (int i = 0; i < 60; ++i) {
        double middle = (low + high) / 2, law = wind->still_air ? rate_of_law(physics, wind, middle) : 0;
        *(middle * fmax((double)physics->damping, law) < 9.81 ? &low : &high) = middle;
    }
    return low;
}

static void still_air_slows_a_falling_strand_by_the_drag_law(void** state)
{
    static const struct {
        uint32_t still_air;
        float damping, drag;
    } cases[] = {{0, 4, 1}, {1, 4, 1}, {1, 0, 1}, {1, 4, 0.1f}, {1, 4, 0.01f}, {1, 4, 0}};
    for (int k = 0; k < 6; ++k)
        for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver) {
            hair_physics physics = hair_physics_default();
            hair_wind wind = hair_wind_default();
            physics.root = HAIR_ROOT_FREE,
            physics.shape.gravity_preload = physics.shape.frequency_root = physics.shape.frequency_tip = 0;
            physics.damping = cases[k].damping, physics.drag = cases[k].drag;
            wind.still_air = cases[k].still_air;
            struct hair_test_living living =
                straight(*state, 8, hair_v3(1, 0, 0), &physics, (hair_solver)solver);
            hair_test_wind_coupling(&living, &wind);
            hair_test_wait(&living, 180);
            hair_test_read_guides(&living);
            hair_test_wait(&living, 12);
            hair_test_read_guides(&living);
            double speed = hair_test_moved(&living) / 0.2, expected = terminal_speed(&physics, &wind);
            print_message("    still_air %u, damping %g, drag %g, solver %d: %.4g m/s, expected %.4g\n",
                          cases[k].still_air, (double)cases[k].damping, (double)cases[k].drag, solver, speed,
                          expected);
            // The solver follow takes gravity's part of a substep without the law.
            assert_true(fabs(speed / expected - 1) < (solver == HAIR_SOLVER_FOLLOW ? 0.07 : 0.01));
            hair_test_die(&living);
        }
}

static double suffer(struct hair_test_living* living, const hair_wind* wind, uint32_t frames, int gusty,
                     double dt)
{
    double max = 0;
    for (uint32_t i = 0; i < frames; ++i) {
        hair_test_wind_coupling(living, gusty && i % 2 ? NULL : wind);
        hair_test_advance(living, NULL, dt);
        hair_test_read_guides(living);
        max = fmax(max, hair_test_stretch(living));
    }
    return max;
}

static void hair_survives_any_wind_and_returns(void** state)
{
    static const struct {
        float speed, drag;
        int gusty;
        double dt;
    } cases[] = {{1000, 10, 0, FRAME}, {1000, 10, 1, FRAME}, {30, 1, 1, FRAME}, {20, 1, 1, 0.1}};
    for (int k = 0; k < 4; ++k)
        for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver) {
            hair_physics physics = hair_physics_default();
            physics.drag = cases[k].drag;
            float speed = cases[k].speed;
            hair_wind wind = blowing(0.6f * speed, 0.1f * speed, -0.8f * speed);
            struct hair_test_living living =
                straight(*state, 16, hair_v3(0.6f, -1, 0), &physics, (hair_solver)solver);
            double max = suffer(&living, &wind, 60, cases[k].gusty, cases[k].dt);
            max = fmax(max, suffer(&living, NULL, 240, 0, FRAME));
            hair_solver_stats solver_stats = hair_test_solver_stats(&living);
            print_message(
                "    %g m/s, drag %g%s, steps of %.2g s, solver %d: stretch %.2g, then %.2g from rest; %u by "
                "Euler, %u follow, %u reset\n",
                (double)speed, (double)cases[k].drag, cases[k].gusty ? ", on and off" : "", cases[k].dt,
                solver, max, hair_test_from_rest(&living) / 0.2, solver_stats.euler_fallbacks,
                solver_stats.follow_fallbacks, solver_stats.reset);
            assert_true(max <= 0.02);
            if (solver != HAIR_SOLVER_FOLLOW) assert_true(hair_test_from_rest(&living) < 0.002);
            assert_int_equal(solver_stats.reset, 0);
            hair_test_die(&living);
        }
}

static void disabled_wind_costs_nothing(void** state)
{
    hair_physics physics = hair_physics_default();
    hair_wind wind = blowing(1, 0, 0);
    struct hair_test_living living = straight(*state, 8, hair_v3(0, -1, 0), &physics, HAIR_SOLVER_DIRECT);
    hair_test_wait(&living, 1);
    assert_int_equal(living.hair->sim.wind_state.params, 0);
    hair_test_wind_coupling(&living, &wind);
    hair_test_wait(&living, 1);
    assert_int_not_equal(living.hair->sim.wind_state.params, 0);
    hair_test_wind_coupling(&living, NULL);
    hair_test_wait(&living, 1);
    assert_int_equal(living.hair->sim.wind_state.params, 0);
    hair_test_die(&living);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(wind_carries_a_free_strand_like_the_reference),
        HAIR_TEST(wind_deflects_a_strand_like_the_reference),
        HAIR_TEST(still_air_slows_a_falling_strand_by_the_drag_law),
        HAIR_TEST(hair_survives_any_wind_and_returns),
        HAIR_TEST(disabled_wind_costs_nothing),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
