// rod_contact_test.c - strands as rods and colliders: at rest on them, sliding, held by friction,
// carried, swept, and freed.
#include "tests/support/live_hair.h"

#include <math.h>
#include <string.h>

#define STRIKING 8
#define STRIKING_FRAMES 24
#define SOLVERS HAIR_SOLVER_REDBLACK // The number of solvers before redblack.
#define MARGIN 1e-3

static hair_collider sphere(double x, double y, double z, double radius)
{
    return (hair_collider){HAIR_SHAPE_SPHERE, {(float)x, (float)y, (float)z},
                           {0, 0, 0, 1},      {(float)radius, 0},
                           .scale = 1,        .friction = 1};
}

// Return a capsule with its axis along z, rotated by `angle` about it.
static hair_collider capsule(double x, double y, double radius, double angle)
{
    double h = sqrt(0.5), c = cos(angle / 2), s = sin(angle / 2);
    hair_collider collider = {HAIR_SHAPE_CAPSULE,
                              {(float)x, (float)y, 0},
                              {(float)(h * c), (float)(h * s), (float)(h * s), (float)(h * c)},
                              {(float)radius, 0.5f},
                              .scale = 1,
                              .friction = 1};
    return collider;
}

// Return the maximum depth of a vertex in a collider or its margin.
static double depth(const struct hair_test_living* living, const hair_collider* collider)
{
    return hair_test_depth(living, collider) + MARGIN;
}

// Lay a strand of 0.25 m over a collider, with its root above and to the side, and wait for
// `seconds`.
static void lay(struct hair_test* test, hair_solver solver, const hair_physics* physics,
                const hair_collider* over, uint32_t seconds, struct hair_test_living* out)
{
    struct hair_test_strands strands =
        hair_test_straight(32, hair_v3(-0.03f, 0.056f, 0), hair_v3(1, 0, 0.1f), 0.25f);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_set_colliders(out, over, 1);
    for (uint32_t k = 0; k < 60 * seconds; ++k) {
        hair_test_wait(out, 1);
        hair_test_read_guides(out);
        assert_true(depth(out, over) < 1e-5);
        if (k > 60) assert_true(hair_test_stretch(out) < 1e-3);
    }
    hair_test_strands_free(&strands);
}

static void strand_over_a_collider_stays_outside_without_creep(void** state)
{
    hair_physics physics = hair_test_loose(0.5f);
    physics.damping = 10;
    for (int kind = 0; kind < 2; ++kind)
        for (int solver = 0; solver < 2; ++solver) {
            hair_collider collider = kind ? capsule(0.02, 0, 0.05, 0) : sphere(0.02, 0, 0, 0.05);
            struct hair_test_living living;
            lay(*state, (hair_solver)solver, &physics, &collider, 8, &living);
            assert_true(hair_test_tip(&living, 0).x > 0.06f); // The strand lies over the top.
            assert_true(depth(&living, &collider) > -1e-5);
            hair_test_wait(&living, 600);
            hair_test_read_guides(&living);
            print_message("    %s, solver %d: %.2g m in 10 s, stretch %.2g\n", kind ? "capsule" : "sphere",
                          solver, hair_test_moved(&living), hair_test_stretch(&living));
            assert_true(hair_test_moved(&living) < 1e-5);
            assert_true(depth(&living, &collider) < 1e-5);
            hair_test_die(&living);
        }
}

static void strand_without_friction_slides_off_a_collider(void** state)
{
    hair_physics physics = hair_test_loose(0);
    for (int solver = 0; solver < 2; ++solver) {
        hair_collider collider = sphere(0.02, 0, 0, 0.05);
        struct hair_test_living living;
        lay(*state, (hair_solver)solver, &physics, &collider, 4, &living);
        assert_true(hair_test_tip(&living, 0).x < 0);
        hair_test_die(&living);
    }
}

