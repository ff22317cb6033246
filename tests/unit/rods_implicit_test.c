// rods_implicit_test.c - the implicit systems of rods, and the substeps that need none.
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/rods.h"

#define PI 3.141592653589793
#define MAX HAIR_MAX_GUIDE_VERTICES
#define STEP (1.0 / 240) // Seconds.

// Build diag(m A) + b^2 K of the written rods. K is the second derivatives of the energy k/2 |row
// x|^2 of every vertex.
static void build(const struct hair_test_rod* f, double b, double a[][MAX])
{
    uint32_t n = f->guide.count;
    int fixed = f->physics.root != HAIR_ROOT_FREE;
    double ratio = 1 / (double)f->physics.fiber.flatness;
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j) a[i][j] = 0;
    for (uint32_t i = 0; i + 1 < n; ++i) {
        double row[3] = {i > 0 ? 1 / (double)f->rod[i - 1].segment.x : 0, 0, 1 / (double)f->rod[i].segment.x};
        row[1] = -row[0] - row[2];
        for (uint32_t r = i > 0 ? 0 : 1; r < 3; ++r)
            for (uint32_t c = i > 0 ? 0 : 1; c < 3; ++c)
                a[i + r - 1][i + c - 1] += b * b * ratio * (double)f->rod[i].strain.w * row[r] * row[c];
    }
    for (uint32_t i = 0; i < n; ++i) {
        double pull = (double)f->rod[i].segment.z, damping = (double)f->physics.damping;
        if (i == 0 && fixed)
            for (uint32_t j = 0; j < n; ++j) a[0][j] = a[j][0] = j == 0;
        else
            a[i][i] += (1 + damping * b + pull * b * b) / (double)f->rod[i].segment.y;
    }
}

static void compare(const struct hair_test_rod* f, double a[][MAX], int euler)
{
    uint32_t n = f->guide.count;
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j) {
            double sum = 0;
            for (uint32_t k = 0; k <= i && k <= j; ++k) {
                hair_vec4 r = euler ? f->rod[k].factor_euler : f->rod[k].factor;
                double row[] = {1, (double)r.y, (double)r.z};
                if (i - k < 3 && j - k < 3) sum += row[i - k] * row[j - k] / (double)r.x;
            }
            hair_test_near(euler ? "euler" : "own", i * n + j, sum, a[i][j], 2e-6 * sqrt(a[i][i] * a[j][j]));
        }
}

static void factors_are_those_of_the_implicit_systems(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double(*a)[MAX] = calloc(MAX, sizeof *a);
    f->physics.fiber.flatness = 0.5f;
    f->physics.damping = 100;
    f->physics.tip_mass = 0.1f;
    static const uint32_t lengths[] = {2, 3, 20};
    for (int k = 0; k < 3; ++k)
        for (hair_root root = HAIR_ROOT_CLAMPED; root <= HAIR_ROOT_FREE; ++root) {
            double h = STEP;
            f->physics.root = root;
            hair_test_rod_curl(f, lengths[k], 0.005);
            hair_test_rod_write(f, HAIR_SOLVER_DIRECT, h);
            build(f, 2 * h / 3, a);
            compare(f, a, 0);
            build(f, h, a);
            compare(f, a, 1);
            hair_test_rod_write(f, HAIR_SOLVER_ACCURATE, h); // A substep with implicit bending.
            if (f->rod[0].segment.w == 1) {
                build(f, 2 * h / 3, a);
                compare(f, a, 0);
            }
            assert_true(f->rod[0].segment.w == 1 || lengths[k] < 20);
            build(f, h, a);
            compare(f, a, 1);
            hair_test_rod_write(f, HAIR_SOLVER_FOLLOW, h);
            // No segment is before the first, and none is after the tip.
            uint32_t tip = lengths[k] - 1;
            assert_true(f->rod[0].segment.w == 0 && f->rod[tip].segment.w == 0);
            for (uint32_t i = 1; i < tip; ++i) assert_true(f->rod[i].segment.w > 0);
        }
    free(a);
    free(f);
}

// Solve A x = r by the factors.
static void substitute(const struct hair_test_rod* f, double* x)
{
    uint32_t n = f->guide.count;
    for (uint32_t i = 0; i < n; ++i) {
        if (i > 0) x[i] -= (double)f->rod[i - 1].factor.y * x[i - 1];
        if (i > 1) x[i] -= (double)f->rod[i - 2].factor.z * x[i - 2];
    }
    for (uint32_t i = 0; i < n; ++i) x[i] *= (double)f->rod[i].factor.x;
    for (uint32_t i = n; i-- > 0;) {
        if (i + 1 < n) x[i] -= (double)f->rod[i].factor.y * x[i + 1];
        if (i + 2 < n) x[i] -= (double)f->rod[i].factor.z * x[i + 2];
    }
}

