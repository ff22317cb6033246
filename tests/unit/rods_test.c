// rods_test.c - guides as rods: masses, stiffness and sections are finite, and made again when
// necessary.
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/reference/rod.h"
#include "tests/support/rods.h"

#define PI 3.141592653589793
#define MAX HAIR_MAX_GUIDE_VERTICES
#define STEP (1.0 / 240) // Seconds.

static void vertex_mass_is_half_of_each_segment_plus_tip_mass(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    f->physics.tip_mass = 2;
    hair_test_rod_curl(f, 9, 0.01);
    for (hair_root root = HAIR_ROOT_CLAMPED; root <= HAIR_ROOT_FREE; ++root) {
        double all = 0, length = 0;
        f->physics.root = root;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
        for (uint32_t i = 0; i < 9; ++i) {
            double before = i > 0 ? (double)f->rest[i - 1].position.w : 0,
                   after = (double)f->rest[i].position.w;
            length += after;
            assert_true(f->rod[i].segment.x == f->rest[i].position.w);
            if (i == 0 && root != HAIR_ROOT_FREE) {
                assert_true(f->rod[0].segment.y == 0);
                all += after / 2;
                continue;
            }
            all += 1 / (double)f->rod[i].segment.y;
            if (i < 8) hair_test_near("mass", i, 1 / (double)f->rod[i].segment.y, (before + after) / 2, 1e-8);
        }
        hair_test_near("all", 0, all, 3 * length, 1e-7);
    }
    free(f);
}

// Check the inertia added under a heavy tip. The highest frequency of transverse oscillation under
// the tip's weight is at most 2.7 / b. Inertia is added only if this needs it, and is small
// relative to the tip's.
static void strand_with_a_heavy_tip_has_added_inertia(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    f->physics.shape.gravity_preload = 0;
    hair_test_rod_straight(f, 32, 0.31, PI / 2);
    for (int k = 0; k < 4; ++k) {
        const float masses[] = {0, 10, 100, 1000};
        double added = 0, highest = 0, l = 0.01, tip = 0.005 + 0.31 * (double)masses[k];
        f->physics.tip_mass = masses[k];
        double h = hair_test_rod_substep(f, HAIR_SOLVER_DIRECT), b = 2 * h / 3;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, h);
        for (uint32_t i = 1; i < 31; ++i) {
            double mass = 1 / (double)f->rod[i].segment.y, below = tip + (30 - i) * l;
            added += mass - l;
            highest = fmax(highest, sqrt(2 * 9.81 * (2 * below + l) / l / mass));
            assert_true(mass > 0.9999 * l);
        }
        printf("tip of %g: %.0f substeps a frame, w b %.2f, added %.2g of the tip\n", (double)masses[k],
               1 / (60 * h), b * highest, added / tip);
        hair_test_near("tip", k, 1 / (double)f->rod[31].segment.y, tip, 1e-5 * tip);
        assert_true(b * highest < 2.8 && added < 0.02 * tip);
        assert_true(masses[k] > 10 || added < 1e-5);
        hair_test_rod_write(f, HAIR_SOLVER_ACCURATE, hair_test_rod_substep(f, HAIR_SOLVER_ACCURATE));
        assert_true((f->rod[0].segment.w == 2) == (masses[k] > 10));
    }
    free(f);
}

static void shape_frequency_is_linear_from_root_to_tip(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    hair_test_rod_straight(f, 5, 0.1, 0);
    f->physics.shape.frequency_root = 5;
    f->physics.shape.frequency_tip = 1;
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
    for (uint32_t i = 0; i < 5; ++i)
        hair_test_near("pull", i, (double)f->rod[i].segment.z, pow(2 * PI * (5 - i), 2), 1e-4);
    free(f);
}

