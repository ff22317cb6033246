// rod_test.c - energy of the reference rod, and invariants of its motion: momentum, energy, and
// second-order convergence.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "tests/support/reference_rod.h"

#define PI 3.141592653589793
#define CURL 12 // Number of vertices of the rod that has every feature.

// A tapered corkscrew of flat section with uneven segments. Its rest shape differs.
struct curl {
    struct hair_reference_rod_desc desc;
    double positions[3 * CURL], rest[3 * CURL], scale[CURL];
};

static void make_curl(struct curl* c)
{
    c->desc = hair_reference_rod_desc_default();
    for (int i = 0; i < CURL; ++i) {
        double t = i + 0.2 * sin(5.0 * i);
        c->positions[3 * i] = 0.1 + 0.02 * cos(0.7 * t);
        c->positions[3 * i + 1] = -0.012 * t;
        c->positions[3 * i + 2] = 0.02 * sin(0.7 * t);
        c->scale[i] = 1.2 - 0.07 * i;
    }
    c->desc.vertices = CURL;
    c->desc.positions = c->positions;
    c->desc.rest_strain = c->rest;
    c->desc.scale = c->scale;
    c->desc.line_density = 1;
    c->desc.tip_mass = 0.003;
    c->desc.bend[0] = 1e-3;
    c->desc.bend[1] = 2.5e-3;
    c->desc.twist = 0.8e-3;
    c->desc.gravity[1] = -9.81;
    // A right angle about x, y to z, which is nearly the corkscrew's direction.
    c->desc.root_frame[0] = sqrt(0.5);
    c->desc.root_frame[3] = sqrt(0.5);
    hair_reference_rod_strain(CURL, c->positions, c->desc.root_frame, c->rest);
    for (int i = 0; i < 3 * (CURL - 1); ++i) c->rest[i] += 0.2 * sin(1.3 * i * i);
}

static double elastic_at(struct hair_reference_rod* rod, const double* positions)
{
    hair_reference_rod_set_state(rod, positions, NULL);
    return hair_reference_rod_energy_of(rod).elastic;
}

// Compute the gradient by central differences of fourth order.
static void differ(struct hair_reference_rod* rod, const double* at, double* gradient)
{
    static const double weight[] = {1.0 / 12, -2.0 / 3, 2.0 / 3, -1.0 / 12};
    double x[3 * CURL], step = 2e-5;
    memcpy(x, at, sizeof x);
    for (int k = 0; k < 3 * CURL; ++k) {
        gradient[k] = 0;
        for (int s = 0; s < 4; ++s) {
            x[k] = at[k] + step * (s < 2 ? s - 2 : s - 1);
            gradient[k] += weight[s] * elastic_at(rod, x) / step;
        }
        x[k] = at[k];
    }
    hair_reference_rod_set_state(rod, at, NULL);
}

static void forces_are_the_gradient_of_the_energy(void** state)
{
    (void)state;
    static const enum hair_reference_rod_root roots[] = {HAIR_REFERENCE_ROD_CLAMPED,
                                                         HAIR_REFERENCE_ROD_HINGED, HAIR_REFERENCE_ROD_FREE};
    for (int straight = 0; straight < 2; ++straight)
        for (int k = 0; k < 3; ++k) {
            struct curl c;
            make_curl(&c);
            c.desc.straight = straight;
            c.desc.root = roots[k];
            struct hair_reference_rod* rod = hair_test_rod(&c.desc);
            double gradient[3 * CURL], force[3 * CURL];
            differ(rod, c.positions, gradient);
            hair_reference_rod_elastic_forces(rod, force);
            double max = 0;
            for (int i = 0; i < 3 * CURL; ++i) max = fmax(max, fabs(force[i]));
            assert_true(max > 1e-3);
            for (int i = 0; i < 3 * CURL; ++i)
                hair_test_near(straight ? "straight" : "with twist", (size_t)i, force[i], -gradient[i],
                               1e-8 * max);
            hair_reference_rod_destroy(rod);
        }
}

// Find the angle at each vertex except the last, from the direction before it to the direction
// after it.
static void find_angles(const struct curl* c, double* angles)
{
    double before[3] = {0, 0, 1}; // The clamp's direction, see make_curl().
    for (int i = 0; i + 1 < CURL; ++i) {
        double after[3], length = 0, square = 0;
        for (int k = 0; k < 3; ++k) {
            after[k] = c->positions[3 * i + 3 + k] - c->positions[3 * i + k];
            length += after[k] * after[k];
        }
        for (int k = 0; k < 3; ++k) after[k] /= sqrt(length);
        for (int k = 0; k < 3; ++k) square += (after[k] - before[k]) * (after[k] - before[k]);
        angles[i] = 2 * asin(sqrt(square) / 2);
        memcpy(before, after, sizeof before);
    }
}

