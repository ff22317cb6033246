// rods_hold_test.c - what guides hold as rods against gravity, and how firmly.
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/reference/rod.h"
#include "lib/sim/rod_shape.h"
#include "tests/support/rods.h"

#define PI 3.141592653589793
#define MOST HAIR_MAX_GUIDE_VERTICES

static struct hair_rod_shape shape_of(const struct hair_test_rod* f)
{
    struct hair_rod_shape shape;
    hair_rod_shape_of(&f->guide, f->rest, &f->physics, &shape);
    return shape;
}

static void what_bears_no_gravity_rests_in_the_grooms_own_strain(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double                p[3 * 20], root[4], strain[3 * 20];
    hair_test_rod_curl(f, 20, 0.002);
    for (int i = 0; i < 60; ++i) p[i] = (double)(&f->rest[i / 3].position.x)[i % 3];
    for (int k = 0; k < 4; ++k) root[k] = (double)(&f->guide.root_frame.x)[k];
    hair_reference_rod_strain(20, p, root, strain);
    for (int k = 0; k < 4; ++k) {
        f->physics            = hair_physics_default();
        f->physics.hold       = k == 0 ? 0 : 1;
        f->physics.gravity[1] = k == 1 ? 0 : -9.81f;
        f->physics.root       = k == 2 ? HAIR_ROOT_HINGED : k == 3 ? HAIR_ROOT_FREE : HAIR_ROOT_CLAMPED;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
        for (int i = 0; i < 57; ++i)
            hair_test_near("strain", (size_t)i, (double)(&f->rod[i / 3].strain.x)[i % 3], strain[i], 2e-6);
    }
    free(f);
}

// q and -q are the same frame.
static void the_sign_of_a_frame_does_not_matter(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    struct hair_rod       rod[20];
    hair_test_rod_curl(f, 20, 0.01);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    memcpy(rod, f->rod, sizeof rod);
    for (int i = 0; i < 20; i += 3)
        for (int k = 0; k < 4; ++k) (&f->rest[i].frame.x)[k] *= -1;
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    for (size_t i = 0; i < 19; ++i)
        for (int k = 0; k < 3; ++k)
            hair_test_near("strain", i, (double)(&f->rod[i].strain.x)[k], (double)(&rod[i].strain.x)[k],
                           1e-7);
    free(f);
}

// The reference finds the same by its own way. It has a clamp factor for each stiffness; the section here is round,
// and the twist at the root is left out.
static void the_rest_strain_of_a_held_groom_is_the_references(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double                p[3 * 20], strain[3 * 20], most = 0;
    hair_test_rod_curl(f, 20, 0.002);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.stiffened, 0);
    for (int i = 0; i < 60; ++i) p[i] = (double)(&f->rest[i / 3].position.x)[i % 3];
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    double                         ratio[3];
    hair_rods_ratios(&f->physics, ratio);
    desc.vertices     = 20;
    desc.positions    = p;
    desc.line_density = 1;
    desc.bend[0] = desc.bend[1] = hair_test_rod_bend(&f->physics);
    desc.twist                  = ratio[1] * desc.bend[0];
    for (int k = 0; k < 3; ++k) desc.gravity[k] = (double)f->physics.gravity[k];
    for (int k = 0; k < 4; ++k) desc.root_frame[k] = (double)(&f->guide.root_frame.x)[k];
    assert_true(hair_reference_rod_hold(&desc, strain));
    for (int i = 0; i < 57; ++i)
        if (i != 1)
            hair_test_near("strain", (size_t)i, (double)(&f->rod[i / 3].strain.x)[i % 3], strain[i], 5e-6);
    hair_reference_rod_strain(20, p, desc.root_frame, strain);
    for (int i = 0; i < 57; ++i)
        most = fmax(most, fabs((double)(&f->rod[i / 3].strain.x)[i % 3] - strain[i]));
    assert_true(most > 0.005); // Gravity does show in it.
    free(f);
}

// The groom's own shape under gravity times `load`, with the rest strain that bears it.
struct held {
    struct hair_rod_shape shape;
    double                stiffness[MOST];
    hair_dvec3            strain[MOST], gravity;
};

static struct held hold(const struct hair_test_rod* f, double stiffen, double load)
{
    struct held          h      = {.shape = shape_of(f)};
    struct hair_test_rod loaded = *f;
    for (int k = 0; k < 3; ++k) loaded.physics.gravity[k] *= (float)load;
    struct hair_rod_shape bears = shape_of(&loaded);
    h.gravity                   = hair_dscale(hair_dload(loaded.physics.gravity), (double)f->physics.hold);
    for (uint32_t i = 0; i + 1 < h.shape.count; ++i) {
        hair_dvec3 v   = {bears.turn[i].x, bears.turn[i].y, bears.turn[i].z};
        h.stiffness[i] = hair_rod_stiffness(&h.shape, i, stiffen);
        h.strain[i] =
            hair_dadd(hair_dscale(v, 2), hair_dscale(hair_rod_excess(&bears, i, h.stiffness[i]), -1));
    }
    return h;
}

