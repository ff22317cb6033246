// rod_shape_test.c - strands as rods keep their shape, bend and twist like the reference, and keep
// their groom with gravity preload.
#include "tests/support/live_hair.h"

#include <math.h>

#define FRAME (1.0 / 60)
static const hair_vec3 origin = {0, 0, 0};

enum shape { WAVE, CURL, TRESS, SHAPES };

// Evaluate a curve of approximately the length *user: a wave that stands out, a curl that stands
// out, or a strand that hangs.
static hair_vec3 curve(float t, uint32_t strand, const void* user)
{
    float l = *(const float*)user;
    switch (strand) {
    case WAVE: return hair_v3(l * t, 0.05f * l * (1 - cosf(18 * t)), 0.03f * l * sinf(11 * t));
    case CURL: return hair_v3(0.7f * l * t, 0.06f * l * (cosf(14 * t) - 1), 0.06f * l * sinf(14 * t));
    default: return hair_v3(0.03f * l * (1 - cosf(10 * t)), -l * t, 0.02f * l * sinf(8 * t));
    }
}

static struct hair_test_strands shapes(uint32_t vertices, float length)
{
    struct hair_test_strands s = hair_test_strands_make(SHAPES, vertices);
    for (uint32_t k = 0; k < SHAPES; ++k) hair_test_strands_add(&s, vertices, curve, &length);
    return s;
}

static void live(struct hair_test* test, struct hair_test_strands strands, hair_solver solver,
                 const hair_physics* physics, struct hair_test_living* out)
{
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

static void groom_without_loads_is_at_rest(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.gravity[1] = 0;
    for (int solver = 0; solver < 2; ++solver)
        for (int flat = 0; flat < 2; ++flat) {
            struct hair_test_living living;
            physics.fiber.flatness = flat ? 0.4f : 1;
            live(*state, shapes(33, 0.2f), (hair_solver)solver, &physics, &living);
            hair_test_wait(&living, 120);
            hair_test_read_guides(&living);
            print_message("    solver %d: %.2g m away\n", solver, hair_test_from_rest(&living));
            assert_true(hair_test_from_rest(&living) < 2e-6);
            hair_test_healthy(&living);
            hair_test_die(&living);
        }
}

// Check a strand that is stiff enough to stand out by itself, and one that gravity preload must
// stiffen.
static void gravity_preload_keeps_a_straight_strand_groomed(void** state)
{
    static const float lengths[] = {0.05f, 0.14f};
    hair_physics physics = hair_physics_default();
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver)
        for (int k = 0; k < 2; ++k) {
            struct hair_test_living living;
            live(*state, hair_test_straight(16, origin, hair_v3(1, 0, 0), lengths[k]), (hair_solver)solver,
                 &physics, &living);
            hair_test_wait(&living, 120);
            hair_test_read_guides(&living);
            hair_solver_stats solver_stats = hair_test_solver_stats(&living);
            print_message("    solver %d: %.2g m away, stiffened %.3g times\n", solver,
                          hair_test_from_rest(&living), (double)solver_stats.max_stiffening);
            assert_true(hair_test_from_rest(&living) < 1e-5 * (double)lengths[k]);
            assert_int_equal(solver_stats.stiffened, k);
            assert_true(k ? solver_stats.max_stiffening > 2 && solver_stats.max_stiffening <= 3
                          : solver_stats.max_stiffening == 1);
            assert_true(solver_stats.sagging == 0 && solver_stats.farthest_sag == 0);
            hair_test_healthy(&living);
            hair_test_die(&living);
        }
}

// Check a strand that even three times its stiffness does not hold.
static void too_soft_strand_sags_by_the_reported_distance(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0;
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        live(*state, hair_test_straight(16, origin, hair_v3(1, 0.2f, 0), 0.25f), (hair_solver)solver,
             &physics, &living);
        hair_test_wait(&living, 300);
        hair_test_read_guides(&living);
        hair_solver_stats solver_stats = hair_test_solver_stats(&living);
        print_message("    solver %d: %.4g m away, said to be %.4g\n", solver, hair_test_from_rest(&living),
                      (double)solver_stats.farthest_sag);
        assert_true(solver_stats.stiffened == 1 && solver_stats.sagging == 1);
        assert_true(solver_stats.max_stiffening == 3 && solver_stats.farthest_sag > 0.02f);
        hair_test_near("sag", (size_t)solver, hair_test_from_rest(&living), (double)solver_stats.farthest_sag,
                       5e-5);
        hair_test_healthy(&living);
        hair_test_die(&living);
    }
}

