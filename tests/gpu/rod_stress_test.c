// rod_stress_test.c - stress that no hair should suffer. Strands as rods stay finite, keep their
// length, and are back in their rest shape four seconds later.
#include "tests/support/live_hair.h"

#include <math.h>

#define TURN 6.283185307179586

struct stress {
    const char* name;
    // Set the head before the i-th frame, and return the frame's length in seconds. 0 ends the
    // stress.
    double (*frame)(uint32_t i, struct hair_reference_rod_pose* head);
    // Change the physics. `lasting` changes them from the start, and otherwise only during the
    // stress.
    void (*change)(hair_physics* physics);
    int lasting;
    int returns; // 1 if strands must return to the rest shape.
    int blows; // 1 for wind of 1000 m/s along two axes.
};

static const hair_vec3 up = {0, 1, 0};

static double stand(uint32_t i, struct hair_reference_rod_pose* head)
{
    *head = hair_test_pose_of(hair_v3(0, 0, 0), up, 0);
    return i < 60 ? 1.0 / 60 : 0;
}

static double wander(uint32_t i, struct hair_reference_rod_pose* head)
{
    *head = hair_test_pose_of(hair_v3(0.3f * sinf((float)i), 0, 0.2f * cosf(2 * (float)i)), up, 0.5 * i);
    return i < 12 ? 1 : 0;
}

static double in_seconds(uint32_t i, struct hair_reference_rod_pose* head)
{
    return wander(i + 6, head);
}

static double in_tenths(uint32_t i, struct hair_reference_rod_pose* head)
{
    return 0.1 * wander(i, head);
}

static double in_nothing(uint32_t i, struct hair_reference_rod_pose* head)
{
    wander(i / 3, head);
    return i < 30 ? 1e-9 : 0;
}

static double unevenly(uint32_t i, struct hair_reference_rod_pose* head)
{
    *head = hair_test_pose_of(hair_v3(0.05f * sinf(0.9f * (float)i), 0, 0), up, 0);
    return i >= 60 ? 0 : i % 2 ? 1.0 / 30 : 1.0 / 240;
}

static double jump(uint32_t i, struct hair_reference_rod_pose* head)
{
    *head = hair_test_pose_of(hair_v3(i % 10 > 4 ? 10 : 0, 0, 0), up, 0);
    return i < 60 ? 1.0 / 60 : 0;
}

static double spin(uint32_t i, struct hair_reference_rod_pose* head)
{
    double time = (i + 1) / 60.0;
    *head = hair_test_pose_of(hair_v3(0, 0, 0), up, TURN * 10 * time * fmin(2 * time, 1));
    return i < 60 ? 1.0 / 60 : 0;
}

static double flip(uint32_t i, struct hair_reference_rod_pose* head)
{
    *head = hair_test_pose_of(hair_v3(0, 0, 0), hair_v3(0, 0, 1), i / 10 % 2 ? TURN / 2 : 0);
    return i < 60 ? 1.0 / 60 : 0;
}

static void make_stiff(hair_physics* physics)
{
    physics->fiber.youngs_modulus = 1e12f;
}
static void make_soft(hair_physics* physics)
{
    physics->fiber.youngs_modulus = 0;
}
static void make_heavy(hair_physics* physics)
{
    physics->tip_mass = 1000;
}
static void make_loose(hair_physics* physics)
{
    physics->root = HAIR_ROOT_FREE;
}
static void weigh(hair_physics* physics)
{
    physics->gravity[0] = 1000, physics->gravity[1] = 300;
}

static const struct stress stresses[] = {
    {"frames of 1 s", in_seconds, NULL, 0, 1, 0},
    {"frames of 0.1 s", in_tenths, NULL, 0, 1, 0},
    {"frames of 1 ns", in_nothing, NULL, 0, 1, 0},
    {"frames of 1/30 and 1/240 s", unevenly, NULL, 0, 1, 0},
    {"jumps of 10 m", jump, NULL, 0, 1, 0},
    {"10 turns a second", spin, NULL, 0, 1, 0},
    {"the root turned over", flip, NULL, 0, 1, 0},
    {"gravity of 1000 m/s^2", stand, weigh, 0, 1, 0},
    {"wind of 1000 m/s", stand, NULL, 0, 1, 1},
    {"Young's modulus of 1e12 Pa", unevenly, make_stiff, 1, 0, 0},
    {"no stiffness", unevenly, make_soft, 1, 0, 0},
    {"a tip of 1000 times the mass", unevenly, make_heavy, 1, 0, 0},
    {"a root let go of", unevenly, make_loose, 0, 1, 0},
};

