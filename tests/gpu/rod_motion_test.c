// rod_motion_test.c - strands as rods move like the converged reference in double precision:
// shaken, hinged, and free.
#include "tests/support/live_hair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAME (1.0 / 60)
#define LENGTH 0.3f // Metres.

struct error {
    double rms, stretch; // Relative to the length.
};

// Step the instance and the reference side by side for `frames`, with a head that is shaken or
// still. The reference's substeps are short enough for an error of 1e-6 of the length.
static struct error follow(struct hair_test_living* living, uint32_t guide, uint32_t frames, int shakes)
{
    struct hair_reference_rod* rod = hair_test_reference(living, guide, NULL);
    double needs = 2 * FRAME / hair_reference_rod_longest_substep(rod), sum = 0;
    uint32_t substeps = (uint32_t)fmax(256, needs), count = hair_reference_rod_vertices(rod);
    struct error error = {0, 0};
    for (uint32_t k = 0; k < frames; ++k) {
        struct hair_reference_rod_pose head = hair_test_shaken(shakes ? (k + 1) * FRAME : 0);
        double x[3 * HAIR_REFERENCE_ROD_MAX_VERTICES];
        hair_test_advance(living, &head, FRAME);
        hair_test_read_guides(living);
        error.stretch = fmax(error.stretch, hair_test_stretch(living));
        assert_true(hair_reference_rod_advance(rod, &head, FRAME, substeps));
        hair_reference_rod_positions(rod, x);
        for (uint32_t i = 0; i < count; ++i) {
            hair_vec3 p = hair_test_at(living, guide, i);
            double a = (double)p.x - x[3 * i], b = (double)p.y - x[3 * i + 1], c = (double)p.z - x[3 * i + 2];
            sum += a * a + b * b + c * c;
        }
    }
    hair_reference_rod_destroy(rod);
    error.rms = sqrt(sum / frames / count) / hair_test_length(living, guide);
    return error;
}

static struct error shake(struct hair_test* test, uint32_t vertices, const hair_desc* desc, uint32_t frames)
{
    struct hair_test_living living;
    struct hair_test_strands strands = hair_test_slanting(vertices);
    hair_test_live(test, &strands, desc, &living);
    struct error error = follow(&living, 0, frames, 1);
    hair_solver_stats solver_stats = hair_test_solver_stats(&living);
    print_message("    %u vertices, %s, 1/%.0f s: rms %.2g of the length, stretch %.2g, %u by Euler\n",
                  vertices, desc->solver == HAIR_SOLVER_DIRECT ? "direct" : "accurate",
                  1 / (double)solver_stats.substep, error.rms, error.stretch, solver_stats.euler_fallbacks);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
    return error;
}

// Check strands of 2 to 256 vertices. Bending is stiff with such fine vertices. From 64 vertices
// on, the solver accurate integrates bending implicitly, which costs accuracy.
static void strands_of_2_to_256_vertices_follow_a_shaken_head(void** state)
{
    static const struct {
        uint32_t vertices, frames;
        double accurate;
    } cases[] = {{2, 60, 1e-5},  {3, 60, 1e-5},  {4, 60, 1e-5},  {16, 60, 1e-4},
                 {31, 30, 1e-4}, {32, 60, 1e-4}, {33, 20, 1e-4}, {64, 8, 4e-4},
                 {65, 6, 4e-4},  {128, 6, 4e-4}, {255, 3, 4e-4}, {256, 3, 4e-4}};
    hair_physics physics = hair_test_bare();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        uint32_t n = cases[i].vertices;
        hair_desc direct =
            hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_desc accurate =
            hair_test_rods(HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        struct error a = shake(*state, n, &direct, cases[i].frames),
                     b = shake(*state, n, &accurate, cases[i].frames);
        assert_true(a.rms < 5e-3 && a.stretch < 1e-3);
        assert_true(b.rms < cases[i].accurate && b.stretch < (n < 128 ? 5e-4 : 1e-2));
    }
}

