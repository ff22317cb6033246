// rod_rest_test.c - equilibria of the reference rod, compared with the theory of continuous rods.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "tests/reference/continuum.h"
#include "tests/support/reference_rod.h"

#define PI 3.141592653589793

static double drop_over_reach(uint32_t segments, double gamma, int plain, int straight)
{
    struct hair_test_plane p;
    hair_test_plane_make(&p, segments + 1, PI / 2, gamma);
    p.desc.plain_clamp = plain;
    p.desc.straight = straight;
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    double tip[3];
    hair_test_rod_rest(rod);
    hair_test_rod_tip(rod, tip);
    hair_reference_rod_destroy(rod);
    return -tip[1] / tip[0];
}

static void rod_hangs_like_the_elastica(void** state)
{
    (void)state;
    static const double angles[] = {-1, 0, 1};
    for (int k = 0; k < 3; ++k)
        for (double gamma = 1; gamma <= 100; gamma *= 10) {
            struct hair_reference_elastica e = hair_reference_elastica(gamma, 0, angles[k]);
            double tip[2][3];
            for (uint32_t fine = 0; fine < 2; ++fine) {
                struct hair_test_plane p;
                hair_test_plane_make(&p, (100u << fine) + 1, PI / 2 - angles[k], gamma);
                struct hair_reference_rod* rod = hair_test_rod(&p.desc);
                hair_test_rod_rest(rod);
                hair_test_rod_tip(rod, tip[fine]);
                hair_reference_rod_destroy(rod);
            }
            double across = hair_test_extrapolate(tip[0][0], tip[1][0]),
                   down = -hair_test_extrapolate(tip[0][1], tip[1][1]);
            hair_test_near("across", (size_t)gamma, across, e.across, 1e-5);
            hair_test_near("down", (size_t)gamma, down, e.down, 1e-5);
        }
}

static void rod_with_a_tip_load_bends_like_the_elastica(void** state)
{
    (void)state;
    struct hair_reference_elastica e = hair_reference_elastica(0, 5, 0);
    double tip[2][3];
    for (uint32_t fine = 0; fine < 2; ++fine) {
        struct hair_test_plane p;
        hair_test_plane_make(&p, (64u << fine) + 1, PI / 2, 1e9);
        p.desc.line_density = 1e-15; // The rod weighs nothing except for its tip.
        p.desc.tip_mass = 5e-9;
        struct hair_reference_rod* rod = hair_test_rod(&p.desc);
        hair_test_rod_rest(rod);
        hair_test_rod_tip(rod, tip[fine]);
        hair_reference_rod_destroy(rod);
    }
    hair_test_near("across", 0, hair_test_extrapolate(tip[0][0], tip[1][0]), e.across, 2e-6);
    hair_test_near("down", 0, -hair_test_extrapolate(tip[0][1], tip[1][1]), e.down, 2e-6);
}

// Check the clamp factor. With k = 2, the clamp of a long soft strand is far too soft.
static void the_clamp_factor_holds_coarse_and_soft_strands(void** state)
{
    (void)state;
    // Error of drop over reach in percent, with k = 2 and with k by the weight. The second row is
    // for straight rods.
    static const struct {
        double weight, error[2][2];
    } expected[] = {{1, {{0.104, 0.053}, {0.106, 0.054}}},
                    {10, {{0.139, -0.025}, {0.200, 0.036}}},
                    {100, {{0.709, -0.349}, {1.206, 0.139}}},
                    {1000, {{7.251, -2.980}, {10.788, -0.704}}}};
    for (size_t k = 0; k < 4; ++k) {
        struct hair_reference_elastica e = hair_reference_elastica(expected[k].weight, 0, 0);
        for (int straight = 0; straight < 2; ++straight)
            for (int plain = 0; plain < 2; ++plain) {
                double ratio = drop_over_reach(31, expected[k].weight, plain, straight);
                hair_test_near(plain ? "k = 2" : "k", k, 100 * (ratio * e.across / e.down - 1),
                               expected[k].error[straight][!plain], 1e-3);
            }
    }
}