static hair_dquat turned(hair_dquat q, const double* by)
{
    double a = sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]), s = a > 0 ? sin(a / 2) / a : 0.5;
    return hair_dmultiply((hair_dquat){s * by[0], s * by[1], s * by[2], cos(a / 2)}, q);
}

// With segment j turned by the world's vector turns[3 j ..].
static double energy_of(const struct held* h, const double* turns)
{
    const struct hair_rod_shape* s      = &h->shape;
    hair_dquat                   before = hair_dmultiply(s->frame[0], hair_dconjugate(s->turn[0]));
    hair_dvec3                   at     = {0, 0, 0};
    double                       energy = 0;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dquat q = turned(s->frame[i], turns + 3 * i), r = hair_dmultiply(hair_dconjugate(before), q);
        double     sign = r.w < 0 ? -2 : 2;
        hair_dvec3 u    = {sign * r.x - h->strain[i].x, sign * r.y - h->strain[i].y,
                           sign * r.z - h->strain[i].z};
        energy += h->stiffness[i] / 2 *
                  (s->ratio[0] * u.x * u.x + s->ratio[1] * u.y * u.y + s->ratio[2] * u.z * u.z);
        at = hair_dadd(at, hair_dscale(hair_drotate(q, (hair_dvec3){0, 1, 0}), s->length[i]));
        energy -= s->mass[i + 1] * hair_ddot(h->gravity, at);
        before = q;
    }
    return energy;
}

// Grooms of many kinds that are soft enough to buckle.
#define GROOMS 6
static const char* const groom_names[GROOMS] = {"level",     "upright",      "curl",
                                                "flat curl", "tapered curl", "curl with a tip"};

static void make_groom(struct hair_test_rod* f, int kind)
{
    f->physics = hair_physics_default();
    if (kind < 2)
        hair_test_rod_straight(f, 12, 0.2, kind == 0 ? PI / 2 : PI);
    else
        hair_test_rod_curl(f, 12, 0.02);
    if (kind == 3) f->physics.flatness = 0.4f;
    if (kind == 4) f->physics.stiffness_root = 2, f->physics.stiffness_tip = 0.3f;
    if (kind == 5) f->physics.tip_mass = 0.5f, f->physics.hold = 0.6f;
}

// The slope is nothing beside that of gravity alone.
static void a_held_groom_is_in_equilibrium(void** state)
{
    (void)state;
    static const double   at[4] = {-2, -1, 1, 2}, weight[4] = {1.0 / 12, -2.0 / 3, 2.0 / 3, -1.0 / 12};
    struct hair_test_rod* f = hair_test_rod_make();
    for (int kind = 0; kind < GROOMS; ++kind) {
        make_groom(f, kind);
        struct held h = hold(f, 30, 1), slack = h;
        double      turns[3 * MOST] = {0}, step = 1e-3, most = 0, worst = 0;
        for (uint32_t i = 0; i < MOST; ++i) slack.stiffness[i] = 0;
        for (int k = 0; k < 33; ++k) {
            double slope = 0, alone = 0;
            for (int n = 0; n < 4; ++n) {
                turns[k] = at[n] * step;
                slope += weight[n] * energy_of(&h, turns) / step;
                alone += weight[n] * energy_of(&slack, turns) / step;
            }
            turns[k] = 0;
            worst    = fmax(worst, fabs(slope));
            most     = fmax(most, fabs(alone));
        }
        if (kind != 1) printf("%s: %.1e of gravity's torque is left\n", groom_names[kind], worst / most);
        assert_true(kind == 1 || most > 1e-3); // Upright, gravity turns nothing.
        assert_true(worst < 1e-10 * fmax(most, 1e-3));
    }
    free(f);
}