// Check the energy of a round rod without rest strain and twist. The strain of a straight rod is 2
// sin(half the angle). Other rods have the energy of the strain 4 sin(a quarter of the angle).
static void a_round_rod_without_twist_has_the_energy_of_its_angles(void** state)
{
    (void)state;
    struct curl c;
    double angles[CURL];
    make_curl(&c);
    find_angles(&c, angles);
    c.desc.rest_strain = NULL;
    c.desc.bend[1] = c.desc.bend[0];
    c.desc.twist = 0;
    c.desc.plain_clamp = 1;
    for (int straight = 0; straight < 2; ++straight) {
        c.desc.straight = straight;
        struct hair_reference_rod* rod = hair_test_rod(&c.desc);
        double sum = 0, length[CURL] = {0};
        for (int i = 0; i + 1 < CURL; ++i) {
            double strain = straight ? 2 * sin(angles[i] / 2) : 4 * sin(angles[i] / 4);
            for (int k = 0; k < 3; ++k)
                length[i] += pow(c.positions[3 * i + 3 + k] - c.positions[3 * i + k], 2);
            length[i] = sqrt(length[i]);
            double own = i ? (length[i - 1] + length[i]) / 2 : length[0] / 2;
            sum += c.desc.bend[0] * c.scale[i] / own * strain * strain / 2;
        }
        hair_test_near(straight ? "straight" : "curved", 0, hair_reference_rod_energy_of(rod).elastic, sum,
                       1e-13 * sum);
        hair_reference_rod_destroy(rod);
    }
}