// Return the distance of the tip from the elastica. The strand is clamped at `up` above the
// horizontal.
static double distance_from_elastica(uint32_t segments, double gamma, double up, int plain)
{
    struct hair_reference_elastica e = hair_reference_elastica(gamma, 0, -up);
    struct hair_test_plane p;
    double tip[3];
    hair_test_plane_make(&p, segments + 1, PI / 2 + up, gamma);
    p.desc.plain_clamp = plain;
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    hair_test_rod_rest(rod);
    hair_test_rod_tip(rod, tip);
    hair_reference_rod_destroy(rod);
    return hypot(tip[0] - e.across, tip[1] + e.down);
}

// Return how far too low a chain hangs if it turns by `up` and a right angle at its clamp. See
// lib/rod/rod_shape.c.
static double polygon_error(uint32_t segments, double gamma, double up)
{
    return sqrt(gamma) * (1 - cos((PI / 2 + up) / 2)) / (6.0 * segments * segments);
}

// Check the error of the clamp. It is at most 1.31 times the error of the polygon. Without the
// second term of the clamp's energy it is 2.8 times, with 31 segments, a weight of 3000 and 1.3
// rad.
static void the_clamp_adds_little_to_the_error_of_the_polygon(void** state)
{
    (void)state;
    static const double gammas[] = {100, 300, 1000, 3000}, ups[] = {0, 0.8, 1.3};
    for (uint32_t segments = 31; segments <= 124; segments *= 2)
        for (size_t k = 0; k < 12; ++k) {
            double gamma = gammas[k / 3], up = ups[k % 3], polygon = polygon_error(segments, gamma, up);
            assert_true(distance_from_elastica(segments, gamma, up, 0) < 1.35 * polygon);
            assert_true(distance_from_elastica(segments, gamma, up, 1) > 1.35 * polygon);
        }
}

static void the_clamp_factor_is_that_of_a_chain_under_tension(void** state)
{
    (void)state;
    for (double p = 0.01; p < 100; p *= 1.7) {
        double r = 1 + p * p / 2 - sqrt(p * p + p * p * p * p / 4);
        hair_test_near("k", 0,
                       hair_reference_rod_clamp_factor(0.1, p * p * 100 * 3, 3) * (1 / p - 1 / (1 / r - 1)),
                       1, 1e-9);
    }
    hair_test_near("k", 1, hair_reference_rod_clamp_factor(0.1, 0, 3), 2, 0);
    hair_test_near("k", 2, hair_reference_rod_clamp_factor(0.1, 1, 0), 0, 0);
}

// Compare both kinds of strain. Straight rods have the energy of the chord between tangents, and
// others nearly that of the angle. The difference is proportional to the square of the angles.
static void both_strain_measures_agree_for_short_segments(void** state)
{
    (void)state;
    for (double gamma = 1; gamma < 2000; gamma *= 10) {
        double off[2];
        for (uint32_t fine = 0; fine < 2; ++fine)
            off[fine] =
                drop_over_reach(120u << fine, gamma, 0, 1) / drop_over_reach(120u << fine, gamma, 0, 0) - 1;
        assert_true(off[0] > 0 && off[0] < 5e-3);
        hair_test_near("with half", (size_t)gamma, off[1] / off[0], 0.25, 0.06);
    }
}

