// rods_gravity_preload_test.c - gravity preload of guides as rods: equilibrium and stability.
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/rod_statics.h"
#include "tests/support/rods.h"

#define PI 3.141592653589793
#define MAX HAIR_MAX_GUIDE_VERTICES

static struct hair_rod_shape shape_of(const struct hair_test_rod* f)
{
    struct hair_rod_shape shape;
    hair_rod_shape_of(&f->guide, f->rest, &f->physics, &shape);
    return shape;
}

// A groom under gravity times `load`. Its stiffness is multiplied at each vertex, and its rest
// strain balances gravity.
struct held {
    struct hair_rod_shape shape;
    struct hair_rod_pose pose;
    double stiffness[MAX];
    hair_rod_rest rest[MAX];
    hair_dvec3 gravity;
    double slowest; // Squared angular frequency below which a mode is not stable enough.
};

static void hold(const struct hair_test_rod* f, const double* stiffen, double load, struct held* h)
{
    h->shape = shape_of(f);
    h->gravity = hair_dscale(hair_dload(f->physics.gravity), load * (double)f->physics.shape.gravity_preload);
    for (uint32_t i = 0; i < h->shape.count; ++i) h->shape.bend[i] *= stiffen[i];
    hair_rod_pose_at(&h->shape, h->shape.frame, &h->pose);
    hair_rod_load(&h->shape, load, &h->pose);
    hair_rod_balance(&h->shape, &h->pose);
    for (uint32_t i = 0; i + 1 < h->shape.count; ++i) {
        hair_dquat t = h->shape.turn[i];
        h->shape.stress[i] = h->pose.stress[i];
        h->stiffness[i] = hair_rod_stiffness(&h->shape, i);
        hair_dvec3 excess = hair_rod_excess(&h->shape, i, h->stiffness[i]);
        h->rest[i] = (hair_rod_rest){2 * t.x - excess.x, 2 * t.y - excess.y, 2 * t.z - excess.z, 2 * t.w};
    }
}

static hair_dquat turned(hair_dquat q, const double* by)
{
    double a = sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]), s = a > 0 ? sin(a / 2) / a : 0.5;
    return hair_dmultiply((hair_dquat){s * by[0], s * by[1], s * by[2], cos(a / 2)}, q);
}

// Return the energy with segment j rotated by the vector turns[3 j ..] in the world.
static double energy_of(const struct held* h, const double* turns)
{
    const struct hair_rod_shape* s = &h->shape;
    hair_dquat before = hair_dmultiply(s->frame[0], hair_dconjugate(s->turn[0]));
    hair_dvec3 at = {0, 0, 0};
    double energy = 0;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dquat q = turned(s->frame[i], turns + 3 * i), r = hair_dmultiply(hair_dconjugate(before), q);
        double sign = r.w < 0 ? -2 : 2;
        hair_dquat u = {sign * r.x - h->rest[i].x, sign * r.y - h->rest[i].y, sign * r.z - h->rest[i].z,
                        sign * r.w - h->rest[i].w};
        hair_dvec3 ratio = hair_rod_ratios_at(s, i);
        energy += h->stiffness[i] / 2 *
                  (ratio.x * u.x * u.x + ratio.y * u.y * u.y + ratio.z * (u.z * u.z + u.w * u.w));
        at = hair_dadd(at, hair_dscale(hair_drotate(q, (hair_dvec3){0, 1, 0}), s->length[i]));
        hair_dvec3 away = hair_dadd(at, hair_dscale(s->place[i + 1], -1));
        energy -= s->mass[i + 1] * hair_ddot(h->gravity, at);
        energy += s->mass[i + 1] * (s->pull[i + 1] - h->slowest) / 2 * hair_ddot(away, away);
        before = q;
    }
    return energy;
}

// Names of grooms that are soft enough to buckle, and hold with up to three times their stiffness.
#define GROOMS 6
static const char* const groom_names[GROOMS] = {"level",     "upright",      "curl",
                                                "flat curl", "tapered curl", "curl with a tip"};

