// reference_test.c - the double-precision reference of motion agrees with values worked out by
// hand.
#include "tests/support/reference_guide.h"

#include <math.h>
#include <string.h>

// Check free fall. Without damping or constraints, Verlet is exact for constant acceleration. After
// n substeps from rest, a vertex has fallen g dt^2 n (n + 1) / 2.
static void free_vertex_falls_by_verlet(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(5, 0.01f);
    f.params.gravity.y = -10;
    double dt = (double)f.params.gravity.w, p[3 * HAIR_MAX_GUIDE_VERTICES];
    for (int n = 1; n <= 50; ++n) {
        hair_reference_integrate(hair_test_guide_whole(&f), 0, f.state, p);
        for (uint32_t i = 2; i < 5; ++i)
            for (int k = 0; k < 3; ++k) {
                f.state[i].displacement[k] = p[3 * i + k] - f.state[i].position[k];
                f.state[i].position[k] = p[3 * i + k];
            }
        hair_test_near("fallen", n, f.state[4].position[1] + 4 * (double)0.01f,
                       -10 * dt * dt * n * (n + 1) / 2, 1e-12);
        hair_test_near3("pinned", p + 3, 0, (double)-0.01f, 0, 0);
    }
}

// Check a velocity that decays by the factor k per substep. Its total distance is 1 + k + k^2 + ...
// = (1 - k^n) / (1 - k) displacements.
static void damped_motion_goes_as_far_as_its_series(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    f.params.keep = 0.75f;
    double p[3 * HAIR_MAX_GUIDE_VERTICES];
    f.state[3].displacement[0] = 0.004;
    for (int n = 1; n <= 20; ++n) {
        hair_reference_integrate(hair_test_guide_whole(&f), 0, f.state, p);
        f.state[3].displacement[0] = p[9] - f.state[3].position[0];
        f.state[3].position[0] = p[9];
        hair_test_near("gone", n, p[9], 0.003 * (1 - pow(0.75, n)) / 0.25, 1e-15);
    }
}

// Check a free strand. In the head's moving coordinates it lags behind by exactly the motion of the
// head.
static void a_free_vertex_does_not_follow_the_head(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    f.params.substep[0].displacement = (hair_vec4){0.25f, 0, -0.5f, 1};
    double p[3 * HAIR_MAX_GUIDE_VERTICES];
    hair_reference_integrate(hair_test_guide_whole(&f), 0, f.state, p);
    hair_test_near3("free", p + 9, -0.25, f.state[3].position[1], 0.5, 1e-16);
    hair_test_near3("pinned", p, 0, 0, 0, 0);
}

// Check an implicit spring. It converges to its target, and goes half way if frequency times dt is
// 1.
static void pull_goes_half_way_when_frequency_times_dt_is_1(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    f.params.gravity.w = 0.125f;
    f.params.shape_frequency_root = f.params.shape_frequency_tip = 8;
    f.state[3].position[0] = 0.5;
    double p[3 * HAIR_MAX_GUIDE_VERTICES];
    hair_reference_integrate(hair_test_guide_whole(&f), 0, f.state, p);
    hair_test_near3("pulled", p + 9, 0.25, f.state[3].position[1], 0, 1e-16);
}

static void a_free_link_is_restored_exactly_in_one_relaxation(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(5, 0.01f);
    double p[3 * 5] = {0, 0, 0, 0, -0.01, 0, 0.03, -0.02, 0.01, 0.05, -0.01, 0.04, 0.1, 0.2, 0.3};
    double middle[3];
    for (int k = 0; k < 3; ++k) middle[k] = (p[6 + k] + p[9 + k]) / 2;
    hair_reference_distance(hair_test_guide_whole(&f), 0, p);
    hair_test_near("length", 0, hair_test_distance3(p + 6, p + 9), (double)0.01f, 1e-16);
    hair_test_near3("middle", (double[]){(p[6] + p[9]) / 2, (p[7] + p[10]) / 2, (p[8] + p[11]) / 2},
                    middle[0], middle[1], middle[2], 1e-16);
    hair_test_near3("other link", p + 12, 0.1, 0.2, 0.3, 0);
}

static void link_with_a_pinned_end_moves_only_the_free_end(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    double p[3 * 4] = {0, 0, 0, 0, -0.01, 0, 0.03, -0.05, 0, 0, 0, 0};
    hair_reference_distance(hair_test_guide_whole(&f), 1, p);
    hair_test_near3("pinned", p + 3, 0, -0.01, 0, 0);
    // The direction is (3, -4) / 5.
    hair_test_near3("free", p + 6, 0.6 * (double)0.01f, -0.01 - 0.8 * (double)0.01f, 0, 1e-16);
    hair_reference_distance(hair_test_guide_whole(&f), 0, p);
    hair_test_near3("pinned", p + 3, 0, -0.01, 0, 0);
}

static void bend_removes_its_fraction_of_the_error(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(8, 0.01f);
    double p[3 * 8] = {0};
    f.params.bend = 0.25f;
    for (int i = 0; i < 8; ++i) p[3 * i + 1] = -0.005 * i; // Half as long as at rest.
    hair_reference_bend(hair_test_guide_whole(&f), 1,
                        p); // The pairs are (2,4) and (3,5). (6,8) does not exist.
    for (size_t i = 2; i < 4; ++i) {
        // Positions at rest are floats.
        double rest = (double)f.rest[i].position.y - (double)f.rest[i + 2].position.y, wrong = rest - 0.01;
        double length = hair_test_distance3(p + 3 * i, p + 3 * (i + 2));
        hair_test_near("length", i, length, rest - 0.75 * wrong, 1e-16);
    }
    hair_test_near("root", 0, p[3], 0, 0);
    hair_test_near("tip", 0, p[19], -0.03, 1e-16);
}