// Check an elliptic section with half axes a >= b about its centre. The second moments are pi a b^3
// / 4 and pi a^3 b / 4. The torsion constant is pi a^3 b^3 / (a^2 + b^2). The shear modulus is E /
// (2 (1 + nu)).
static void stiffness_ratios_are_those_of_an_ellipse(void** state)
{
    (void)state;
    hair_physics p = hair_physics_default();
    double ratio[3];
    for (int i = 1; i <= 10; ++i) {
        p.fiber.flatness = 0.1f * (float)i;
        double a = 1 / sqrt((double)p.fiber.flatness), b = 1 / a;
        hair_rods_ratios(&p, ratio);
        hair_test_near("about x", i, ratio[0], a * b * b * b, 1e-12);
        hair_test_near("about z", i, ratio[2], a * a * a * b, 1e-12);
        hair_test_near(
            "twist", i, ratio[1],
            4 * a * a * a * b * b * b / (a * a + b * b) / (2 * (1 + (double)p.fiber.poisson_ratio)), 1e-12);
    }
    hair_test_near("of hair", 0, ratio[1], 0.68966, 1e-5);
}

static void stiffness_is_per_length_and_tapers(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    f->physics.shape.stiffness_root = 2;
    f->physics.shape.stiffness_tip = 0.5f;
    f->physics.shape.gravity_preload = 0;
    hair_test_rod_curl(f, 12, 0.01);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
    double bend = hair_test_rod_bend(&f->physics), so_far = 0, weight = 0;
    for (uint32_t i = 1; i < 12; ++i) weight += 9.81 / (double)f->rod[i].segment.y;
    for (uint32_t i = 0; i + 1 < 12; ++i) {
        double before = i > 0 ? (double)f->rest[i - 1].position.w : 0, after = (double)f->rest[i].position.w;
        double own = bend * (2 - 1.5 * so_far / (double)f->guide.arc_length);
        so_far += after;
        double expected = i > 0 ? own / ((before + after) / 2)
                                : hair_reference_rod_clamp_factor(after, weight, own) * own / after;
        hair_test_near("stiffness", i, (double)f->rod[i].strain.w / expected, 1, 1e-6);
    }
    assert_true(f->rod[11].strain.w == 0);
    f->physics.root = HAIR_ROOT_HINGED;
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
    assert_true(f->rod[0].strain.w == 0 && f->rod[1].strain.w > 0);
    free(f);
}

// Check the stiffness about the axes of an elliptic section in the mixed scheme. The weight on the
// clamp makes the clamp stiffer against bending, but not against twist.
static void clamp_resists_twist_as_half_a_segment_does(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    f->physics.shape.gravity_preload = 0;
    f->physics.fiber.flatness = 0.5f;
    hair_test_rod_curl(f, 12, 0.01);
    hair_test_rod_hold(f);
    hair_rods_write(&f->guide, f->rest, f->borne, &f->physics, HAIR_SOLVER_DIRECT, 1, STEP, f->rod);
    double bend = hair_test_rod_bend(&f->physics), weight = 0, ratio[3],
           length = (double)f->rest[0].position.w;
    hair_rods_ratios(&f->physics, ratio);
    for (uint32_t i = 1; i < 12; ++i) weight += 9.81 / (double)f->rod[i].segment.y;
    const hair_vec4 clamp = f->rod[0].factor_euler;
    const double own[3] = {(double)clamp.x, (double)clamp.y, (double)clamp.z},
                 across[3] = {ratio[0] * bend, 0, ratio[2] * bend};
    for (int k = 0; k < 3; ++k) {
        double expected = k == 1 ? 2 * ratio[1] * bend
                                 : hair_reference_rod_clamp_factor(length, weight, across[k]) * across[k];
        hair_test_near("clamp", k, own[k] * (double)f->rod[0].strain.w * length / expected, 1, 1e-6);
    }
    assert_true(own[1] < 0.99 * ratio[1]);
    for (uint32_t i = 1; i < 12; ++i) {
        hair_test_near("about x", i, (double)f->rod[i].factor_euler.x, ratio[0], 1e-6);
        hair_test_near("twist", i, (double)f->rod[i].factor_euler.y, ratio[1], 1e-6);
        hair_test_near("about z", i, (double)f->rod[i].factor_euler.z, ratio[2], 1e-6);
    }
    free(f);
}

static float within(uint32_t* random, double min, double max)
{
    double t = (double)hair_random(random);
    if (t < 0.2) return (float)min;
    if (t > 0.8) return (float)max;
    if (min > 0) return (float)(min * pow(max / min, (t - 0.2) / 0.6));
    return (float)(min + (max - min) * pow((t - 0.2) / 0.6, 9));
}

