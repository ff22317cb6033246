// rod_buckling_test.c - weights at which the reference rod buckles, sideways or out of its plane,
// compared with the theory of continuous rods.
#include "tests/support/support.h"

#include <math.h>

#include "tests/reference/continuum.h"
#include "tests/support/reference_rod.h"

#define PI 3.141592653589793

// Return the weight at which `stability` is 0, between a, where it is positive, and b.
static double critical(double (*stability)(double gamma, uint32_t segments, const void* user), double a,
                       double b, const void* user)
{
    double found[2];
    for (uint32_t k = 0; k < 2; ++k) {
        double stable = a, unstable = b;
        assert_true(stability(stable, 48u << k, user) > 0);
        assert_true(stability(unstable, 48u << k, user) < 0);
        for (int i = 0; i < 28; ++i) {
            double middle = (stable + unstable) / 2;
            *(stability(middle, 48u << k, user) > 0 ? &stable : &unstable) = middle;
        }
        found[k] = stable;
    }
    return hair_test_extrapolate(found[0], found[1]);
}

// Compare a rod of n segments with the lowest eigenvalue of a chain of springs, 4 n^2 sin^2(pi /
// 4n).
static void unloaded_rod_is_as_stable_as_a_chain_of_springs(void** state)
{
    (void)state;
    static const double stiffness[][3] = {{1, 0, 0}, {1, 3, 5}, {5, 3, 1}, {5, 1, 3}}; // B1, C, B2.
    for (int k = 0; k < 4; ++k)
        for (uint32_t segments = 1; segments < 100; segments *= 3) {
            struct hair_test_plane p;
            hair_test_plane_make(&p, segments + 1, 1, 0);
            p.desc.straight = k == 0;
            p.desc.bend[0] = stiffness[k][0];
            p.desc.twist = stiffness[k][1];
            p.desc.bend[1] = stiffness[k][2];
            struct hair_reference_rod* rod = hair_test_rod(&p.desc);
            hair_test_near("least", segments, hair_reference_rod_stability(rod),
                           4.0 * segments * segments * pow(sin(PI / (4.0 * segments)), 2), 1e-10);
            hair_reference_rod_destroy(rod);
        }
}

static double upright(double gamma, uint32_t segments, const void* user)
{
    (void)user;
    struct hair_test_plane p;
    hair_test_plane_make(&p, segments + 1, PI, gamma);
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    double stability = hair_reference_rod_stability(rod);
    hair_reference_rod_destroy(rod);
    return stability;
}

static void an_upright_rod_buckles_at_greenhills_weight(void** state)
{
    (void)state;
    hair_test_near("gamma", 0, critical(upright, 7, 9, NULL), 7.8373474, 1e-5);
}

struct blade {
    double weak, twist; // Relative to the stiffness upright.
};

static double sideways(double weight, uint32_t segments, const void* user)
{
    const struct blade* blade = user;
    struct hair_test_plane p;
    hair_test_plane_make(&p, segments + 1, PI / 2, weight * sqrt(blade->weak * blade->twist));
    p.desc.bend[0] = blade->weak;
    p.desc.twist = blade->twist;
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    struct hair_reference_rod_rested res = hair_reference_rod_rest(rod);
    assert_true(res.converged);
    double stability = hair_reference_rod_stability(rod);
    hair_reference_rod_destroy(rod);
    return stability;
}

static void a_deep_cantilever_buckles_sideways(void** state)
{
    (void)state;
    static const struct blade blades[] = {{0.001, 0.001}, {0.01, 0.0138}, {0.1, 0.1}};
    static const double expected[] = {12.8691, 13.0452, 14.9060};
    for (size_t i = 0; i < 3; ++i)
        hair_test_near("weight", i, critical(sideways, 11, 16, &blades[i]), expected[i], 1.5e-4);
}

// Return the stability of a curved rod. The weight starts at turn_and_start[1], a stable value, and
// changes in steps.
static double hang_curved(double gamma, uint32_t segments, const void* user)
{
    const double* turn_and_start = user;
    struct hair_test_plane p;
    hair_test_plane_make(&p, segments + 1, 0, turn_and_start[1]);
    hair_test_plane_curl(&p, turn_and_start[0]);
    if (turn_and_start[1] > 0) p.desc.positions = NULL; // The rod is straight along the root frame.
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    for (int i = 0; i <= 20; ++i) {
        double gravity[3] = {0, -(turn_and_start[1] + (gamma - turn_and_start[1]) * i / 20), 0};
        hair_reference_rod_set_gravity(rod, gravity);
        struct hair_reference_rod_rested rested = hair_reference_rod_rest(rod);
        assert_true(rested.converged);
    }
    double stability = hair_reference_rod_stability(rod);
    hair_reference_rod_destroy(rod);
    return stability;
}

// Check a curl. It hangs in its plane under weak or strong gravity, and is a helix between.
static void curl_buckles_out_of_plane_between_two_weights(void** state)
{
    (void)state;
    static const double two_pi[] = {2 * PI, 0}, two_pi_down[] = {2 * PI, 60};
    static const double four_pi[] = {4 * PI, 0}, four_pi_down[] = {4 * PI, 600};
    hair_test_near("2 pi", 1, critical(hang_curved, 11, 14, two_pi), 12.548, 1e-3);
    hair_test_near("2 pi", 2, critical(hang_curved, 50, 40, two_pi_down), 44.759, 2e-3);
    hair_test_near("4 pi", 1, critical(hang_curved, 33, 40, four_pi), 36.23, 1e-2);
    hair_test_near("4 pi", 2, critical(hang_curved, 500, 420, four_pi_down), 452.48, 5e-2);
}

static double held(double gamma, uint32_t segments, const void* user)
{
    const double* angle = user;
    struct hair_test_plane p;
    hair_test_plane_make(&p, segments + 1, *angle * PI / 180, gamma);
    assert_true(hair_reference_rod_hold(&p.desc, p.strain, p.real));
    p.desc.rest_strain = p.strain;
    p.desc.rest_real = p.real;
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    double stability = hair_reference_rod_stability(rod);
    hair_reference_rod_destroy(rod);
    return stability;
}

// Check a strand that is groomed straight and is at rest by its rest strain. It is stable up to a
// certain weight.
static void preloaded_strand_buckles_beyond_its_critical_weight(void** state)
{
    (void)state;
    static const double table[][2] = {{20, 72.92},  {30, 41.06},  {45, 23.794}, {60, 16.568}, {75, 12.825},
                                      {90, 10.675}, {105, 9.384}, {120, 8.610}, {150, 7.949}, {180, 7.837}};
    for (size_t i = 0; i < sizeof table / sizeof *table; ++i)
        hair_test_near("weight", i, critical(held, 0.8 * table[i][1], 1.2 * table[i][1], &table[i][0]),
                       table[i][1], 1.2e-4 * table[i][1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unloaded_rod_is_as_stable_as_a_chain_of_springs),
        cmocka_unit_test(an_upright_rod_buckles_at_greenhills_weight),
        cmocka_unit_test(a_deep_cantilever_buckles_sideways),
        cmocka_unit_test(curl_buckles_out_of_plane_between_two_weights),
        cmocka_unit_test(preloaded_strand_buckles_beyond_its_critical_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
