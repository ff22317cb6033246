// rod_swing_test.c - motion of the reference rod, compared with linkages, chains and beams, and
// with a moving head.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "tests/reference/continuum.h"
#include "tests/support/reference_rod.h"

#define PI 3.141592653589793

// Release links without stiffness in a plane, from `angle` from straight down. Every mass is 1.
static struct hair_reference_rod* release(struct hair_test_plane* p, uint32_t links, double length,
                                          double angle)
{
    static const double masses[] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    hair_test_plane_make(p, links + 1, angle, 9.81);
    for (uint32_t i = 0; i < links; ++i) p->lengths[i] = length / links;
    for (uint32_t i = 0; i < 3 * links + 3; ++i) p->positions[i] *= length;
    p->desc.masses = masses;
    p->desc.straight = 1;
    p->desc.bend[0] = 0;
    p->desc.root = HAIR_REFERENCE_ROD_HINGED;
    return hair_test_rod(&p->desc);
}

// Return when a pendulum released from `angle` first passes through its lowest point, by Hermite's
// cubic between two substeps.
static double quarter_period(double angle, double dt)
{
    struct hair_test_plane p;
    struct hair_reference_rod* rod = release(&p, 1, 1, angle);
    double x[6], v[6], x0 = 1, v0 = 0, quarter = -1;
    for (int k = 0; quarter < 0; ++k) {
        assert_true(hair_reference_rod_advance(rod, NULL, dt, 1));
        hair_reference_rod_positions(rod, x);
        hair_reference_rod_velocities(rod, v);
        if (x[3] < 0) {
            double w0 = 0, w1 = 1;
            while (w1 - w0 > 1e-15) {
                double w = (w0 + w1) / 2, u = 1 - w;
                double at = u * u * (1 + 2 * w) * x0 + w * w * (1 + 2 * u) * x[3] +
                            dt * (u * u * w * v0 - w * w * u * v[3]);
                *(at > 0 ? &w0 : &w1) = w;
            }
            quarter = (k + w0) * dt;
        }
        x0 = x[3];
        v0 = v[3];
    }
    hair_reference_rod_destroy(rod);
    return quarter;
}

static void pendulum_has_its_period(void** state)
{
    (void)state;
    for (int k = 1; k <= 5; ++k) {
        double angle = k * PI / 6;
        double period = 4 * hair_test_extrapolate(quarter_period(angle, 1e-3), quarter_period(angle, 5e-4));
        hair_test_near("period", (size_t)k, period * sqrt(9.81) / (2 * PI),
                       hair_reference_pendulum_period(angle), 1e-8);
    }
}

// Compare chains with a linkage integrated in its angles. The error of convergence is less than the
// tolerance.
static void chains_released_level_fall_like_linkages(void** state)
{
    (void)state;
    for (uint32_t links = 2; links <= 8; links *= 2) {
        struct hair_test_plane p;
        struct hair_reference_rod* rod = release(&p, links, 0.3, PI / 2);
        double coarse[4 * 27], fine[4 * 27], angle[8], rate[8] = {0};
        struct hair_reference_rod* twin = hair_reference_rod_copy(rod);
        struct hair_reference_rod_report report =
            hair_reference_rod_converge(twin, 4, NULL, 0.25, 64, 1 << 14, 3e-6, coarse);
        assert_true(report.converged);
        hair_test_near("order", links, report.order, 2, 0.02);
        hair_reference_rod_converge(rod, 4, NULL, 0.25, 2 * report.substeps, 2 * report.substeps, 0, fine);
        for (uint32_t i = 0; i < links; ++i) angle[i] = PI / 2;
        for (uint32_t frame = 0; frame < 4; ++frame) {
            hair_reference_linkage_advance(links, p.lengths, p.desc.masses, 9.81, 0.25, 200, angle, rate);
            double x = 0, y = 0;
            uint32_t tip = 3 * (frame * (links + 1) + links);
            for (uint32_t i = 0; i < links; ++i) {
                x += p.lengths[i] * sin(angle[i]);
                y -= p.lengths[i] * cos(angle[i]);
            }
            hair_test_near("x", frame, hair_test_extrapolate(coarse[tip], fine[tip]), x, 1e-7);
            hair_test_near("y", frame, hair_test_extrapolate(coarse[tip + 1], fine[tip + 1]), y, 1e-7);
        }
        hair_reference_rod_destroy(twin);
        hair_reference_rod_destroy(rod);
    }
}