static void vertex_in_a_capsule_leaves_by_the_shortest_way(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    f.params.colliders = 1;
    f.params.collision_margin = 0.25f;
    f.params.collider[0] =
        (struct hair_capsule){{{0, 0, 0, 1}, {0, 2, 0, 1}}, {{8, 0, 0, 1}, {8, 2, 0, 1}}, {0, 0, 0, 0}};
    f.params.substep[0].displacement.w = 0.5f; // Half way, so the axis is at x = 4.
    double p[3 * 4] = {0, 0, 0, 0, 0, 0, 4, 1, 0.5, 4.3, 2.4, 0};
    hair_reference_collide(hair_test_guide_whole(&f), 0, p);
    hair_test_near3("beside the axis", p + 6, 4, 1, 1.25, 1e-15);
    hair_test_near3("beyond its end", p + 9, 4 + 1.25 * 0.6, 2 + 1.25 * 0.8, 0, 1e-14);
    double outside[3 * 4] = {0, 0, 0, 0, 0, 0, 5.3, 1, 0, 4, 3.3, 0};
    hair_reference_collide(hair_test_guide_whole(&f), 0, outside);
    hair_test_near3("outside", outside + 6, 5.3, 1, 0, 0);
}

// Check a bent guide in its rest pose, rotated with its head. The force must correct nothing.
static void angular_force_is_zero_in_the_rest_pose(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(9, 0.01f);
    double p[3 * 9] = {0};
    for (int i = 0; i < 8; ++i) {
        double angle = 0.3 * i, to[3] = {sin(angle) * cos(0.2 * i), -cos(angle), sin(angle) * sin(0.2 * i)};
        for (int k = 0; k < 3; ++k) p[3 * i + 3 + k] = p[3 * i + k] + 0.01 * to[k];
        f.rest[i + 1].position.x = (float)p[3 * i + 3];
        f.rest[i + 1].position.y = (float)p[3 * i + 4];
        f.rest[i + 1].position.z = (float)p[3 * i + 5];
    }
    f.params.angular = 1e6f;
    // A right angle about z, x to y and y to -x.
    f.params.substep[0].rotation = (hair_vec4){0, 0, (float)sqrt(0.5), (float)sqrt(0.5)};
    double turned[3 * 9];
    for (int i = 0; i < 9; ++i) {
        turned[3 * i] = -p[3 * i + 1];
        turned[3 * i + 1] = p[3 * i];
        turned[3 * i + 2] = p[3 * i + 2];
    }
    double moved[3 * 9];
    memcpy(moved, turned, sizeof moved);
    hair_reference_angular(hair_test_guide_whole(&f), 0, moved);
    // The rest positions are floats.
    for (int i = 0; i < 9; ++i)
        hair_test_near3("vertex", moved + 3 * i, turned[3 * i], turned[3 * i + 1], turned[3 * i + 2], 1e-8);
}

// Compute what the angular force does to the free coordinates when one of them is moved.
static void angular_moves_of(struct hair_test_guide* f, const double* bent, int coordinate, double by,
                             double out[21])
{
    double moved[27], from[27];
    memcpy(from, bent, sizeof from);
    from[6 + coordinate] += by;
    memcpy(moved, from, sizeof moved);
    hair_reference_angular(hair_test_guide_whole(f), 0, moved);
    for (int k = 0; k < 21; ++k) out[k] = moved[6 + k] - from[6 + k];
}

// Check that the derivative of the force is symmetric, as for any force with a potential. Any other
// force can add energy to the strand without limit.
static void the_angular_force_has_a_potential(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(9, 0.01f);
    double p[27] = {0}, ahead[21], behind[21], jacobian[21][21], largest = 0;
    f.params.angular = 2500;
    for (int i = 1; i < 9; ++i) {
        double angle = 0.5 * i, to[3] = {sin(angle) * cos(0.9 * i), -cos(angle), sin(angle) * sin(0.9 * i)};
        for (int k = 0; k < 3; ++k) p[3 * i + k] = i == 1 && k != 1 ? 0 : p[3 * i - 3 + k] + 0.01 * to[k];
        f.rest[i].position.x += 0.004f * (float)(i % 3 - 1) * (i > 1);
    }
    for (int c = 0; c < 21; ++c) {
        angular_moves_of(&f, p, c, 1e-6, ahead);
        angular_moves_of(&f, p, c, -1e-6, behind);
        for (int k = 0; k < 21; ++k) jacobian[k][c] = (ahead[k] - behind[k]) / 2e-6;
    }
    for (int i = 0; i < 21 * 21; ++i) largest = fmax(largest, fabs(jacobian[i / 21][i % 21]));
    assert_true(largest > 0.1);
    for (int i = 0; i < 21 * 21; ++i)
        hair_test_near("derivative", (size_t)i, jacobian[i / 21][i % 21], jacobian[i % 21][i / 21], 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_vertex_falls_by_verlet),
        cmocka_unit_test(damped_motion_goes_as_far_as_its_series),
        cmocka_unit_test(a_free_vertex_does_not_follow_the_head),
        cmocka_unit_test(pull_goes_half_way_when_frequency_times_dt_is_1),
        cmocka_unit_test(a_free_link_is_restored_exactly_in_one_relaxation),
        cmocka_unit_test(link_with_a_pinned_end_moves_only_the_free_end),
        cmocka_unit_test(bend_removes_its_fraction_of_the_error),
        cmocka_unit_test(vertex_in_a_capsule_leaves_by_the_shortest_way),
        cmocka_unit_test(angular_force_is_zero_in_the_rest_pose),
        cmocka_unit_test(the_angular_force_has_a_potential),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
