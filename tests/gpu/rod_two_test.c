// rod_two_test.c - many guides on a GPU go through two programs. The first has only the solver's
// own method. The second has all methods, for guides that the first leaves.
#include "tests/support/live_hair.h"

#include <string.h>

#include "lib/api/api.h"

#define GUIDES 1500
// Number of units that the GPU is said to have. It is small for this number of guides.
#define UNITS 20
#define VERTICES 5
#define FRAMES 30

// Simulate strands of several lengths over a ball. The head moves calmly, jumps aside at 60 m/s, is
// not finite for a frame, and comes back.
static void run(struct hair_test* test, int units, float* track, hair_solver_stats* solver_stats)
{
    struct hair_gl* gl = &test->context->gl;
    GLint was = gl->units;
    struct hair_test_strands strands = hair_test_strands_make(GUIDES, VERTICES);
    struct hair_test_living living;
    hair_physics physics = hair_test_loose(0.3f);
    hair_wind wind = hair_wind_default();
    wind.velocity[2] = 1;
    for (int k = 0; k < GUIDES; ++k) {
        float across = 0.2f * (float)k / GUIDES;
        hair_test_add_straight(&strands, VERTICES, hair_v3(0.02f, 0.1f, across - 0.1f), hair_v3(1, 0.1f, 0),
                               0.05f + across);
    }
    hair_desc desc =
        hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 1.0 / 240, &physics);
    hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0.1f, 0, 0);
    ball.size[0] = 0.08f;
    gl->units = units;
    hair_test_live(test, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    hair_test_set_colliders(&living, &ball, 1);
    for (int frame = 0; frame < FRAMES; ++frame) {
        float aside = frame < 12 ? 0 : frame == 20 ? 6e4f : 1;
        struct hair_reference_rod_pose head =
            hair_test_pose_of(hair_v3(aside, 0.001f * (float)frame, 0), hair_v3(0, 1, 0), 0.01 * frame);
        // With wind, all guides go through one program.
        hair_test_wind_coupling(&living, frame == 14 ? &wind : NULL);
        hair_test_advance(&living, &head, 1.0 / 60);
        hair_test_read_guides(&living);
        memcpy(track + (size_t)frame * 3 * living.vertices, living.positions, 12 * living.vertices);
    }
    *solver_stats = hair_test_solver_stats(&living);
    assert_int_equal(living.hair->sim.two_pass, units > 0);
    hair_test_die(&living);
    gl->units = was;
}

static void guides_move_equally_in_two_programs_and_one(void** state)
{
    static float track[2][3 * GUIDES * VERTICES * FRAMES];
    hair_solver_stats solver_stats[2];
    for (int two = 0; two < 2; ++two) run(*state, two * UNITS, track[two], &solver_stats[two]);
    print_message("    of %d guides %u substeps by Euler, %u led, %u reset\n", GUIDES,
                  solver_stats[1].euler_fallbacks, solver_stats[1].follow_fallbacks, solver_stats[1].reset);
    assert_true(solver_stats[1].euler_fallbacks > 0 && solver_stats[1].follow_fallbacks > 0 &&
                solver_stats[1].reset >= GUIDES);
    // The two programs round differently on GPUs.
    if (!((struct hair_test*)*state)->context->gl.software) return;
    assert_memory_equal(track[0], track[1], sizeof track[0]);
    assert_memory_equal(&solver_stats[0], &solver_stats[1], sizeof solver_stats[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(guides_move_equally_in_two_programs_and_one),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