// Check a free strand along a capsule of 5 m, at a slope of half a radian. It either sticks, or
// slides as a bead on a circle: R a'' = g (sin a - mu cos a) + mu R a'^2. R is the radius, a the
// angle from the top, mu the coefficient of friction, and g gravity.
static void strand_on_a_slope_obeys_coulombs_law(void** state)
{
    static const double mu[] = {0, 0.3, 0.5, 0.6}; // tan 0.5 = 0.546
    for (int kind = 0; kind < 4 * SOLVERS; ++kind) {
        double friction = mu[kind % 4], radius = friction > 0.55 ? 1 : 5, start = 0.5, a = start, w = 0;
        int solver = kind / 4;
        hair_physics physics = hair_test_loose((float)friction);
        physics.root = HAIR_ROOT_FREE;
        physics.damping = 0;
        struct hair_test_strands strands = hair_test_straight(5, hair_v3(0, 0, 0), hair_v3(0, 0, 1), 0.04f);
        struct hair_test_living living;
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_collider collider =
            capsule(-(radius + MARGIN) * sin(start), -(radius + MARGIN) * cos(start), radius, 0);
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_set_colliders(&living, &collider, 1);
        hair_test_wait(&living, 30);
        hair_test_read_guides(&living);
        for (int i = 0; i < 50000 && friction < 0.55; ++i) {
            w += 1e-5 * (9.81 * (sin(a) - friction * cos(a)) / radius + friction * w * w);
            a += 1e-5 * w;
        }
        hair_vec3 p = hair_test_at(&living, 0, 2);
        double slid =
            atan2((double)(p.x - collider.position[0]), (double)(p.y - collider.position[1])) - start;
        print_message("    solver %d, friction %g: slides %.4f m of %.4f m\n", solver, friction,
                      radius * slid, radius * (a - start));
        if (friction > 0.55)
            assert_true(fabs(slid) * radius < 2e-6);
        else
            assert_true(fabs(slid / (a - start) - 1) < (solver == HAIR_SOLVER_FOLLOW ? 0.03 : 0.01));
        assert_true(depth(&living, &collider) < 1e-5);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

static void moving_and_spinning_colliders_carry_hair_along(void** state)
{
    hair_physics physics = hair_test_loose(0.8f);
    physics.root = HAIR_ROOT_FREE;
    physics.damping = 0;
    for (int kind = 0; kind < 2 * SOLVERS; ++kind) {
        int spins = kind % 2, solver = kind / 2;
        struct hair_test_strands strands = hair_test_straight(5, hair_v3(0, 0, 0), hair_v3(0, 0, 1), 0.04f);
        struct hair_test_living living;
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_collider collider = capsule(0, -1 - MARGIN, 1, 0);
        double way = 0;
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_set_colliders(&living, &collider, 1);
        hair_test_wait(&living, 10);
        for (int k = 1; k <= 30; ++k) {
            way += 0.2 * fmin(k / 10.0, 1) / 60;
            collider = spins ? capsule(0, -1 - MARGIN, 1, -way) : capsule(way, -1 - MARGIN, 1, 0);
            hair_test_set_colliders(&living, &collider, 1);
            hair_test_wait(&living, 1);
        }
        hair_test_read_guides(&living);
        double carried = (double)hair_test_at(&living, 0, 2).x, expected = spins ? sin(way) : way;
        print_message("    solver %d: carried %.5f m of %.5f m\n", solver, carried, expected);
        assert_true(fabs(carried / expected - 1) < 0.01);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

// Return the angle by which a strand winds around the point (x, y), seen along z. It is negative
// while the strand lies to the right.
static double winding(const struct hair_test_living* living, double x, double y)
{
    double sum = 0;
    for (uint32_t i = 0; i + 1 < living->vertices; ++i) {
        hair_vec3 p = hair_test_at(living, 0, i), q = hair_test_at(living, 0, i + 1);
        double a = (double)p.x - x, b = (double)p.y - y, c = (double)q.x - x, d = (double)q.y - y;
        sum += atan2(a * d - b * c, a * c + b * d);
    }
    return sum;
}

// Sweep a collider from left to right through a hanging strand. The strand must be pushed along and
// never be left behind.
static void collider_swept_through_hair_takes_it_along(void** state)
{
    static const struct {
        double radius, speed;
        int is_capsule, solvers;
    } cases[] = {{0.05, 2, 0, 3}, {0.05, 5, 0, 3}, {0.02, 2, 1, 2}};
    hair_physics physics = hair_test_loose(0.3f);
    for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n)
        for (int solver = 0; solver < cases[n].solvers; ++solver) {
            struct hair_test_strands strands =
                hair_test_straight(32, hair_v3(0, 0, 0), hair_v3(0, -1, 0), 0.3f);
            struct hair_test_living living;
            hair_desc desc =
                hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
            double r = cases[n].radius, x = -0.3, deepest = -INFINITY;
            hair_test_live(*state, &strands, &desc, &living);
            for (; x < 0.2; x += cases[n].speed / 60) {
                hair_collider collider =
                    cases[n].is_capsule ? capsule(x, -0.15, r, 0) : sphere(x, -0.15, 0, r);
                hair_test_set_colliders(&living, &collider, 1);
                hair_test_wait(&living, 1);
                hair_test_read_guides(&living);
                deepest = fmax(deepest, depth(&living, &collider) - MARGIN);
                assert_true(winding(&living, x, -0.15) < 0);
            }
            print_message("    radius %g m, %g m/s, solver %d: up to %.2g m deep\n", r, cases[n].speed,
                          solver, deepest);
            assert_true(deepest < 0.1 * r);
            hair_test_die(&living);
            hair_test_strands_free(&strands);
        }
}

static void hair_leaves_a_collider_that_appears_slowly(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_strands strands =
            hair_test_straight(32, hair_v3(0, 0, 0), hair_v3(0, -1, 0.05f), 0.3f);
        struct hair_test_living living;
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_collider collider = sphere(0.01, -0.15, 0, 0.06);
        double speed = 0;
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        hair_test_set_colliders(&living, &collider, 1);
        for (int k = 0; k < 60; ++k) {
            hair_test_wait(&living, 1);
            hair_test_read_guides(&living);
            speed = fmax(speed, 60 * hair_test_moved(&living));
            assert_true(hair_test_stretch(&living) < 0.01);
        }
        print_message("    solver %d: up to %.2g m/s\n", solver, speed);
        assert_true(speed < 5);
        assert_true(depth(&living, &collider) < 1e-5);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

static void free_strand_comes_to_rest_on_a_collider(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    physics.root = HAIR_ROOT_FREE;
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_strands strands = hair_test_straight(8, hair_v3(0, 0, 0), hair_v3(1, 0, 0.1f), 0.1f);
        struct hair_test_living living;
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_collider collider = sphere(0, -12, 0, 10);
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_set_colliders(&living, &collider, 1);
        hair_test_wait(&living, 180);
        hair_test_read_guides(&living);
        assert_true(depth(&living, &collider) < 1e-4);
        assert_true(depth(&living, &collider) > -1e-3);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

static void hair_stays_out_of_64_colliders_with_equal_bits(void** state)
{
    hair_collider colliders[HAIR_STEP_COLLIDERS];
    hair_physics physics = hair_test_loose(0.3f);
    for (int i = 0; i < HAIR_STEP_COLLIDERS; ++i) {
        double row = i / 8;
        colliders[i] = sphere(-0.2 + 0.055 * (i % 8), -0.05 - 0.02 * (i % 3), -0.2 + 0.05 * row,
                              0.015 + 0.004 * (i % 4));
    }
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living[2];
        for (int run = 0; run < 2; ++run) {
            struct hair_test_strands strands = hair_test_strands_make(8, 32);
            for (int k = 0; k < 8; ++k)
                hair_test_add_straight(&strands, 32, hair_v3(-0.1f + 0.03f * (float)k, 0, 0.003f * (float)k),
                                       hair_v3(1, -0.1f, 0.1f * (float)(k - 3)), 0.3f);
            hair_desc desc =
                hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
            hair_test_live(*state, &strands, &desc, &living[run]);
            hair_test_set_colliders(&living[run], colliders, HAIR_STEP_COLLIDERS);
            hair_test_wait(&living[run], 180);
            hair_test_read_guides(&living[run]);
            hair_test_strands_free(&strands);
        }
        double deepest = -INFINITY;
        for (int i = 0; i < HAIR_STEP_COLLIDERS; ++i)
            deepest = fmax(deepest, depth(&living[0], &colliders[i]));
        print_message("    solver %d: up to %.2g m deep in the margin\n", solver, deepest);
        assert_true(deepest < 1e-5);
        assert_true(hair_test_stretch(&living[0]) < 0.01);
        assert_memory_equal(living[0].positions, living[1].positions, 12 * living[0].vertices);
        hair_test_die(&living[0]);
        hair_test_die(&living[1]);
    }
}

// Drop eight strands on a bar, each at another place. Record their positions after each frame of
// `substeps` substeps.
static void fall_over_bar(struct hair_test* test, int substeps, float* track, struct hair_test_living* out)
{
    hair_physics physics = hair_test_loose(0.3f);
    struct hair_test_strands strands = hair_test_strands_make(STRIKING, 32);
    hair_collider bar = capsule(-0.05, -0.22, 0.05, 0);
    for (int k = 0; k < STRIKING; ++k)
        hair_test_add_straight(&strands, 32, hair_v3(0.008f * (float)k - 0.1f, 0, 0.01f * (float)k),
                               hair_v3(1, -0.1f, 0.1f), 0.3f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
                                    1.0 / 60 / substeps, &physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
    hair_test_set_colliders(out, &bar, 1);
    for (int frame = 0; frame < STRIKING_FRAMES; ++frame) {
        hair_test_wait(out, 1);
        hair_test_read_guides(out);
        memcpy(track + (size_t)frame * 3 * out->vertices, out->positions, 12 * out->vertices);
    }
}

static void impact_is_equal_with_few_and_many_substeps(void** state)
{
    enum { FLOATS = 3 * 32 * STRIKING * STRIKING_FRAMES };
    static float track[2][FLOATS];
    struct hair_test_living living[2];
    double sum = 0;
    fall_over_bar(*state, 4, track[0], &living[0]);
    fall_over_bar(*state, 64, track[1], &living[1]);
    for (int i = 0; i < FLOATS; ++i) sum += pow((double)track[0][i] - (double)track[1][i], 2);
    double error = sqrt(3 * sum / FLOATS) / 0.3;
    print_message("    off by %.2g of the length\n", error);
    assert_true(error < 4.8e-3); // 5.2e-3 if neighbours feel an impact by bending alone.
    hair_test_die(&living[0]);
    hair_test_die(&living[1]);
}

// Check strands of 25 mm, at 20 degrees to a head. Their roots are in the head's margin, or inside
// the head.
static void roots_in_the_collision_margin_rest_without_fallback(void** state)
{
    hair_collider head = sphere(0, 0, 0, 0.1);
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0;
    // With more than HAIR_FEW_COLLIDERS there is a grid of colliders.
    for (int any = 0; any < 2; ++any)
        for (int solver = 0; solver < 2; ++solver) {
            hair_collider colliders[HAIR_FEW_COLLIDERS + 1];
            struct hair_test_living living;
            struct hair_test_strands strands = hair_test_strands_make(6, 32);
            for (int k = 0; k < 6; ++k)
                hair_test_add_straight(&strands, 32, hair_v3(0, 0.1f - 0.0002f * (float)k, 0),
                                       hair_v3(cosf((float)k), 0.36f, sinf((float)k)), 0.025f);
            hair_desc desc =
                hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
            hair_test_live(*state, &strands, &desc, &living);
            for (int i = 0; i <= HAIR_FEW_COLLIDERS; ++i)
                colliders[i] = i ? sphere(0.02 * i, -0.3, 0, 0.01) : head;
            hair_test_set_colliders(&living, colliders, any ? HAIR_FEW_COLLIDERS + 1 : 1);
            hair_test_wait(&living, 60);
            hair_test_read_guides(&living);
            print_message("    %d colliders, solver %d: %.2g m from rest\n", any ? HAIR_FEW_COLLIDERS + 1 : 1,
                          solver, hair_test_from_rest(&living));
            assert_true(hair_test_from_rest(&living) < 2e-3);
            hair_test_healthy(&living);
            hair_test_strands_free(&strands);
            hair_test_die(&living);
        }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(strand_over_a_collider_stays_outside_without_creep),
        HAIR_TEST(strand_without_friction_slides_off_a_collider),
        HAIR_TEST(strand_on_a_slope_obeys_coulombs_law),
        HAIR_TEST(moving_and_spinning_colliders_carry_hair_along),
        HAIR_TEST(collider_swept_through_hair_takes_it_along),
        HAIR_TEST(roots_in_the_collision_margin_rest_without_fallback),
        HAIR_TEST(hair_leaves_a_collider_that_appears_slowly),
        HAIR_TEST(free_strand_comes_to_rest_on_a_collider),
        HAIR_TEST(impact_is_equal_with_few_and_many_substeps),
        HAIR_TEST(hair_stays_out_of_64_colliders_with_equal_bits),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