static void rotate(const double q[4], const double v[3], double out[3])
{
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                      {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                      {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

// Check that the forces depend only on the positions in the head's frame.
static void forces_rotate_with_head_and_hair(void** state)
{
    (void)state;
    struct curl c;
    make_curl(&c);
    struct hair_reference_rod* here = hair_test_rod(&c.desc);
    const double rotation[4] = {0.1, -0.5, 0.7, 0.5};
    struct hair_reference_rod_pose elsewhere = {{3, -2, 1}, {0.1, -0.5, 0.7, 0.5}};
    c.desc.head = elsewhere;
    struct hair_reference_rod* there = hair_test_rod(&c.desc);
    double a[3 * CURL], b[3 * CURL], turned[3];
    hair_reference_rod_elastic_forces(here, a);
    hair_reference_rod_elastic_forces(there, b);
    hair_test_near("energy", 0, hair_reference_rod_energy_of(here).elastic,
                   hair_reference_rod_energy_of(there).elastic, 1e-14);
    for (int i = 0; i < CURL; ++i) {
        rotate(rotation, a + 3 * i, turned);
        for (int k = 0; k < 3; ++k) hair_test_near("force", (size_t)i, b[3 * i + k], turned[k], 1e-10);
    }
    hair_reference_rod_destroy(here);
    hair_reference_rod_destroy(there);
}

// Compute the momentum and the angular momentum about the origin.
static void momenta(const struct hair_reference_rod* rod, double sum[6])
{
    double x[3 * CURL], v[3 * CURL], m[CURL];
    hair_reference_rod_positions(rod, x);
    hair_reference_rod_velocities(rod, v);
    hair_reference_rod_masses(rod, m);
    memset(sum, 0, 6 * sizeof *sum);
    for (int i = 0; i < CURL; ++i)
        for (int k = 0; k < 3; ++k) {
            int p = 3 * i + (k + 1) % 3, q = 3 * i + (k + 2) % 3;
            sum[k] += m[i] * v[3 * i + k];
            sum[3 + k] += m[i] * (x[p] * v[q] - x[q] * v[p]);
        }
}

static void a_free_rod_keeps_its_momentum_and_angular_momentum(void** state)
{
    (void)state;
    struct curl c;
    make_curl(&c);
    c.desc.root = HAIR_REFERENCE_ROD_FREE;
    c.desc.gravity[1] = 0;
    struct hair_reference_rod* rod = hair_test_rod(&c.desc);
    double v[3 * CURL], before[6], after[6];
    for (int i = 0; i < 3 * CURL; ++i) v[i] = 0.2 * sin(3.0 * i) + 0.5;
    hair_reference_rod_set_state(rod, NULL, v);
    momenta(rod, before);
    for (int k = 0; k < 50; ++k) assert_true(hair_reference_rod_advance(rod, NULL, 0.01, 100));
    momenta(rod, after);
    for (int k = 0; k < 6; ++k) hair_test_near("momentum", (size_t)k, after[k], before[k], 1e-13);
    hair_reference_rod_destroy(rod);
}

// Check free fall. The scheme is exact for constant acceleration, with any substep.
static void free_rod_falls_like_a_stone(void** state)
{
    (void)state;
    struct curl c;
    make_curl(&c);
    c.desc.root = HAIR_REFERENCE_ROD_FREE;
    c.desc.rest_strain = NULL;
    c.desc.bend[0] = c.desc.bend[1] = c.desc.twist = 0;
    struct hair_reference_rod* rod = hair_test_rod(&c.desc);
    assert_true(hair_reference_rod_advance(rod, NULL, 1, 60));
    double x[3 * CURL];
    hair_reference_rod_positions(rod, x);
    for (int i = 0; i < CURL; ++i)
        hair_test_near("fallen", (size_t)i, x[3 * i + 1] - c.positions[3 * i + 1], -4.905, 1e-12);
    hair_reference_rod_destroy(rod);
}

// Check damping of all vertices alike: v = wind + (v0 - wind) exp(-c t), with the velocity v, its
// initial value v0, and damping c.
static void damping_is_exact_and_against_the_wind(void** state)
{
    (void)state;
    struct curl c;
    make_curl(&c);
    c.desc.root = HAIR_REFERENCE_ROD_FREE;
    c.desc.gravity[1] = 0;
    c.desc.bend[0] = c.desc.bend[1] = c.desc.twist = 0;
    c.desc.damping = 3;
    c.desc.wind[0] = 2;
    struct hair_reference_rod* rod = hair_test_rod(&c.desc);
    assert_true(hair_reference_rod_advance(rod, NULL, 0.5, 7));
    double v[3 * CURL];
    hair_reference_rod_velocities(rod, v);
    for (int i = 0; i < CURL; ++i) hair_test_near("speed", (size_t)i, v[3 * i], 2 - 2 * exp(-1.5), 1e-12);
    hair_reference_rod_destroy(rod);
}

static void shape_pull_swings_the_rod_about_its_target(void** state)
{
    (void)state;
    struct curl c;
    double pull[CURL], target[3 * CURL], x[3 * CURL];
    make_curl(&c);
    for (int i = 0; i < CURL; ++i) {
        pull[i] = 8;
        for (int k = 0; k < 3; ++k) target[3 * i + k] = c.positions[3 * i + k] - (k == 2 ? 0.01 : 0);
    }
    // The head, off the origin and rotated about z, carries the target.
    c.desc.head.position[0] = 0.3;
    c.desc.head.position[2] = -0.2;
    c.desc.head.rotation[2] = sin(0.4);
    c.desc.head.rotation[3] = cos(0.4);
    c.desc.root = HAIR_REFERENCE_ROD_FREE;
    c.desc.bend[0] = c.desc.bend[1] = c.desc.twist = 0;
    c.desc.gravity[1] = 0;
    c.desc.pull = pull;
    c.desc.pull_target = target;
    struct hair_reference_rod* rod = hair_test_rod(&c.desc);
    struct hair_reference_rod_report report =
        hair_reference_rod_converge(rod, 1, NULL, 0.3, 64, 1 << 16, 1e-9, x);
    assert_true(report.converged);
    for (int i = 0; i < CURL; ++i)
        hair_test_near("z", (size_t)i, x[3 * i + 2] - target[3 * i + 2] + 0.2, 0.01 * cos(8 * 0.3), 1e-9);
    hair_reference_rod_destroy(rod);
}

// Check that energy oscillates about its initial value, in proportion to the square of the substep,
// and does not decay.
static void energy_stays_within_the_square_of_the_substep(void** state)
{
    (void)state;
    double max[2];
    for (int run = 0; run < 2; ++run) {
        struct curl c;
        make_curl(&c);
        struct hair_reference_rod* rod = hair_test_rod(&c.desc);
        double start = hair_reference_rod_energy_of(rod).total;
        max[run] = 0;
        for (int k = 0; k < 1000; ++k) {
            assert_true(hair_reference_rod_advance(rod, NULL, 1e-3, run ? 8 : 4));
            max[run] = fmax(max[run], fabs(hair_reference_rod_energy_of(rod).total - start));
        }
        assert_true(hair_reference_rod_stretch(rod) < 1e-13);
        hair_reference_rod_destroy(rod);
    }
    hair_test_near("ratio", 0, max[0] / max[1], 4, 0.4);
    assert_true(max[1] < 1e-5 && max[1] > 1e-8); // The exchanged energy is 0.05 J.
}

// Check convergence with everything at once: a head that moves and rotates, wind, damping, pull,
// and a flat and curly strand.
static void motion_converges_with_the_second_order(void** state)
{
    (void)state;
    struct curl c;
    double pull[CURL];
    struct hair_reference_rod_pose heads[6];
    make_curl(&c);
    for (int i = 0; i < CURL; ++i) pull[i] = 5 - 0.3 * i;
    c.desc.pull = pull;
    c.desc.damping = 1;
    c.desc.wind[2] = 1;
    for (int k = 0; k < 6; ++k) {
        double angle = 0.05 * (k + 1) * (k + 1);
        struct hair_reference_rod_pose pose = {{0.005 * k, 0, 0.003 * k * k},
                                               {0, sin(angle / 2), 0, cos(angle / 2)}};
        heads[k] = pose;
    }
    struct hair_reference_rod* rod = hair_test_rod(&c.desc);
    struct hair_reference_rod_report report =
        hair_reference_rod_converge(rod, 6, heads, 1.0 / 60, 16, 1 << 14, 2e-8, NULL);
    assert_true(report.converged);
    hair_test_near("order", 0, report.order, 2, 0.02);
    double x[3 * CURL];
    hair_reference_rod_positions(rod, x);
    double root[3];
    rotate(heads[5].rotation, c.positions, root);
    for (int k = 0; k < 3; ++k)
        hair_test_near("root", (size_t)k, x[k], heads[5].position[k] + root[k], 1e-15);
    hair_reference_rod_destroy(rod);
}

static void half_the_longest_substep_is_stable_and_triple_is_not(void** state)
{
    (void)state;
    struct curl c;
    for (int run = 0; run < 2; ++run) {
        make_curl(&c);
        struct hair_reference_rod* rod = hair_test_rod(&c.desc);
        double h = hair_reference_rod_longest_substep(rod) * (run ? 3 : 0.5);
        double start = hair_reference_rod_energy_of(rod).total;
        int ok = hair_reference_rod_advance(rod, NULL, 2000 * h, 2000);
        int calm = ok && fabs(hair_reference_rod_energy_of(rod).total - start) < 0.02;
        assert_int_equal(calm, run == 0);
        hair_reference_rod_destroy(rod);
    }
}

static void motion_that_is_invalid_or_not_finite_is_reported(void** state)
{
    (void)state;
    struct curl c;
    make_curl(&c);
    struct hair_reference_rod* rod = hair_test_rod(&c.desc);
    double v[3 * CURL] = {0};
    v[3 * CURL - 1] = NAN;
    assert_false(hair_reference_rod_advance(rod, NULL, 0, 1));
    assert_false(hair_reference_rod_advance(rod, NULL, 0.01, 0));
    hair_reference_rod_set_state(rod, NULL, v);
    assert_false(hair_reference_rod_advance(rod, NULL, 0.01, 100));
    hair_reference_rod_destroy(rod);
}

static void invalid_rod_is_refused(void** state)
{
    (void)state;
    struct curl c;
    make_curl(&c);
    struct hair_reference_rod_desc bad[6];
    for (int i = 0; i < 6; ++i) bad[i] = c.desc;
    bad[0].vertices = 1;
    bad[1].vertices = 257;
    bad[2].line_density = 0;
    bad[3].bend[1] = -1;
    bad[4].gravity[2] = NAN;
    bad[5].root_frame[0] = bad[5].root_frame[3] = 0;
    for (int i = 0; i < 6; ++i) assert_null(hair_reference_rod_create(&bad[i]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_the_gradient_of_the_energy),
        cmocka_unit_test(a_round_rod_without_twist_has_the_energy_of_its_angles),
        cmocka_unit_test(forces_rotate_with_head_and_hair),
        cmocka_unit_test(a_free_rod_keeps_its_momentum_and_angular_momentum),
        cmocka_unit_test(free_rod_falls_like_a_stone),
        cmocka_unit_test(damping_is_exact_and_against_the_wind),
        cmocka_unit_test(shape_pull_swings_the_rod_about_its_target),
        cmocka_unit_test(energy_stays_within_the_square_of_the_substep),
        cmocka_unit_test(motion_converges_with_the_second_order),
        cmocka_unit_test(half_the_longest_substep_is_stable_and_triple_is_not),
        cmocka_unit_test(motion_that_is_invalid_or_not_finite_is_reported),
        cmocka_unit_test(invalid_rod_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