static void make_groom(struct hair_test_rod* f, int kind)
{
    // Length of the strand, or of a segment.
    static const double sizes[GROOMS] = {0.145, 0.13, 0.013, 0.0095, 0.0135, 0.0125};
    f->physics = hair_physics_default();
    if (kind < 2)
        hair_test_rod_straight(f, 12, sizes[kind], kind == 0 ? PI / 2 : PI);
    else
        hair_test_rod_curl(f, 12, sizes[kind]);
    if (kind == 3) f->physics.fiber.flatness = 0.4f;
    if (kind == 4) f->physics.shape.stiffness_root = 2, f->physics.shape.stiffness_tip = 0.3f;
    if (kind == 5) f->physics.tip_mass = 0.2f, f->physics.shape.gravity_preload = 0.6f;
}

static void multiply(double* out, double by)
{
    for (int i = 0; i < MAX; ++i) out[i] = by;
}

// Check that the slope of the energy is negligible relative to that of gravity alone.
static void preloaded_groom_is_in_equilibrium(void** state)
{
    (void)state;
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1.0 / 12, -2.0 / 3, 2.0 / 3, -1.0 / 12};
    struct hair_test_rod* f = hair_test_rod_make();
    struct held* h = calloc(2, sizeof *h);
    double stiffen[MAX];
    multiply(stiffen, 30);
    for (int kind = 0; kind < GROOMS; ++kind) {
        make_groom(f, kind);
        hold(f, stiffen, 1, h);
        double turns[3 * MAX] = {0}, step = 1e-3, max = 0, worst = 0;
        h[1] = h[0];
        for (uint32_t i = 0; i < MAX; ++i) h[1].stiffness[i] = 0;
        for (int k = 0; k < 33; ++k) {
            double slope = 0, alone = 0;
            for (int n = 0; n < 4; ++n) {
                turns[k] = at[n] * step;
                slope += weight[n] * energy_of(h, turns) / step;
                alone += weight[n] * energy_of(h + 1, turns) / step;
            }
            turns[k] = 0;
            worst = fmax(worst, fabs(slope));
            max = fmax(max, fabs(alone));
        }
        if (kind != 1) printf("%s: %.1e of gravity's torque is left\n", groom_names[kind], worst / max);
        assert_true(kind == 1 || max > 1e-3); // On an upright strand gravity has no torque.
        assert_true(worst < 1e-10 * fmax(max, 1e-3));
    }
    free(h);
    free(f);
}

// Return whether the matrix of second derivatives is positive definite, by Cholesky factorisation.
static int is_stable(const struct held* h)
{
    double turns[3 * MAX] = {0}, a[33][33], step = 2e-3;
    for (int r = 0; r < 33; ++r)
        for (int c = 0; c <= r; ++c) {
            double sum = 0;
            for (int n = 0; n < 4; ++n) {
                turns[r] += n & 1 ? step : -step;
                turns[c] += n & 2 ? step : -step;
                sum += (n == 1 || n == 2 ? -1 : 1) * energy_of(h, turns);
                turns[r] = turns[c] = 0;
            }
            a[r][c] = sum / (4 * step * step);
        }
    for (int c = 0; c < 33; ++c) {
        for (int n = 0; n < c; ++n) a[c][c] -= a[c][n] * a[c][n];
        if (!(a[c][c] > 0)) return 0;
        a[c][c] = sqrt(a[c][c]);
        for (int r = c + 1; r < 33; ++r) {
            for (int n = 0; n < c; ++n) a[r][c] -= a[r][n] * a[c][n];
            a[r][c] /= a[c][c];
        }
    }
    return 1;
}

// Return the energy with segments rotated by `fraction` times the vectors `turns`, in their own
// frames.
static double energy_along(const struct held* h, const hair_dvec3* turns, double fraction)
{
    struct held* at = malloc(sizeof *at);
    double world[3 * MAX] = {0};
    memcpy(at, h, sizeof *at);
    memcpy(at->shape.frame, h->pose.frame, sizeof at->shape.frame);
    at->shape.turn[0] = h->pose.turn[0];
    for (uint32_t i = 0; i + 1 < h->shape.count; ++i) {
        hair_dvec3 turn = hair_drotate(h->pose.frame[i], hair_dscale(turns[i], fraction));
        world[3 * i] = turn.x, world[3 * i + 1] = turn.y, world[3 * i + 2] = turn.z;
    }
    double energy = energy_of(at, world);
    free(at);
    return energy;
}