static void gravity_preload_keeps_waves_and_curls_groomed(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        live(*state, shapes(33, 0.125f), (hair_solver)solver, &physics, &living);
        hair_test_wait(&living, 120);
        hair_test_read_guides(&living);
        hair_solver_stats solver_stats = hair_test_solver_stats(&living);
        print_message("    solver %d: %.2g m away, %u stiffened up to %.3g times\n", solver,
                      hair_test_from_rest(&living), solver_stats.stiffened,
                      (double)solver_stats.max_stiffening);
        assert_true(solver_stats.stiffened > 0 && solver_stats.sagging == 0);
        assert_true(hair_test_from_rest(&living) < 1e-5 * 0.125);
        hair_test_healthy(&living);
        hair_test_die(&living);
    }
}

// Evaluate a strand of 31 segments of 0.85 mm with three kinks of 25 degrees. The weight of the
// part beyond a kink acts on the part before the kink.
static hair_vec3 kinked(float t, uint32_t strand, const void* user)
{
    float x = 0, y = 0, z = 0, angle = 0.35f;
    (void)user;
    for (uint32_t i = 0; i < (uint32_t)lrintf(31 * t); ++i) {
        if (i == 9 || i == 20 || i == 22) angle += (strand + i) % 2 ? 0.436f : -0.436f;
        x += 8.5e-4f * cosf(angle), y += 8.5e-4f * sinf(angle), z += 8.5e-5f * (float)strand;
    }
    return hair_v3(x, y, z);
}

static void short_stiff_strands_with_kinks_stay_groomed(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0;
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        struct hair_test_strands strands = hair_test_strands_make(4, 32);
        for (uint32_t k = 0; k < 4; ++k) hair_test_strands_add(&strands, 32, kinked, NULL);
        live(*state, strands, (hair_solver)solver, &physics, &living);
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        print_message("    solver %d: %.2g m away\n", solver, hair_test_from_rest(&living));
        assert_true(hair_test_from_rest(&living) < 5e-5);
        hair_test_healthy(&living);
        hair_test_die(&living);
    }
}

// Return the maximum distance of any guide from the reference while the head is shaken, relative to
// the length.
static double shake(struct hair_test_living* living, uint32_t frames)
{
    double max = 0;
    struct hair_reference_rod* rods[SHAPES];
    for (uint32_t g = 0; g < SHAPES; ++g) rods[g] = hair_test_reference(living, g, NULL);
    for (uint32_t k = 1; k <= frames; ++k) {
        struct hair_reference_rod_pose head = hair_test_shaken(k * FRAME);
        hair_test_advance(living, &head, FRAME);
        hair_test_read_guides(living);
        for (uint32_t g = 0; g < SHAPES; ++g) {
            uint32_t substeps = (uint32_t)fmax(96, 2 * FRAME / hair_reference_rod_longest_substep(rods[g]));
            assert_true(hair_reference_rod_advance(rods[g], &head, FRAME, substeps));
            max = fmax(max, hair_test_off(living, g, rods[g]) / hair_test_length(living, g));
        }
    }
    for (uint32_t g = 0; g < SHAPES; ++g) hair_reference_rod_destroy(rods[g]);
    return max;
}