// Check a flat corkscrew of uneven segments with a heavy tip.
static void preloaded_curl_rests_in_its_groomed_shape(void** state)
{
    (void)state;
    enum { N = 24 };
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    double x[3 * N], y[3 * N], strain[3 * N], real[N];
    for (int i = 0; i < N; ++i) {
        double t = i + 0.3 * sin(3.0 * i);
        x[3 * i] = 0.02 * cos(0.6 * t);
        x[3 * i + 1] = -0.01 * t;
        x[3 * i + 2] = 0.02 * sin(0.6 * t);
    }
    desc.vertices = N;
    desc.positions = x;
    desc.line_density = 1e-5;
    desc.tip_mass = 1e-6;
    desc.bend[0] = 2e-7;
    desc.bend[1] = 3e-7;
    desc.twist = 1.5e-7;
    desc.gravity[1] = -9.81;
    desc.gravity[0] = 3;
    desc.root_frame[0] = sqrt(0.5);
    desc.root_frame[3] = sqrt(0.5);
    assert_true(hair_reference_rod_hold(&desc, strain, real));
    desc.rest_strain = strain;
    desc.rest_real = real;
    struct hair_reference_rod* rod = hair_test_rod(&desc);
    assert_true(hair_reference_rod_stability(rod) > 0);
    hair_test_rod_rest(rod);
    hair_reference_rod_positions(rod, y);
    for (int i = 0; i < 3 * N; ++i) hair_test_near("rest", (size_t)i, y[i], x[i], 1e-12 * 0.25);
    hair_reference_rod_set_state(rod, x, NULL);
    assert_true(hair_reference_rod_advance(rod, NULL, 0.1, 400));
    hair_reference_rod_positions(rod, y);
    for (int i = 0; i < 3 * N; ++i) hair_test_near("still", (size_t)i, y[i], x[i], 1e-11);
    hair_reference_rod_destroy(rod);
    // Without gravity preload its equilibrium is elsewhere.
    hair_reference_rod_strain(N, x, desc.root_frame, strain);
    rod = hair_test_rod(&desc);
    struct hair_reference_rod_rested rested = hair_reference_rod_rest(rod);
    // Newton's method needs all second derivatives to converge so fast.
    assert_true(rested.converged && rested.iterations < 12);
    hair_reference_rod_positions(rod, y);
    assert_true(fabs(y[3 * N - 2] - x[3 * N - 2]) > 0.005);
    hair_reference_rod_destroy(rod);
}

// Return the energy of a hinge that is bent in a plane by `bend`, from the root frame's y axis
// towards x.
static double energy_of_hinge(double rest, double bend)
{
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    const double x[] = {0, 0, 0, sin(bend), cos(bend), 0};
    const double strain[3] = {0, 0, -2 * sin(rest / 2)};
    desc.vertices = 2;
    desc.positions = x;
    desc.line_density = 1;
    desc.bend[0] = desc.bend[1] = desc.twist = 0.5;
    desc.plain_clamp = 1;
    desc.rest_strain = strain;
    struct hair_reference_rod* rod = hair_test_rod(&desc);
    double energy = hair_reference_rod_energy_of(rod).elastic;
    hair_reference_rod_destroy(rod);
    return energy;
}

static void hinge_energy_depends_on_the_angle_from_rest(void** state)
{
    (void)state;
    for (double rest = 0; rest < 2.4; rest += 0.3)
        for (double bend = -0.5; bend < 3.1; bend += 0.2)
            hair_test_near("energy", (size_t)(100 * rest), energy_of_hinge(rest, bend),
                           8 * pow(sin((bend - rest) / 4), 2), 1e-14);
}

// Check a curl whose joints are bent by up to 2.2 rad at rest. With all second derivatives, each
// step doubles the number of exact digits.
static void a_coarse_curl_comes_to_rest_in_few_steps(void** state)
{
    (void)state;
    enum { N = 12 };
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    double x[3 * N], strain[3 * N];
    for (int i = 0; i < N; ++i) {
        x[3 * i] = 0.01 * cos(2.4 * i);
        x[3 * i + 1] = -0.006 * i;
        x[3 * i + 2] = 0.01 * sin(2.4 * i);
    }
    desc.vertices = N;
    desc.positions = x;
    desc.line_density = 1;
    desc.bend[0] = 2e-3;
    desc.bend[1] = 3e-3;
    desc.twist = 1.5e-3;
    desc.gravity[0] = 9.81;
    desc.root_frame[0] = sqrt(0.5);
    desc.root_frame[3] = sqrt(0.5);
    hair_reference_rod_strain(N, x, desc.root_frame, strain);
    desc.rest_strain = strain;
    struct hair_reference_rod* rod = hair_test_rod(&desc);
    struct hair_reference_rod_rested rested = hair_reference_rod_rest(rod);
    double y[3 * N];
    hair_reference_rod_positions(rod, y);
    assert_true(rested.converged && rested.iterations < 9);
    assert_true(y[3 * N - 3] - x[3 * N - 3] > 0.02);
    hair_reference_rod_destroy(rod);
}