// Check Newton's step in a pose far from the groom, where 2 w differs from its value at rest. For
// any slope s, Newton's step z satisfies z . H z + shift z . z = -s . z. H is the matrix of second
// derivatives.
static void newton_step_uses_second_derivatives_of_the_energy(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    struct held* h = calloc(1, sizeof *h);
    double stiffen[MAX];
    multiply(stiffen, 1);
    for (int kind = 0; kind < GROOMS; ++kind) {
        make_groom(f, kind);
        hold(f, stiffen, 1, h);
        hair_dquat frames[MAX];
        hair_dvec3 slope[MAX], turns[MAX];
        for (int i = 0; i < 11; ++i) {
            const double by[3] = {0.5 * sin(i), 0.4 * cos(3 * i), 0.5 * sin(2 * i + 1)};
            frames[i] = turned(h->shape.frame[i], by);
        }
        hair_rod_pose_at(&h->shape, frames, &h->pose);
        hair_rod_load(&h->shape, 1, &h->pose);
        hair_rod_strain(&h->shape, h->rest, &h->pose);
        for (int run = 0; run < 4; ++run) {
            double step = 1e-3, shift = 4 * h->stiffness[0], along = 0, square = 0, max = 0;
            for (int i = 0; i < 11; ++i)
                slope[i] = (hair_dvec3){sin(i + 7.0 * run), sin(3 * i + 5.0 * run), cos(2 * i - 3.0 * run)};
            assert_true(hair_rod_find_step(&h->shape, &h->pose, shift, slope, turns));
            for (int i = 0; i < 11; ++i) max = fmax(max, hair_dlength(turns[i]));
            for (int i = 0; i < 11; ++i) {
                turns[i] = hair_dscale(turns[i], 1 / max);
                along += hair_ddot(slope[i], turns[i]) / max;
                square += hair_ddot(turns[i], turns[i]);
            }
            double bent = (energy_along(h, turns, step) - 2 * energy_along(h, turns, 0) +
                           energy_along(h, turns, -step)) /
                          (step * step);
            hair_test_near(groom_names[kind], (size_t)run, bent + shift * square, -along, 1e-5 * -along);
        }
    }
    free(h);
    free(f);
}

// Return stability at 1 + fraction (s - 1) times the stiffness, with the guide's multiples s.
static int is_stable_with(const struct hair_test_rod* f, double fraction)
{
    struct held* h = calloc(1, sizeof *h);
    double stiffen[MAX];
    for (uint32_t i = 0; i < MAX; ++i) stiffen[i] = 1 + fraction * (f->borne[i].stiffen - 1);
    hold(f, stiffen, 1.3, h);
    h->slowest = 4;
    int stable = is_stable(h);
    assert_int_equal(stable, hair_rod_is_stable(&h->shape, &h->pose, 4));
    free(h);
    return stable;
}

static void guide_is_stiffened_until_its_groom_is_stable(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    for (int pulled = 0; pulled < 2; ++pulled)
        for (int kind = 0; kind < GROOMS; ++kind) {
            make_groom(f, kind);
            f->physics.shape.frequency_root = pulled ? 1.5f : 0;
            f->physics.shape.frequency_tip = pulled ? 0.5f : 0;
            hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
            double mean = 0;
            for (uint32_t i = 0; i < 11; ++i) mean += f->borne[i].stiffen / 11;
            printf("%s, pull %d: up to %.3f times as stiff, %.3f on average\n", groom_names[kind], pulled,
                   (double)f->report.stiffest, mean);
            assert_true(f->report.stiffened == 1 && f->report.sagging == 0 && f->report.farthest_sag == 0);
            assert_true(f->report.stiffest > 1 && f->report.stiffest <= 3);
            assert_true(f->report.stiffest == (float)f->borne[0].stiffen);
            assert_true(is_stable_with(f, 1));
            assert_false(is_stable_with(f, 0.95));
            assert_false(is_stable_with(f, 0));
            for (uint32_t i = 1; i < 11; ++i) assert_true(f->borne[i].stiffen <= f->borne[i - 1].stiffen);
            struct hair_rod_shape shape = shape_of(f);
            shape.bend[5] *= f->borne[5].stiffen;
            hair_test_near("given", 0, (double)f->rod[5].strain.w / hair_rod_stiffness(&shape, 5), 1, 1e-6);
        }
    free(f);
}