// Solve by this number of rounds of cyclic reduction, as a work group does.
static void reduce(const hair_vec4* row, uint32_t n, uint32_t rounds, double* x)
{
    double before[MAX + 2] = {0};
    for (uint32_t round = 0; round <= rounds; ++round) {
        uint32_t reach = round < rounds ? 2u << round : 0;
        if (reach >= n) continue;
        for (uint32_t i = 0; i < n; ++i) before[i] = x[i];
        for (uint32_t i = 0; i < n; ++i) {
            const hair_vec4* m = &row[round * n + i];
            uint32_t pair = i & ~1u;
            double sum = reach ? x[i] : 0;
            if (pair >= reach)
                sum += (double)m->x * before[pair - reach] + (double)m->y * before[pair + 1 - reach];
            if (reach && pair + reach < n)
                sum += (double)m->z * before[pair + reach] + (double)m->w * before[pair + 1 + reach];
            x[i] = sum;
        }
    }
}

// Check how much the reduction leaves out. For a free strand it may leave out nothing, because this
// would slow down rigid motion.
static void leave_out(hair_root root)
{
    static const uint32_t lengths[] = {2, 3, 20, 32, 65, 256};
    static const double steps[] = {1.0 / 120, 1.0 / 240, 1.0 / 480, 1.0 / 960};
    struct hair_test_rod* f = hair_test_rod_make();
    f->physics.shape.gravity_preload = 0;
    f->physics.root = root;
    for (int k = 0; k < 6; ++k) {
        uint32_t n = lengths[k], rounds[4], all = hair_rods_rounds(n) - 1;
        for (int s = 0; s < 4; ++s) {
            double x[MAX], y[MAX],
                off = 0, max = 0, heard = root == HAIR_ROOT_FREE ? 0 : 1e-4 * fmin(pow(240 * steps[s], 3), 1);
            hair_vec4 out[9 * MAX], last[9 * MAX];
            memset(out, 0, sizeof out);
            memset(last, 0, sizeof last);
            hair_test_rod_straight(f, n, 0.3, PI / 2);
            hair_test_rod_write(f, HAIR_SOLVER_DIRECT, steps[s]);
            rounds[s] = hair_rods_write_reduction(&f->guide, f->rod, n, steps[s], out, last);
            hair_rods_add_final_solve(&f->guide, 1, n, rounds[s], last, out);
            for (uint32_t i = 0; i < n;
                 // The right side is momenta. The impulses of displacements vary less from vertex
                 // to vertex.
                 ++i)
                x[i] = y[i] =
                    (double)f->rod[i].segment.y > 0 ? sin(0.3 * i) / (double)f->rod[i].segment.y : 0;
            substitute(f, x);
            reduce(out, n, rounds[s], y);
            for (uint32_t i = 0; i < n; ++i) {
                off = fmax(off, fabs(x[i] - y[i]));
                max = fmax(max, fabs(x[i]));
            }
            printf("%u vertices, 1/%.0f s: %u of %u rounds, off by %.1e, heard from %.1e on\n", n,
                   1 / steps[s], rounds[s], all, off / max, heard);
            assert_true(rounds[s] <= all);
            // The factor is for two blocks of two, on both sides.
            assert_true(off <= (4 * heard + 2e-6) * max);
        }
        assert_true(n < 20 || (rounds[3] < all) == (root != HAIR_ROOT_FREE));
    }
    free(f);
}

static void terms_dropped_by_cyclic_reduction_are_negligible(void** state)
{
    (void)state;
    leave_out(HAIR_ROOT_CLAMPED);
    leave_out(HAIR_ROOT_FREE);
}

// Return the highest frequency of m^-1 K, by the power method.
static double highest_frequency(const struct hair_test_rod* f, double a[][MAX])
{
    double x[MAX], y[MAX], highest = 0;
    uint32_t n = f->guide.count;
    for (uint32_t i = 0; i < n; ++i) x[i] = sin(3.0 * i * i);
    for (int k = 0; k < 2000; ++k) {
        double size = 0;
        for (uint32_t i = 1; i < n; ++i) {
            y[i] = 0;
            for (uint32_t j = 1; j < n; ++j) y[i] += a[i][j] * x[j] * (double)f->rod[i].segment.y;
            size = fmax(size, fabs(y[i]));
        }
        for (uint32_t i = 1; i < n; ++i) x[i] = y[i] / size;
        highest = sqrt(size);
    }
    return highest;
}