static void curved_strands_bend_and_twist_like_the_reference(void** state)
{
    static const struct {
        double gravity, flatness, direct, accurate;
    } cases[] = {{0, 1, 0.01, 2e-4}, {9.81, 1, 0.1, 5e-3}, {0, 0.5, 0.01, 2e-4}, {0, 0.15, 0.04, 2e-4}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n)
        for (int solver = 0; solver < 2; ++solver) {
            struct hair_test_living living;
            hair_physics physics = hair_test_bare();
            physics.gravity[1] = (float)-cases[n].gravity;
            physics.fiber.flatness = (float)cases[n].flatness;
            live(*state, shapes(20, 0.25f), (hair_solver)solver, &physics, &living);
            double off = shake(&living, 15);
            print_message("    gravity %g, flatness %g, solver %d: off by %.2g of the length\n",
                          cases[n].gravity, cases[n].flatness, solver, off);
            assert_true(off < (solver == HAIR_SOLVER_DIRECT ? cases[n].direct : cases[n].accurate));
            hair_test_die(&living);
        }
}

// Rotate the head by 1.2 rad within a second, about an oblique axis or along the first segment.
// About the first segment only twist transmits the rotation. Three seconds later every strand must
// be in its rest shape under the head.
static void turning_head_takes_shapes_along(void** state)
{
    const hair_vec3 axes[] = {{0.3f, 0.5f, -0.8f}, {0, 0, 0}};
    hair_physics physics = hair_test_bare();
    physics.gravity[1] = 0;
    physics.damping = 8;
    for (int solver = 0; solver < 2; ++solver)
        for (int k = 0; k < 2; ++k)
            for (uint32_t g = 0; g < SHAPES; ++g) {
                struct hair_test_strands one = hair_test_strands_make(1, 20), all = shapes(20, 0.12f);
                struct hair_test_living living;
                for (int i = 0; i < 60; ++i) one.positions[i] = all.positions[60 * g + (uint32_t)i];
                one.vertices[one.count++] = one.vertex_count = 20;
                hair_vec3 first = hair_sub(hair_load3(one.positions + 3), hair_load3(one.positions));
                hair_test_strands_free(&all);
                live(*state, one, (hair_solver)solver, &physics, &living);
                struct hair_reference_rod_pose head = {{0}, {0, 0, 0, 1}};
                for (int i = 1; i <= 240; ++i) {
                    head = hair_test_pose_of(origin, k ? first : axes[0], 1.2 * fmin(i / 60.0, 1));
                    hair_test_advance(&living, &head, FRAME);
                }
                hair_test_read_guides(&living);
                double max = 0;
                hair_quat turn = {(float)head.rotation[0], (float)head.rotation[1], (float)head.rotation[2],
                                  (float)head.rotation[3]};
                for (uint32_t i = 0; i < 20; ++i) {
                    hair_vec3 aim = hair_rotate(turn, hair_load3(&living.groom->rest[i].position.x));
                    max = fmax(max, (double)hair_distance(hair_test_at(&living, 0, i), aim));
                }
                print_message("    solver %d, shape %u, %s: %.2g m away\n", solver, g,
                              k ? "along the root" : "about some axis", max);
                assert_true(max < 1e-5);
                hair_test_die(&living);
            }
}

// Evaluate a coil with hinges of 2.2 rad.
static hair_vec3 coil(float t, uint32_t strand, const void* user)
{
    float turn = 2.4f * 19 * t;
    (void)strand, (void)user;
    return hair_v3(0.12f * t, 0.01f * (cosf(turn) - 1), 0.01f * sinf(turn));
}

static struct hair_test_strands coarse_curl(void)
{
    struct hair_test_strands strands = hair_test_strands_make(1, 20);
    hair_test_strands_add(&strands, 20, coil, NULL);
    return strands;
}

// Compare a straight strand of that length with the reference. A length of 0 selects the coarse
// curl.
static void compare_at_rest(struct hair_test* test, const char* what, const hair_physics* physics,
                            float length, double direct, double accurate)
{
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        struct hair_test_strands strands =
            length > 0 ? hair_test_straight(24, origin, hair_v3(1, 0, 0), length) : coarse_curl();
        live(test, strands, (hair_solver)solver, physics, &living);
        struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
        struct hair_reference_rod_rested rested = hair_reference_rod_rest(rod);
        assert_true(rested.converged);
        hair_test_wait(&living, 300);
        hair_test_read_guides(&living);
        double whole = hair_test_length(&living, 0), off = hair_test_off(&living, 0, rod) / whole;
        print_message("    %s, solver %d: off by %.2g of the length, bent by %.3g\n", what, solver, off,
                      hair_test_from_rest(&living) / whole);
        assert_true(off < (solver == HAIR_SOLVER_DIRECT ? direct : accurate));
        hair_reference_rod_destroy(rod);
        hair_test_die(&living);
    }
}