static void rods_of_any_settings_are_finite(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    uint32_t random = 7;
    for (int run = 0; run < 3000; ++run) {
        hair_physics* p = &f->physics;
        p->fiber.youngs_modulus = within(&random, 0, 1e12);
        p->fiber.poisson_ratio = within(&random, 0, 0.5);
        p->fiber.radius = within(&random, 1e-6, 1e-3);
        p->fiber.density = within(&random, 1, 1e5);
        p->fiber.flatness = within(&random, 0.03, 1);
        p->shape.stiffness_root = within(&random, 0, 1e4);
        p->shape.stiffness_tip = within(&random, 0, 1e4);
        p->shape.gravity_preload = within(&random, 0, 1);
        p->root = (hair_root)(run % 3);
        p->tip_mass = within(&random, 0, 1e4);
        p->damping = within(&random, 0, 1000);
        p->shape.frequency_root = within(&random, 0, 30);
        p->shape.frequency_tip = within(&random, 0, 30);
        for (int k = 0; k < 3; ++k)
            p->gravity[k] = within(&random, 0, 1000) * (hair_random(&random) < 0.5f ? -1 : 1);
        float at[3 * MAX] = {0}, size = within(&random, 1e-9, 1e4);
        uint32_t count = 2 + (uint32_t)(hair_random(&random) * 40);
        for (uint32_t i = 0; i < 3 * count; ++i) {
            float far = run % 4 ? size : within(&random, 1e-9, 1e4);
            // Otherwise to and fro, with folds.
            float forward = (float)(i % 3 == 0) * (run % 2 ? 1 : 0);
            at[i] = (i < 3 ? 0 : at[i - 3]) + far * (forward + (run % 5 ? hair_random(&random) - 0.5f : 0));
        }
        hair_test_rod_place(f, count, at);
        // A segment without a direction.
        if (run % 7 == 0) f->rest[count / 2].position = f->rest[0].position;
        hair_solver solver = (hair_solver)(run % 4);
        double h = hair_test_rod_substep(f, solver);
        if (hair_random(&random) < 0.5f) h = (double)within(&random, 1e-5, 0.1);
        assert_true(h > 9.9e-6 && h < 0.101);
        hair_test_rod_write(f, solver, h);
        const float* number = &f->rod[0].strain.x;
        for (uint32_t i = 0; i < count * 16; ++i)
            if (!isfinite(number[i]))
                fail_msg("run %d: number %u of vertex %u is %g", run, i % 16, i / 16, (double)number[i]);
        for (uint32_t i = 0; i < count && solver != HAIR_SOLVER_FOLLOW;
             // This solver has numbers of its own.
             ++i) {
            hair_vec4 u = f->rod[i].strain;
            assert_true(u.w >= 0 && u.x * u.x + u.y * u.y + u.z * u.z < 3.1f * 3.1f);
            assert_true(f->rod[i].factor_euler.x > 0);
        }
        assert_true(f->report.stiffest >= 1 && f->report.stiffest <= 3 && isfinite(f->report.farthest_sag));
    }
    free(f);
}