// Check the substep. Leapfrog is stable if the substep times the highest frequency is below 2.
static void the_substep_of_the_accurate_solver_is_stable(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double(*a)[MAX] = calloc(MAX, sizeof *a);
    f->physics.shape.gravity_preload = f->physics.damping = f->physics.shape.frequency_root =
        f->physics.shape.frequency_tip = 0;
    for (uint32_t count = 4; count <= 100; count += 8) {
        hair_test_rod_straight(f, count, 0.3, PI / 2);
        double h = hair_test_rod_substep(f, HAIR_SOLVER_ACCURATE),
               formula = 1.15 * pow(count - 1, 2) / 30 * sqrt(hair_test_rod_bend(&f->physics)) / 0.09;
        hair_test_rod_write(f, HAIR_SOLVER_ACCURATE, h);
        build(f, 1, a);
        for (uint32_t i = 1; i < count; ++i) a[i][i] -= 1 / (double)f->rod[i].segment.y;
        double highest = highest_frequency(f, a);
        printf("%u vertices: %.0f a frame, by the formula %.1f; h w / 2 = %.3f\n", count, 1 / (60 * h),
               formula, h * highest / 2);
        // In the parts of a whip explicit bending is stable by a wide margin.
        double part = (double)f->rod[1].segment.w, phase = part * h * highest;
        assert_true(0 < part && part <= 1 && phase < 0.9 && (phase > 0.4 || part == 1));
        if (formula <= 96) {
            hair_test_near("a frame", count, 1 / (60 * h), fmax(18, ceil(formula)), 2.01);
            assert_true(f->rod[0].segment.w == 0 && f->rod[1].factor.x == 0);
            assert_true(h * highest < 2);
        }
        if (formula > 106) {
            assert_true(h == hair_test_rod_substep(f, HAIR_SOLVER_ACCURATE));
            assert_true(f->rod[count - 1].segment.w == 1 && f->rod[1].factor.x > 0);
            hair_test_near("a frame", count, 1 / (60 * h), 18, 1e-9);
        }
    }
    // Fine hair that would need very short parts takes none.
    hair_test_rod_straight(f, 100, 0.1, PI / 2);
    hair_test_rod_write(f, HAIR_SOLVER_ACCURATE, 1.0 / 1080);
    assert_true(f->rod[0].segment.w == 1 && f->rod[1].segment.w == 0);
    // A strand stiffened by gravity preload needs an even shorter substep.
    hair_test_rod_straight(f, 40, 0.3, PI / 2);
    double before = hair_test_rod_substep(f, HAIR_SOLVER_ACCURATE);
    f->physics.shape.gravity_preload = 1;
    assert_true(hair_test_rod_substep(f, HAIR_SOLVER_ACCURATE) < before / 1.7);
    hair_test_near("follow", 0, hair_test_rod_substep(f, HAIR_SOLVER_FOLLOW), 1.0 / 120, 1e-12);
    hair_test_near("redblack", 0, hair_test_rod_substep(f, HAIR_SOLVER_REDBLACK), 1.0 / 120, 1e-12);
    free(a);
    free(f);
}

// Check the substeps of direct for straight guides, and the scheme that solves long ones.
static void long_straight_guides_take_shorter_substeps_until_something_holds_them(void** state)
{
    (void)state;
    const uint32_t counts[] = {2, 32, 33, 64, 100, 256};
    const double per_frame[] = {4, 4, 5, 8, 13, 32};
    struct hair_test_rod* f = hair_test_rod_make();
    for (int k = 0; k < 6; ++k) {
        double own = 1 / (60 * per_frame[k]);
        bool is_long = counts[k] > 32;
        hair_test_rod_straight(f, counts[k], 0.3, PI / 2);
        f->physics.shape.gravity_preload = 0; // Rest strain would make the guide a curved one.
        f->physics.fiber.radius = 1e-5f; // Segments of a thicker fiber would be too short.
        hair_test_near("direct", k, hair_test_rod_substep(f, HAIR_SOLVER_DIRECT), own, 1e-12);
        assert_false(hair_test_rod_is_mixed(f, HAIR_SOLVER_DIRECT, false, 0));
        assert_false(hair_test_rod_is_mixed(f, HAIR_SOLVER_DIRECT, false, own));
        assert_int_equal(hair_test_rod_is_mixed(f, HAIR_SOLVER_DIRECT, true, 0), is_long);
        assert_int_equal(hair_test_rod_is_mixed(f, HAIR_SOLVER_DIRECT, false, 1.01 * own), is_long);
        assert_false(hair_test_rod_is_mixed(f, HAIR_SOLVER_ACCURATE, true, 0));
        assert_int_equal(hair_rods_are_long(&f->guide, 1), is_long);
    }
    free(f);
}

