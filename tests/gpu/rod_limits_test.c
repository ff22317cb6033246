// rod_limits_test.c - strands as rods with the maximum number of vertices, far from the origin, and
// over many substeps.
#include "tests/support/live_hair.h"

#include <math.h>

static const hair_vec3 up = {0, 1, 0};

static struct hair_test_living start(struct hair_test* test, hair_solver solver)
{
    struct hair_test_living living;
    hair_physics physics = hair_physics_default();
    struct hair_test_strands s = hair_test_straight_and_curl();
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
    desc.max_dt = 1;
    hair_test_live(test, &s, &desc, &living);
    hair_test_strands_free(&s);
    return living;
}

// Evaluate a strand that changes direction at every vertex. Length constraints of such strands
// converge slowly.
static hair_vec3 jagged(float t, uint32_t strand, const void* user)
{
    (void)user;
    float angle = 40000 * t * t, off = 0.0006f * (float)(strand + 1);
    return hair_v3(0.1f + off * cosf(angle), -0.05f * (float)(strand + 1) * t, off * sinf(angle));
}

static double jump_as_many(struct hair_test* test, hair_solver solver, float tip_mass)
{
    struct hair_test_living living;
    struct hair_test_strands s = hair_test_strands_make(8, HAIR_MAX_GUIDE_VERTICES);
    hair_physics physics = hair_physics_default();
    double max = 0, dt = 0.01;
    physics.fiber.youngs_modulus = 1e12f;
    physics.fiber.flatness = 0.5f;
    physics.tip_mass = tip_mass;
    for (int k = 0; k < 8; ++k) hair_test_strands_add(&s, HAIR_MAX_GUIDE_VERTICES, jagged, NULL);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, dt, &physics);
    hair_test_live(test, &s, &desc, &living);
    hair_test_strands_free(&s);
    for (uint32_t i = 0; i < 36; ++i) {
        struct hair_reference_rod_pose head = hair_test_pose_of(hair_v3((float)(i / 12), 0, 0), up, 0);
        hair_test_advance(&living, &head, dt);
        hair_test_read_guides(&living);
        max = fmax(max, hair_test_stretch(&living));
    }
    hair_test_die(&living);
    return max;
}

// Check guides with the maximum number of vertices. Software rasterisers end long loops, and a
// substep that uses all iterations must still finish its work.
static void guides_of_256_vertices_survive_extreme_inputs(void** state)
{
    for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver)
        for (float tip_mass = 0; tip_mass <= 10; tip_mass += 10) {
            double max = jump_as_many(*state, (hair_solver)solver, tip_mass);
            print_message("    solver %d, a tip of %g: stretch %.2g\n", solver, (double)tip_mass, max);
            assert_true(max <= 0.02);
        }
}

// Check a head far from the world's origin, where floats resolve centimetres. Positions are
// relative to the head. Both heads are teleported home to be compared.
static void head_100_km_out_moves_hair_equally(void** state)
{
    for (int solver = 0; solver < 2; ++solver) {
        static const float home[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        struct hair_test_living far = start(*state, (hair_solver)solver);
        struct hair_test_living near = start(*state, (hair_solver)solver);
        float away[16];
        for (int k = 0; k < 16; ++k) away[k] = home[k];
        away[12] = 1e5f, away[14] = -1e5f;
        hair_test_ok(*state, hair_teleport(far.hair, away));
        for (int k = 0; k < 60; ++k) {
            double y = 0.03 * sin(0.2 * k);
            struct hair_reference_rod_pose at = hair_test_pose_of(hair_v3(1e5f, (float)y, -1e5f), up, 0);
            struct hair_reference_rod_pose by = hair_test_pose_of(hair_v3(0, (float)y, 0), up, 0);
            hair_test_advance(&far, &at, 1.0 / 60);
            hair_test_advance(&near, &by, 1.0 / 60);
        }
        hair_test_ok(*state, hair_teleport(far.hair, home));
        hair_test_ok(*state, hair_teleport(near.hair, home));
        hair_test_read_guides(&far);
        hair_test_read_guides(&near);
        double max = 0;
        for (uint32_t i = 0; i < near.vertices; ++i)
            max = fmax(max, (double)hair_distance(hair_load3(far.positions + 3 * i),
                                                  hair_load3(near.positions + 3 * i)));
        print_message("    solver %d: %.2g m apart\n", solver, max);
        assert_true(max < 1e-5);
        hair_test_die(&far);
        hair_test_die(&near);
    }
}

static void hair_at_rest_stays_for_20000_substeps(void** state)
{
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living = start(*state, (hair_solver)solver);
        uint32_t frames = (uint32_t)(20000 * 60 * (double)hair_test_solver_stats(&living).substep);
        hair_test_wait(&living, 180);
        hair_test_read_guides(&living);
        hair_test_wait(&living, frames);
        hair_test_read_guides(&living);
        print_message("    solver %d: moved by %.2g m in %u frames\n", solver, hair_test_moved(&living),
                      frames);
        assert_true(hair_test_moved(&living) < 1e-5);
        hair_test_healthy(&living);
        hair_test_die(&living);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(guides_of_256_vertices_survive_extreme_inputs),
        HAIR_TEST(head_100_km_out_moves_hair_equally),
        HAIR_TEST(hair_at_rest_stays_for_20000_substeps),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