static void groom_that_no_strain_holds_is_reported(void** state)
{
    (void)state;
    struct hair_test_plane p;
    hair_test_plane_make(&p, 9, 1, 1);
    p.desc.root = HAIR_REFERENCE_ROD_HINGED;
    assert_false(hair_reference_rod_hold(&p.desc, p.strain, p.real));
    p.desc.root = HAIR_REFERENCE_ROD_CLAMPED;
    p.desc.straight = 1;
    assert_false(hair_reference_rod_hold(&p.desc, p.strain, p.real));
}

// Check a chain whose tip is pinned by a spring. The chain's tension stretches the spring to the
// length that puts the tip at its position.
static void a_chain_pinned_at_its_tip_is_a_catenary(void** state)
{
    (void)state;
    for (uint32_t links = 32; links <= 64; links *= 2) {
        struct hair_test_plane p;
        struct hair_reference_catenary expected = hair_reference_catenary_of_links(0.5, links);
        double pull[HAIR_TEST_MAX] = {0}, x[3 * HAIR_TEST_MAX], sag = 0;
        double stiffness = 30;
        hair_test_plane_make(&p, links + 1, PI / 2, 1);
        for (uint32_t i = 0; i < links; ++i) { // The initial shape is an arc.
            double angle = 1.2 * (1 - (2 * i + 1.0) / links);
            p.positions[3 * i + 3] = p.positions[3 * i] + p.lengths[0] * cos(angle);
            p.positions[3 * i + 4] = p.positions[3 * i + 1] - p.lengths[0] * sin(angle);
        }
        memcpy(x, p.positions, sizeof x);
        x[3 * links] = 0.5 + expected.tension * cos(expected.slope) / stiffness;
        x[3 * links + 1] = 0.5 / stiffness; // Half of the weight.
        pull[links] = sqrt(stiffness * 2 * links);
        p.desc.pull = pull;
        p.desc.pull_target = x;
        p.desc.straight = 1;
        p.desc.bend[0] = 0;
        p.desc.root = HAIR_REFERENCE_ROD_HINGED;
        struct hair_reference_rod* rod = hair_test_rod(&p.desc);
        hair_test_rod_rest(rod);
        hair_reference_rod_positions(rod, x);
        for (uint32_t i = 0; i <= links; ++i) sag = fmax(sag, -x[3 * i + 1]);
        hair_test_near("across", links, x[3 * links], 0.5, 1e-11);
        hair_test_near("level", links, x[3 * links + 1], 0, 1e-11);
        hair_test_near("sag", links, sag, expected.sag, 1e-11);
        hair_reference_rod_destroy(rod);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rod_hangs_like_the_elastica),
        cmocka_unit_test(rod_with_a_tip_load_bends_like_the_elastica),
        cmocka_unit_test(the_clamp_factor_holds_coarse_and_soft_strands),
        cmocka_unit_test(the_clamp_adds_little_to_the_error_of_the_polygon),
        cmocka_unit_test(the_clamp_factor_is_that_of_a_chain_under_tension),
        cmocka_unit_test(both_strain_measures_agree_for_short_segments),
        cmocka_unit_test(preloaded_curl_rests_in_its_groomed_shape),
        cmocka_unit_test(hinge_energy_depends_on_the_angle_from_rest),
        cmocka_unit_test(a_coarse_curl_comes_to_rest_in_few_steps),
        cmocka_unit_test(groom_that_no_strain_holds_is_reported),
        cmocka_unit_test(a_chain_pinned_at_its_tip_is_a_catenary),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