// Check horizontal hairs of 5, 10 and 30 cm under their own weight. Gamma is 1, 8 and 216.
static void cantilever_hangs_like_the_reference(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0; // With sleep, motion would stop before hair reaches equilibrium.
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.shape.gravity_preload = 0;
    physics.damping = 8;
    compare_at_rest(*state, "5 cm", &physics, 0.05f, 5e-4, 1e-4);
    compare_at_rest(*state, "10 cm", &physics, 0.1f, 1e-2, 5e-6);
    compare_at_rest(*state, "30 cm", &physics, 0.3f, 1e-2, 5e-6);
    physics.shape.stiffness_root = 6, physics.shape.stiffness_tip = 0.3f;
    compare_at_rest(*state, "stiff at the root", &physics, 0.1f, 1e-3, 1e-4);
    physics.shape.stiffness_root = 0.3f, physics.shape.stiffness_tip = 6;
    compare_at_rest(*state, "stiff at the tip", &physics, 0.1f, 2e-2, 5e-3);
    physics.shape.stiffness_root = physics.shape.stiffness_tip = 1;
    physics.tip_mass = 2;
    compare_at_rest(*state, "heavy at the tip", &physics, 0.05f, 2e-2, 5e-3);
}

// Check a coarse curl. By the strain alone, its hinges would be 4.5 times as soft. A clamp that
// resists twist by its factor of bending would leave 9e-4 of the length.
static void coarse_curl_hangs_like_the_reference(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0;
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.shape.gravity_preload = 0;
    physics.fiber.youngs_modulus = 4e10f;
    physics.damping = 8;
    compare_at_rest(*state, "coarse curl", &physics, 0, 1e-5, 1e-5);
    physics.fiber.flatness = 0.5f;
    compare_at_rest(*state, "flat coarse curl", &physics, 0, 1e-5, 1e-5);
}

// Check a flat section. The root frame of a strand along x has its x axis along -y and its z axis
// along z. Gravity along z bends the strand about the section's long axis, which is the easy
// direction.
static void flat_section_bends_about_its_long_axis(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.shape.gravity_preload = 0;
    physics.damping = 8;
    physics.fiber.flatness = 0.4f;
    physics.gravity[1] = 0, physics.gravity[2] = -9.81f;
    double bent[2];
    for (int side = 0; side < 2; ++side) {
        struct hair_test_living living;
        physics.gravity[1] = side ? 0 : -9.81f, physics.gravity[2] = side ? -9.81f : 0;
        live(*state, hair_test_straight(12, origin, hair_v3(1, 0, 0), 0.03f), HAIR_SOLVER_ACCURATE, &physics,
             &living);
        hair_test_wait(&living, 300);
        hair_test_read_guides(&living);
        bent[side] = hair_test_from_rest(&living);
        hair_test_die(&living);
    }
    print_message("    bent by %.3g m and %.3g m\n", bent[0], bent[1]);
    hair_test_near("easy way over hard way", 0, bent[1] / bent[0], 1 / (0.4 * 0.4), 0.3);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(groom_without_loads_is_at_rest),
        HAIR_TEST(gravity_preload_keeps_a_straight_strand_groomed),
        HAIR_TEST(too_soft_strand_sags_by_the_reported_distance),
        HAIR_TEST(gravity_preload_keeps_waves_and_curls_groomed),
        HAIR_TEST(short_stiff_strands_with_kinks_stay_groomed),
        HAIR_TEST(curved_strands_bend_and_twist_like_the_reference),
        HAIR_TEST(turning_head_takes_shapes_along),
        HAIR_TEST(cantilever_hangs_like_the_reference),
        HAIR_TEST(coarse_curl_hangs_like_the_reference),
        HAIR_TEST(flat_section_bends_about_its_long_axis),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