// Check a flat corkscrew, whose swings bend and twist it together. Strong damping leaves only the
// slowest mode, whose period is then measured without damping.
static void a_flat_corkscrew_swings_as_its_slowest_mode(void** state)
{
    (void)state;
    enum { N = 16 };
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    double x[3 * N], rest[3 * N], strain[3 * N], modes[2], v[3 * N] = {0};
    for (int i = 0; i < N; ++i) {
        x[3 * i] = 0.1 * cos(0.1 * i);
        x[3 * i + 1] = -0.01 * i;
        x[3 * i + 2] = 0.1 * sin(0.1 * i);
    }
    desc.vertices = N;
    desc.positions = x;
    desc.line_density = 1;
    desc.bend[0] = 1e-2;
    desc.bend[1] = 0.2;
    desc.twist = 7e-3;
    desc.gravity[1] = -2;
    desc.root_frame[0] = sqrt(0.5);
    desc.root_frame[3] = sqrt(0.5);
    hair_reference_rod_strain(N, x, desc.root_frame, strain);
    desc.rest_strain = strain;
    struct hair_reference_rod* rod = hair_test_rod(&desc);
    hair_test_rod_rest(rod);
    hair_reference_rod_positions(rod, rest);
    assert_int_equal(hair_reference_rod_modes(rod, 2, modes), 2);
    v[3 * N - 3] = 1e-3 * modes[0];
    hair_reference_rod_set_state(rod, NULL, v);
    hair_reference_rod_set_damping(rod, 3 * modes[0]);
    assert_true(hair_reference_rod_advance(rod, NULL, 15 / modes[0], 20000));
    memset(v, 0, sizeof v);
    hair_reference_rod_set_state(rod, NULL, v);
    hair_reference_rod_set_damping(rod, 0);
    hair_reference_rod_positions(rod, x);
    double start = x[3 * N - 3] - rest[3 * N - 3];
    assert_true(hair_reference_rod_advance(rod, NULL, PI / modes[0], 10000));
    hair_reference_rod_positions(rod, x);
    hair_reference_rod_velocities(rod, v);
    hair_test_near("place", 0, (x[3 * N - 3] - rest[3 * N - 3]) / start, -1, 1e-6);
    hair_test_near("speed", 0, v[3 * N - 3] / (start * modes[0]), 0, 3e-5);
    hair_reference_rod_destroy(rod);
}

static void clamped_beam_swings_at_its_analytic_frequency(void** state)
{
    (void)state;
    double found[2][3];
    for (uint32_t k = 0; k < 2; ++k) {
        struct hair_test_plane p;
        hair_test_plane_make(&p, (24u << k) + 1, 1, 0);
        p.desc.bend[0] = 1e4; // The other direction is stiff.
        struct hair_reference_rod* rod = hair_test_rod(&p.desc);
        assert_int_equal(hair_reference_rod_modes(rod, 3, found[k]), 3);
        hair_reference_rod_destroy(rod);
    }
    for (uint32_t n = 0; n < 3; ++n) {
        double root = hair_reference_beam_root(n + 1);
        hair_test_near("mode", n, hair_test_extrapolate(found[0][n], found[1][n]) / (root * root), 1,
                       3e-6 * pow(8, n));
    }
}

static void hanging_chain_swings_like_a_linkage(void** state)
{
    (void)state;
    enum { LINKS = 31 };
    struct hair_test_plane p;
    double found[6], mass[LINKS + 1];
    hair_test_plane_make(&p, LINKS + 1, 0, 9.81);
    p.desc.straight = 1;
    p.desc.bend[0] = 0;
    p.desc.tip_mass = 0.3;
    struct hair_reference_rod* rod = hair_test_rod(&p.desc);
    hair_reference_rod_masses(rod, mass);
    hair_test_near("tip", 0, mass[LINKS], 0.5 / LINKS + 0.3, 1e-15);
    assert_int_equal(hair_reference_rod_modes(rod, 6, found), 6);
    for (uint32_t n = 0; n < 6; ++n) // The modes in both planes are equal.
        hair_test_near("mode", n, found[n],
                       hair_reference_linkage_frequency(n / 2 + 1, LINKS, p.lengths, mass + 1, 9.81), 1e-9);
    hair_reference_rod_destroy(rod);
}