// Apply the stress and then 4 s of calm. Return the maximum stretch of all frames.
static double suffer(struct hair_test_living* living, const struct stress* stress)
{
    struct hair_reference_rod_pose head, home = hair_test_pose_of(hair_v3(0, 0, 0), up, 0);
    hair_physics calm = living->physics, changed = calm;
    double dt, max = 0;
    if (stress->change && !stress->lasting) stress->change(&changed);
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = 1000, wind.velocity[2] = -1000;
    hair_test_ok(living->test, hair_set_physics(living->hair, &changed));
    hair_test_wind_coupling(living, stress->blows ? &wind : NULL);
    for (uint32_t i = 0; (dt = stress->frame(i, &head)) > 0; ++i) {
        hair_test_advance(living, &head, dt);
        hair_test_read_guides(living);
        max = fmax(max, hair_test_stretch(living));
    }
    hair_test_ok(living->test, hair_set_physics(living->hair, &calm));
    hair_test_wind_coupling(living, NULL);
    for (uint32_t i = 0; i < 240; ++i) {
        hair_test_advance(living, &home, 1.0 / 60);
        hair_test_read_guides(living);
        max = fmax(max, hair_test_stretch(living));
    }
    return max;
}

static struct hair_test_living start(struct hair_test* test, hair_solver solver, hair_thread_mapping mapping,
                                     const hair_physics* physics)
{
    struct hair_test_living living;
    struct hair_test_strands s = hair_test_straight_and_curl();
    hair_desc desc = hair_test_rods(solver, mapping, 0, physics);
    desc.max_dt = 1;
    hair_test_live(test, &s, &desc, &living);
    hair_test_strands_free(&s);
    return living;
}

// Return the maximum distance of a guide from its rest pose, relative to its length.
static double from_rest(const struct hair_test_living* living)
{
    double max = 0;
    for (uint32_t g = 0; g < living->groom->info.guide_count; ++g)
        for (uint32_t i = 0; i < living->groom->guides[g].count; ++i) {
            hair_vec3 rest = hair_load3(&living->groom->rest[living->groom->guides[g].first + i].position.x);
            double off = (double)hair_distance(hair_test_at(living, g, i), rest);
            max = fmax(max, off / hair_test_length(living, g));
        }
    return max;
}

static void try_all(struct hair_test* test, hair_thread_mapping mapping, int solvers)
{
    for (size_t n = 0; n < sizeof stresses / sizeof *stresses; ++n)
        for (int solver = 0; solver < solvers; ++solver) {
            hair_physics physics = hair_physics_default();
            if (stresses[n].lasting) stresses[n].change(&physics);
            struct hair_test_living living = start(test, (hair_solver)solver, mapping, &physics);
            double max = suffer(&living, &stresses[n]), off = from_rest(&living);
            hair_solver_stats solver_stats = hair_test_solver_stats(&living);
            print_message("    %s, solver %d: stretch %.2g, then %.2g of the length from rest; %u by Euler, "
                          "%u follow, %u reset\n",
                          stresses[n].name, solver, max, off, solver_stats.euler_fallbacks,
                          solver_stats.follow_fallbacks, solver_stats.reset);
            assert_true(max <= 0.02);
            if (stresses[n].returns && solver != HAIR_SOLVER_FOLLOW) assert_true(off < 0.01);
            assert_int_equal(solver_stats.reset, 0);
            hair_test_die(&living);
        }
}

static void hair_survives_extreme_inputs(void** state)
{
    try_all(*state, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, HAIR_SOLVER_REDBLACK);
}

static void hair_survives_extreme_inputs_with_thread_per_guide(void** state)
{
    try_all(*state, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 1);
}

static void solver_stats_count_fallbacks(void** state)
{
    hair_physics physics = hair_physics_default();
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living =
            start(*state, (hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, &physics);
        hair_test_wait(&living, 60);
        hair_test_healthy(&living);
        suffer(&living, &stresses[4]); // Only following the leader bears a jump of 10 m.
        hair_solver_stats solver_stats = hair_test_solver_stats(&living);
        assert_true(solver_stats.euler_fallbacks > 0 || solver_stats.parts > 0);
        assert_true(!solver_stats.euler_fallbacks ||
                    !solver_stats.parts); // Each program has only one of the two.
        assert_true(solver_stats.follow_fallbacks > 0);
        assert_int_equal(solver_stats.reset, 0);
        hair_test_die(&living);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_survives_extreme_inputs),
        HAIR_TEST(hair_survives_extreme_inputs_with_thread_per_guide),
        HAIR_TEST(solver_stats_count_fallbacks),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