// Whether the matrix of second derivatives is positive: Cholesky.
static int is_stable(const struct hair_test_rod* f, double stiffen)
{
    struct held h               = hold(f, stiffen, 1.05);
    double      turns[3 * MOST] = {0}, a[33][33], step = 2e-3;
    for (int r = 0; r < 33; ++r)
        for (int c = 0; c <= r; ++c) {
            double sum = 0;
            for (int n = 0; n < 4; ++n) {
                turns[r] += n & 1 ? step : -step;
                turns[c] += n & 2 ? step : -step;
                sum += (n == 1 || n == 2 ? -1 : 1) * energy_of(&h, turns);
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

static void a_guide_is_made_just_so_stiff_that_its_groom_is_stable(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    for (int kind = 0; kind < GROOMS; ++kind) {
        make_groom(f, kind);
        struct hair_rod_shape shape = shape_of(f);
        double                given = hair_rod_stiffen(&shape), fails = 1, holds = 1000;
        while (holds > 1.002 * fails) {
            double middle = sqrt(fails * holds);
            if (is_stable(f, middle))
                holds = middle;
            else
                fails = middle;
        }
        printf("%s: %.3f times as stiff, by its energy %.3f\n", groom_names[kind], given, holds);
        assert_true(holds > 1.2);
        hair_test_near(groom_names[kind], 0, given / holds, 1, 0.012);
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
        assert_int_equal(f->report.stiffened, 1);
        assert_true(f->report.stiffest == (float)given);
        hair_test_near("given", 0, (double)f->rod[5].strain.w, hair_rod_stiffness(&shape, 5, given),
                       1e-6 * (double)f->rod[5].strain.w);
    }
    free(f);
}

// rho A g L^3 / E I at which a straight strand, clamped so far from down, buckles though its rest strain bears all of
// its weight. Upright it is Greenhill's.
static void straight_grooms_buckle_at_the_lengths_of_the_continuous_rod(void** state)
{
    (void)state;
    static const double known[][2] = {
        {45, 23.794}, {60, 16.568}, {90, 10.675}, {120, 8.610}, {180, 7.8373474389}};
    struct hair_test_rod* f = hair_test_rod_make();
    for (int i = 0; i < 5; ++i)
        for (int half = 0; half < 2; ++half) {
            double length = half ? 0.15 : 0.3, bend = hair_test_rod_bend(&f->physics);
            double gamma = 9.81 * length * length * length / bend;
            hair_test_rod_straight(f, 100, length, known[i][0] * PI / 180);
            struct hair_rod_shape shape = shape_of(f);
            double                given = hair_rod_stiffen(&shape), expected = 1.05 * gamma / known[i][1];
            if (expected < 1)
                assert_true(given == 1);
            else
                hair_test_near("buckles", (size_t)known[i][0], given / expected, 1, 0.012);
        }
    free(f);
}

// Farthest that a vertex's rest strain is from the strain of a straight groom, which is 0.
static double most_strain(const struct hair_test_rod* f)
{
    double most = 0;
    for (uint32_t i = 0; i < f->guide.count; ++i) {
        hair_vec4 u = f->rod[i].strain;
        most        = fmax(most, sqrt((double)(u.x * u.x + u.y * u.y + u.z * u.z)));
    }
    return most;
}

static void no_rest_strain_is_further_than_one_from_the_grooms(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    // Of three segments: it would be stable as it is, but turned too far at each vertex.
    hair_test_rod_straight(f, 4, 0.15, PI / 4);
    struct hair_rod_shape shape = shape_of(f);
    assert_true(hair_dlength(hair_rod_excess(&shape, 1, hair_rod_stiffness(&shape, 1, 1))) > 1);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.stiffened, 1);
    assert_true(f->report.stiffest > 1 && f->report.stiffest < 2);
    hair_test_near("of few segments", 0, most_strain(f), 0.995, 0.005);
    // Thread, for which no multiple is enough.
    f->physics.young = 1;
    hair_test_rod_straight(f, 32, 0.3, PI / 2);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.stiffened, 1);
    assert_true(f->report.stiffest == 1e4f);
    hair_test_near("thread", 0, most_strain(f), 1, 1e-6);
    // What does not resist at all is not asked to hold, nor made to.
    for (int k = 0; k < 2; ++k) {
        f->physics.young          = k == 0 ? 0 : 4e9f;
        f->physics.stiffness_root = k == 0 ? 1 : 0;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
        assert_int_equal(f->report.stiffened, 0);
        assert_true(f->report.stiffest == 1 && f->rod[0].strain.w == 0 && fabsf(f->rod[0].strain.z) < 1e-6f);
    }
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_bears_no_gravity_rests_in_the_grooms_own_strain),
        cmocka_unit_test(the_sign_of_a_frame_does_not_matter),
        cmocka_unit_test(the_rest_strain_of_a_held_groom_is_the_references),
        cmocka_unit_test(a_held_groom_is_in_equilibrium),
        cmocka_unit_test(a_guide_is_made_just_so_stiff_that_its_groom_is_stable),
        cmocka_unit_test(straight_grooms_buckle_at_the_lengths_of_the_continuous_rod),
        cmocka_unit_test(no_rest_strain_is_further_than_one_from_the_grooms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