// Check the order of the error with soft hair, whose bending does not limit the order. The error is
// then proportional to h^2 at all of these substeps h.
static void error_is_of_second_order_in_the_substep(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.fiber.youngs_modulus = 3e7f;
    for (int solver = 0; solver < 2; ++solver) {
        double before = 0, substep = 1.0 / 240;
        for (int k = 0; k < 3; ++k, substep /= 2) {
            hair_desc desc = hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
                                            substep, &physics);
            struct error error = shake(*state, 12, &desc, 20);
            if (k > 0) print_message("    order %.2f\n", log2(before / error.rms));
            if (k > 0) assert_true(log2(before / error.rms) > 1.8);
            before = error.rms;
        }
    }
}

// Check the swing by which solvers are compared: a chain released from the horizontal, under
// gravity only. It whips at 0.3 s.
static void chain_released_level_is_within_the_stated_error(void** state)
{
    static const double limit[] = {3.5e-3, 6e-4}; // Metres.
    hair_physics physics = hair_test_bare();
    physics.fiber.youngs_modulus = 0;
    physics.damping = 0;
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_strands strands = hair_test_straight(32, hair_v3(0, 0, 0), hair_v3(1, 0, 0), LENGTH);
        struct hair_test_living living;
        hair_desc desc = hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
                                        solver ? 1.0 / 1080 : 0, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        struct error error = follow(&living, 0, 24, 0);
        print_message("    rms %.3g mm, stretch %.2g\n", 1e3 * error.rms * 0.3, error.stretch);
        assert_true(error.rms * 0.3 < limit[solver]);
        assert_true(error.stretch < 1e-3);
        hair_test_healthy(&living);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

static void shake_both(struct hair_test* test, uint32_t vertices, const hair_physics* physics, double direct,
                       double accurate)
{
    for (int solver = 0; solver < 2; ++solver) {
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, physics);
        struct error error = shake(test, vertices, &desc, 30);
        assert_true(error.rms < (solver == HAIR_SOLVER_DIRECT ? direct : accurate));
        assert_true(error.stretch < 1e-3);
    }
}

static void hinged_root_turns_like_the_reference(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.root = HAIR_ROOT_HINGED;
    shake_both(*state, 16, &physics, 2e-3, 5e-5);
}

static void heavy_tip_swings_like_the_reference(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.tip_mass = 1;
    shake_both(*state, 16, &physics, 4e-3, 1e-4);
    physics.tip_mass = 10;
    shake_both(*state, 16, &physics, 5e-3, 2e-4);
}

static void shape_pull_is_a_spring_to_the_rest_pose(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.shape.frequency_root = 8, physics.shape.frequency_tip = 2;
    shake_both(*state, 16, &physics, 2e-3, 5e-5);
    // The solver accurate integrates this one implicitly.
    shake_both(*state, 70, &physics, 2e-3, 3e-4);
}

static void wind_carries_hair_like_the_reference(void** state)
{
    hair_physics physics = hair_test_bare();
    hair_wind wind = hair_wind_default();
    physics.damping = 6;
    wind.velocity[0] = -2, wind.velocity[2] = 3;
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        struct hair_test_strands strands = hair_test_slanting(16);
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_wind_coupling(&living, &wind);
        struct error error = follow(&living, 0, 30, 1);
        print_message("    solver %d: rms %.2g of the length, stretch %.2g\n", solver, error.rms,
                      error.stretch);
        assert_true(error.rms < (solver == HAIR_SOLVER_DIRECT ? 1.5e-2 : 4e-4));
        assert_true(error.stretch < 1e-3);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

static void stiffness_scale_goes_from_root_to_tip(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.shape.stiffness_root = 8, physics.shape.stiffness_tip = 0.5f;
    shake_both(*state, 16, &physics, 4e-3, 1e-4);
    physics.shape.stiffness_root = 0.2f, physics.shape.stiffness_tip = 8;
    shake_both(*state, 16, &physics, 4e-3, 1e-4);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(strands_of_2_to_256_vertices_follow_a_shaken_head),
        HAIR_TEST(error_is_of_second_order_in_the_substep),
        HAIR_TEST(chain_released_level_is_within_the_stated_error),
        HAIR_TEST(hinged_root_turns_like_the_reference),
        HAIR_TEST(heavy_tip_swings_like_the_reference),
        HAIR_TEST(shape_pull_is_a_spring_to_the_rest_pose),
        HAIR_TEST(wind_carries_hair_like_the_reference),
        HAIR_TEST(stiffness_scale_goes_from_root_to_tip),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