// Check rho A g L^3 / E I at which a straight strand buckles although its rest strain balances its
// weight. The angle is that of the clamp from straight down. The upright value is Greenhill's.
static void straight_grooms_buckle_at_the_lengths_of_the_continuous_rod(void** state)
{
    (void)state;
    static const double known[][2] = {
        {45, 23.794}, {60, 16.568}, {90, 10.675}, {120, 8.610}, {180, 7.8373474389}};
    struct hair_test_rod* f = hair_test_rod_make();
    struct held* h = calloc(1, sizeof *h);
    double stiffen[MAX];
    f->physics.shape.frequency_root = f->physics.shape.frequency_tip = 0;
    for (int i = 0; i < 5; ++i)
        for (int side = -1; side < 2; side += 2) {
            double length = 0.3, gamma = 9.81 * pow(length, 3) / hair_test_rod_bend(&f->physics);
            multiply(stiffen, gamma / known[i][1] * (1 + 0.01 * side));
            hair_test_rod_straight(f, 100, length, known[i][0] * PI / 180);
            hold(f, stiffen, 1, h);
            assert_int_equal(hair_rod_is_stable(&h->shape, &h->pose, 0), side > 0);
        }
    free(h);
    free(f);
}

// Return the maximum distance of a vertex's rest strain from the strain of a straight groom, which
// is 0.
static double max_strain(const struct hair_test_rod* f)
{
    double max = 0;
    for (uint32_t i = 0; i < f->guide.count; ++i) {
        hair_vec4 u = f->rod[i].strain;
        max = fmax(max, sqrt((double)(u.x * u.x + u.y * u.y + u.z * u.z)));
    }
    return max;
}

static void rest_strain_differs_from_the_groom_by_at_most_1(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    // Three segments. The strand would be stable as it is, but its rest strain is too far at each
    // vertex.
    hair_test_rod_straight(f, 4, 0.15, PI / 4);
    struct held* h = calloc(1, sizeof *h);
    double stiffen[MAX];
    multiply(stiffen, 1);
    hold(f, stiffen, 1.3, h);
    assert_true(hair_rod_is_stable(&h->shape, &h->pose, 0));
    assert_true(hair_dlength(hair_rod_excess(&h->shape, 1, h->stiffness[1])) > 1.1);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.stiffened, 1);
    assert_true(f->report.stiffest > 1 && f->report.stiffest <= 3 && !f->report.sagging);
    hair_test_near("of few segments", 0, max_strain(f), 0.985, 0.015);
    free(h);
    // A thread, for which no multiple is sufficient.
    f->physics.fiber.youngs_modulus = 1;
    hair_test_rod_straight(f, 32, 0.3, PI / 2);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.stiffened, 1);
    assert_true(f->report.stiffest == 3 && f->report.sagging == 1 && f->report.farthest_sag > 0.1f);
    assert_true(max_strain(f) < 1 + 1e-6);
    // Hair without stiffness is neither expected to hold nor stiffened.
    for (int k = 0; k < 2; ++k) {
        f->physics.fiber.youngs_modulus = k == 0 ? 0 : 4e9f;
        f->physics.shape.stiffness_root = k == 0 ? 1 : 0;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
        assert_int_equal(f->report.stiffened, 0);
        assert_true(f->report.stiffest == 1 && f->rod[0].strain.w == 0 && fabsf(f->rod[0].strain.z) < 1e-6f);
    }
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preloaded_groom_is_in_equilibrium),
        cmocka_unit_test(newton_step_uses_second_derivatives_of_the_energy),
        cmocka_unit_test(guide_is_stiffened_until_its_groom_is_stable),
        cmocka_unit_test(straight_grooms_buckle_at_the_lengths_of_the_continuous_rod),
        cmocka_unit_test(rest_strain_differs_from_the_groom_by_at_most_1),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