// Solve A x = b in single precision as the shader does, forward along the strand and back.
static void solve(const struct hair_test_rod* f, float* x)
{
    uint32_t n = f->guide.count;
    float one = 0, two = 0, below = 0, below_two = 0;
    for (uint32_t i = 0; i < n; ++i) {
        hair_vec4 r = f->rod[i].factor;
        x[i] -= one;
        one = two + r.y * x[i];
        two = r.z * x[i];
        x[i] *= r.x;
    }
    for (uint32_t i = n; i-- > 0;) {
        x[i] -= f->rod[i].factor.y * below + f->rod[i].factor.z * below_two;
        below_two = below;
        below = x[i];
    }
}

// Make a straight strand of the maximum stiffness, without other forces.
static void make_stiff(struct hair_test_rod* f, hair_root root, uint32_t count, double length)
{
    f->physics.damping = f->physics.shape.frequency_root = f->physics.shape.frequency_tip =
        f->physics.shape.gravity_preload = 0;
    f->physics.root = root;
    f->physics.fiber.youngs_modulus = 1e12f;
    hair_test_rod_straight(f, count, length, PI / 2);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
}

// Check a push that rotates the whole strand about its root, at any stiffness.
static void a_solve_in_single_precision_is_good_at_any_stiffness(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double worst = 0;
    for (int e = 0; e < 6; ++e)
        for (uint32_t count = 4; count <= 256; count *= 4) {
            float x[MAX] = {0};
            make_stiff(f, HAIR_ROOT_HINGED, count, pow(10, -e));
            for (uint32_t i = 1; i < count; ++i) x[i] = (float)i / (float)(count - 1) / f->rod[i].segment.y;
            solve(f, x);
            for (uint32_t i = 0; i < count; ++i) worst = fmax(worst, fabs((double)x[i] - i / (count - 1.0)));
        }
    printf("off by %.1e\n", worst);
    assert_true(worst < 3e-5);
    free(f);
}

// Check vertices half a radian from rest. The forces sum to 0 except for rounding, and move the
// centre of a free strand by a small fraction of a segment.
static void stiffness_is_limited_to_single_precision(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double(*a)[MAX] = calloc(MAX, sizeof *a);
    double worst = 0;
    for (int e = 0; e < 6; ++e)
        for (uint32_t count = 4; count <= 256; count *= 4) {
            float lever[MAX + 1] = {0}, x[MAX];
            make_stiff(f, HAIR_ROOT_FREE, count, pow(10, -e));
            build(f, STEP, a);
            for (uint32_t i = 0; i < count; ++i) assert_true(a[i][i] * (double)f->rod[i].segment.y < 1.6e4);
            // The limit is no lower than necessary.
            if (e > 2) assert_true(a[1][1] * (double)f->rod[1].segment.y > 1e3);
            for (uint32_t i = 1; i + 1 < count; ++i)
                lever[i] = f->rod[i].strain.w * 0.5f * (float)sin(9.0 * i * i);
            double moved = 0, mass = 0;
            for (uint32_t i = 0; i < count; ++i) {
                float force = i + 1 < count ? (lever[i] - lever[i + 1]) / f->rod[i].segment.x : 0;
                if (i > 0) force -= (lever[i - 1] - lever[i]) / f->rod[i - 1].segment.x;
                x[i] = force * (float)(4 * STEP * STEP / 9);
            }
            solve(f, x);
            for (uint32_t i = 0; i < count; ++i) {
                moved += (double)(x[i] / f->rod[i].segment.y);
                mass += 1 / (double)f->rod[i].segment.y;
            }
            worst = fmax(worst, fabs(moved / mass) / (double)f->rod[0].segment.x);
        }
    // The mass of a short segment at a free root is half of its own.
    float bent[] = {0, 0, 0, 1e-4f, 0, 0, 2e-3f, 0, 0, 4e-3f, 0, 0};
    hair_test_rod_place(f, 4, bent);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, STEP);
    build(f, STEP, a);
    assert_true(a[0][0] * (double)f->rod[0].segment.y < 1.6e4);
    printf("moved by %.1e of a segment\n", worst);
    assert_true(worst < 2e-4);
    free(a);
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_are_those_of_the_implicit_systems),
        cmocka_unit_test(terms_dropped_by_cyclic_reduction_are_negligible),
        cmocka_unit_test(the_substep_of_the_accurate_solver_is_stable),
        cmocka_unit_test(long_straight_guides_take_shorter_substeps_until_something_holds_them),
        cmocka_unit_test(a_solve_in_single_precision_is_good_at_any_stiffness),
        cmocka_unit_test(stiffness_is_limited_to_single_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