static void guides_are_written_in_order_and_counted(void** state)
{
    (void)state;
    struct hair_test_rod* short_one = hair_test_rod_make();
    struct hair_test_rod* long_one = hair_test_rod_make();
    hair_test_rod_straight(short_one, 5, 0.01, PI / 2);
    hair_test_rod_straight(long_one, 32, 0.3, PI / 2);
    hair_test_rod_write(short_one, HAIR_SOLVER_ACCURATE, 1e-3);
    hair_test_rod_write(long_one, HAIR_SOLVER_ACCURATE, 1e-3);
    struct hair_guide guides[3] = {short_one->guide, long_one->guide, short_one->guide};
    struct hair_rest rest[42];
    struct hair_rod rod[42];
    struct hair_rod_borne borne[42];
    struct hair_rods_report report;
    guides[1].first = 5;
    guides[2].first = 37;
    memcpy(rest, short_one->rest, 5 * sizeof *rest);
    memcpy(rest + 5, long_one->rest, 32 * sizeof *rest);
    memcpy(rest + 37, short_one->rest, 5 * sizeof *rest);
    assert_int_equal(hair_rods_preload_gravity(NULL, guides, rest, 3, &short_one->physics, borne, &report),
                     HAIR_OK);
    for (int i = 0; i < 3; ++i)
        hair_rods_write(&guides[i], rest, borne, &short_one->physics, HAIR_SOLVER_ACCURATE, 0, 1e-3,
                        rod + guides[i].first);
    assert_memory_equal(rod, short_one->rod, 5 * sizeof *rod);
    assert_memory_equal(rod + 5, long_one->rod, 32 * sizeof *rod);
    assert_memory_equal(rod + 37, short_one->rod, 5 * sizeof *rod);
    assert_int_equal(report.stiffened, 1);
    assert_int_equal(report.sagging, 1);
    assert_true(report.stiffest == long_one->report.stiffest && report.stiffest > 2.9f);
    assert_true(report.farthest_sag == long_one->report.farthest_sag && report.farthest_sag > 0.01f);
    // The stiff, short guides become implicit, so that the others need not use short substeps.
    double h = hair_rods_substep(guides, rest, borne, 3, &short_one->physics, HAIR_SOLVER_ACCURATE, 0);
    assert_true(hair_test_rod_substep(long_one, HAIR_SOLVER_ACCURATE) == h);
    free(short_one);
    free(long_one);
}

static void rods_are_rebuilt_only_when_their_numbers_change(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    const hair_physics d = hair_physics_default();
    float* in[] = {&f->physics.gravity[0],
                   &f->physics.gravity[1],
                   &f->physics.gravity[2],
                   &f->physics.damping,
                   &f->physics.shape.frequency_root,
                   &f->physics.shape.frequency_tip,
                   &f->physics.fiber.youngs_modulus,
                   &f->physics.fiber.poisson_ratio,
                   &f->physics.fiber.radius,
                   &f->physics.fiber.density,
                   &f->physics.fiber.flatness,
                   &f->physics.shape.stiffness_root,
                   &f->physics.shape.stiffness_tip,
                   &f->physics.shape.gravity_preload,
                   &f->physics.tip_mass};
    float* out[] = {&f->physics.redblack.angular_hz, &f->physics.redblack.bend, &f->physics.collision.margin,
                    &f->physics.drag, &f->physics.collision.friction};
    hair_test_rod_curl(f, 20, 0.01);
    f->physics = d;
    assert_false(hair_rods_differ(&f->physics, &d));
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
    struct hair_rod before[20];
    memcpy(before, f->rod, sizeof before);
    for (size_t i = 0; i < sizeof in / sizeof *in + sizeof out / sizeof *out; ++i) {
        int inside = i < sizeof in / sizeof *in;
        float* field = inside ? in[i] : out[i - sizeof in / sizeof *in];
        f->physics = d;
        *field = *field * 0.7f + 0.01f;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
        assert_int_equal(hair_rods_differ(&f->physics, &d), inside);
        assert_int_equal(hair_rods_differ(&d, &f->physics), inside);
        assert_int_equal(memcmp(before, f->rod, sizeof before) != 0, inside);
    }
    f->physics = d;
    f->physics.root = HAIR_ROOT_FREE;
    assert_true(hair_rods_differ(&f->physics, &d));
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertex_mass_is_half_of_each_segment_plus_tip_mass),
        cmocka_unit_test(strand_with_a_heavy_tip_has_added_inertia),
        cmocka_unit_test(shape_frequency_is_linear_from_root_to_tip),
        cmocka_unit_test(stiffness_ratios_are_those_of_an_ellipse),
        cmocka_unit_test(stiffness_is_per_length_and_tapers),
        cmocka_unit_test(clamp_resists_twist_as_half_a_segment_does),
        cmocka_unit_test(rods_of_any_settings_are_finite),
        cmocka_unit_test(guides_are_written_in_order_and_counted),
        cmocka_unit_test(rods_are_rebuilt_only_when_their_numbers_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