// Check 0.3 m of hair on a head of 0.1 m that yaws by 0.6 sin^2(pi t). The hair leaves the head at
// 30 degrees below the horizontal. Positions of the tip are from another program (explicit bending,
// k = 2, converged to 5e-8 of the length).
static void shaken_head_leaves_the_tip_at_its_known_position(void** state)
{
    (void)state;
    enum { N = 32, FRAMES = 1920 };
    static const double tip[3][3] = {
        {0.00174, -0.29152, 0.00082}, {-0.18453, -0.22581, -0.09356}, {0.16098, -0.23919, 0.06972}};
    double x[3 * N], lengths[N - 1];
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    for (int j = 0; j < N - 1; ++j) lengths[j] = 0.3 / (N - 1);
    for (int i = 0; i < N; ++i) {
        x[3 * i] = 0.1 + i * 0.3 / (N - 1) * cos(PI / 6);
        x[3 * i + 1] = -i * 0.3 / (N - 1) * sin(PI / 6);
        x[3 * i + 2] = 0;
    }
    desc.vertices = N;
    desc.positions = x;
    desc.lengths = lengths;
    desc.line_density = 1.021018e-5;
    desc.bend[0] = 1.472622e-8;
    desc.straight = 1;
    desc.plain_clamp = 1;
    desc.root_frame[2] = -sin(PI / 3);
    desc.root_frame[3] = cos(PI / 3);
    desc.gravity[1] = -9.81;
    desc.damping = 1;
    desc.head.position[0] = -0.1;
    struct hair_reference_rod* rod = hair_test_rod(&desc);
    for (int k = 1; k <= FRAMES; ++k) {
        double angle = 0.6 * sin(PI * k / FRAMES) * sin(PI * k / FRAMES);
        struct hair_reference_rod_pose head = {{-0.1, 0, 0}, {0, sin(angle / 2), 0, cos(angle / 2)}};
        assert_true(hair_reference_rod_advance(rod, &head, 1.0 / FRAMES, 8));
        int at = k == FRAMES / 4 ? 0 : k == FRAMES / 2 ? 1 : k == FRAMES ? 2 : -1;
        if (at < 0) continue;
        hair_reference_rod_positions(rod, x);
        for (int i = 0; i < 3; ++i)
            hair_test_near("tip", (size_t)(3 * at + i), x[3 * N - 3 + i], tip[at][i], 5.1e-6);
    }
    hair_reference_rod_destroy(rod);
}

// Check that the head rotates evenly: by half of the angle in half of the time. A quaternion and
// its negative are the same rotation.
static void head_is_interpolated_uniformly_the_shortest_way(void** state)
{
    (void)state;
    struct hair_test_plane p;
    hair_test_plane_make(&p, 8, 1, 9.81);
    p.desc.bend[1] = 1e-3;
    p.positions[2] = 0.1; // Moves the root off the head's origin.
    p.desc.lengths = NULL;
    struct hair_reference_rod_pose half = {{0.1, 0, 0.2}, {sin(0.35), 0, 0, cos(0.35)}};
    struct hair_reference_rod_pose whole = {{0.2, 0, 0.4}, {-sin(0.7), 0, 0, -cos(0.7)}};
    struct hair_reference_rod* once = hair_test_rod(&p.desc);
    struct hair_reference_rod* twice = hair_reference_rod_copy(once);
    double a[24], b[24];
    assert_true(hair_reference_rod_advance(once, &whole, 0.1, 2000));
    assert_true(hair_reference_rod_advance(twice, &half, 0.05, 1000));
    assert_true(hair_reference_rod_advance(twice, &whole, 0.05, 1000));
    hair_reference_rod_positions(once, a);
    hair_reference_rod_positions(twice, b);
    for (int i = 0; i < 24; ++i) hair_test_near("place", (size_t)i, a[i], b[i], 1e-11);
    // The root, at (0, 0, 0.1) in the head's frame, rotates about x.
    hair_test_near("root", 1, a[1], -0.1 * sin(1.4), 1e-15);
    hair_test_near("root", 2, a[2], 0.4 + 0.1 * cos(1.4), 1e-15);
    hair_reference_rod_velocities(once, a);
    hair_test_near("root", 3, a[1], -0.1 * cos(1.4) * 14, 1e-12);
    hair_reference_rod_destroy(once);
    hair_reference_rod_destroy(twice);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_corkscrew_swings_as_its_slowest_mode),
        cmocka_unit_test(pendulum_has_its_period),
        cmocka_unit_test(chains_released_level_fall_like_linkages),
        cmocka_unit_test(clamped_beam_swings_at_its_analytic_frequency),
        cmocka_unit_test(hanging_chain_swings_like_a_linkage),
        cmocka_unit_test(shaken_head_leaves_the_tip_at_its_known_position),
        cmocka_unit_test(head_is_interpolated_uniformly_the_shortest_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
