// solver_stats_test.c - results of hair_get_solver_stats: healthy hair is reported as healthy, and
// hair that thrashes or gains energy is not.
#include <math.h>
#include <stdio.h>

#include "tests/support/haircut.h"
#include "tests/support/live_hair.h"
#include "tests/support/shell.h"

#include "lib/api/api.h"

enum { FPS = 60, GUIDES = 16, SHAKE = 30 };

static hair_solver_stats ask(struct hair_test* test, hair_instance* hair)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    hair_test_ok(test, hair_get_solver_stats(hair, &solver_stats));
    return solver_stats;
}

// Turn the head to and fro for half a second, then leave it alone.
static void shake(struct hair_test* test, hair_instance* hair, uint32_t frames)
{
    for (uint32_t i = 0; i < frames; ++i) {
        float angle = i < SHAKE ? 0.4f * sinf(6.2831853f * (float)(i + 1) / SHAKE) : 0;
        float head[16] = {cosf(angle), 0, -sinf(angle), 0, 0, 1, 0, 0,
                          sinf(angle), 0, cosf(angle),  0, 0, 0, 0, 1};
        hair_test_ok(test, hair_set_transform(hair, head));
        hair_test_ok(test, hair_step(hair, 1.0f / FPS));
    }
}

// Put a box at the tip of the first guide.
static void add_box(struct hair_test* test, hair_instance* hair)
{
    static float at[3 * 4096];
    uint32_t tip = hair_sim_guides(&hair->sim, NULL)[0].count - 1, count;
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_GUIDES, at, 4096, &count));
    hair_collider box = hair_test_body(HAIR_SHAPE_BOX, at[3 * tip], at[3 * tip + 1], at[3 * tip + 2]);
    for (int k = 0; k < 3; ++k) box.size[k] = 0.03f;
    hair_test_ok(test, hair_set_colliders(hair, &box, 1, sizeof box));
}

static void check_haircut(struct hair_test* test, hair_style style, hair_solver solver, float damping,
                          int collides)
{
    hair_style_desc of = hair_style_desc_default();
    hair_desc desc = hair_desc_default();
    hair_physics physics = hair_physics_default();
    hair_instance* hair = NULL;
    of.style = style;
    of.guide_count = GUIDES;
    physics.damping = damping;
    desc.physics = &physics;
    desc.solver = solver;
    desc.diagnose = true;
    hair_groom* groom = hair_test_haircut(test, &of, 0);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    if (collides) add_box(test, hair);
    shake(test, hair, SHAKE + 90);
    hair_solver_stats solver_stats = ask(test, hair);
    print_message("    %s by solver %d, damping %g%s: %u gain, %u restless, fastest %.3g m/s, stretch %.2g\n",
                  hair_style_name(style), solver, (double)damping, collides ? ", box" : "",
                  solver_stats.gaining, solver_stats.restless, (double)solver_stats.fastest,
                  (double)solver_stats.stretch);
    assert_int_equal(solver_stats.gaining, 0);
    assert_int_equal(solver_stats.restless, 0);
    assert_int_equal(solver_stats.overstretched, 0);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void haircuts_after_a_head_shake_gain_no_energy(void** state)
{
    for (int style = 0; style < HAIR_STYLE_COUNT; ++style)
        for (int still = 0; still < 2; ++still)
            check_haircut(*state, (hair_style)style, HAIR_SOLVER_DIRECT, still ? 0 : 4, 0);
}

static void accurate_haircuts_gain_no_energy(void** state)
{
    check_haircut(*state, HAIR_STYLE_CURLY, HAIR_SOLVER_ACCURATE, 0, 0);
    check_haircut(*state, HAIR_STYLE_LONG, HAIR_SOLVER_ACCURATE, 0, 0);
}

static void haircuts_on_a_box_gain_no_energy(void** state)
{
    check_haircut(*state, HAIR_STYLE_LONG, HAIR_SOLVER_DIRECT, 4, 1);
    check_haircut(*state, HAIR_STYLE_CURLY, HAIR_SOLVER_DIRECT, 0, 1);
}

// Return the maximum difference of a kind of energy, relative to the total. Both energies are for 1
// kg/m.
static double energy_off(const struct hair_energy* energy, const struct hair_reference_rod_energy* exact)
{
    double scale = fabs(exact->kinetic) + fabs(exact->elastic) + fabs(exact->gravity), max = 0;
    double off[] = {(double)energy->now.x - exact->kinetic, (double)energy->now.y - exact->gravity,
                    (double)energy->now.z - exact->elastic};
    for (int k = 0; k < 3; ++k) max = fmax(max, fabs(off[k]) / scale);
    return max;
}

// Set the reference to the positions, with the velocity of BDF2, which both schemes use (see
// methods.glsl).
static void set_reference(struct hair_reference_rod* rod, float at[3][3 * 64], uint32_t vertices, double h)
{
    double place[3 * 64], speed[3 * 64];
    for (uint32_t i = 0; i < 3 * vertices; ++i) {
        place[i] = (double)at[2][i];
        speed[i] = (3 * (double)at[2][i] - 4 * (double)at[1][i] + (double)at[0][i]) / (2 * h);
    }
    hair_reference_rod_set_state(rod, place, speed);
}

// Add a collider out of reach, with which the mixed scheme solves guides of more than 32 vertices.
static void add_far_collider(struct hair_test* test, hair_instance* hair)
{
    hair_collider far = hair_collider_default();
    far.size[0] = 0.1f;
    far.position[1] = -10;
    hair_test_ok(test, hair_set_colliders(hair, &far, 1, sizeof far));
}

static void energy_equals_the_reference(void** state)
{
    // The first uses the scheme of straight rods, and the second the mixed scheme.
    static const uint32_t vertices[] = {16, 40};
    for (int k = 0; k < 2; ++k) {
        struct hair_test_strands strands =
            hair_test_straight(vertices[k], hair_v3(0, 0, 0), hair_v3(1, 0.2f, 0), 0.1f);
        struct hair_test_living living;
        struct hair_energy energy;
        hair_physics physics = hair_test_bare();
        static float at[3][3 * 64];
        double h = 1.0 / 960;
        uint32_t count;
        hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, h, &physics);
        desc.diagnose = true;
        hair_test_live(*state, &strands, &desc, &living);
        add_far_collider(*state, living.hair);
        struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
        for (int n = 0; n < 80; ++n) {
            if (n >= 77)
                hair_test_ok(*state,
                             hair_read_positions(living.hair, HAIR_READ_GUIDES, at[n - 77], 64, &count));
            if (n < 79) hair_test_advance(&living, NULL, h);
        }
        set_reference(rod, at, vertices[k], h);
        glGetNamedBufferSubData(living.hair->sim.diagnosis.energy, 0, sizeof energy, &energy);
        struct hair_reference_rod_energy exact = hair_reference_rod_energy_of(rod);
        double off = energy_off(&energy, &exact);
        print_message("    %u vertices: kinetic %.4g, gravity %.4g, elastic %.4g J by the reference, %.4g, "
                      "%.4g, %.4g\n",
                      vertices[k], exact.kinetic, exact.gravity, exact.elastic, (double)energy.now.x,
                      (double)energy.now.y, (double)energy.now.z);
        assert_true(exact.elastic > 0 && exact.kinetic > 0 && off < 2e-3);
        hair_reference_rod_destroy(rod);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

// Check that the mixed scheme softens guides that are too stiff for single precision, and no
// realistic hair.
static void too_stiff_guide_is_softened_and_counted(void** state)
{
    for (int stiff = 0; stiff < 2; ++stiff) {
        struct hair_test_strands strands =
            hair_test_straight(64, hair_v3(0, 0, 0), hair_v3(0, 1, 0), stiff ? 0.01f : 0.3f);
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        physics.shape.stiffness_root = physics.shape.stiffness_tip = stiff ? 1e4f : 1;
        hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        hair_solver_stats solver_stats = ask(*state, living.hair);
        print_message("    softened to %.3g\n", (double)solver_stats.softest);
        assert_int_equal(solver_stats.softened, stiff);
        assert_true(stiff ? solver_stats.softest > 0 && solver_stats.softest < 1 : solver_stats.softest == 1);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

// Make a context with a changed copy of the shaders.
static hair_context* make_context(struct hair_test* test, const char* change)
{
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    char command[256];
    snprintf(command, sizeof command, "cp -r glsl/* $D && cd $D/sim && %s", change);
    hair_test_shell_expect(0, command, "");
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.glsl_dir = hair_test_folder();
    hair_test_ok(test, hair_context_create(&desc, &context));
    return context;
}

static hair_solver_stats live_with(struct hair_test* test, const char* change, uint32_t vertices,
                                   uint32_t diagnose)
{
    struct hair_test_strands strands = hair_test_straight(vertices, hair_v3(0, 0, 0), hair_v3(1, 0, 0), 0.1f);
    hair_physics physics = hair_test_bare();
    hair_context *own = make_context(test, change), *context = test->context;
    physics.damping = 20;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    struct hair_test_living living;
    desc.diagnose = diagnose;
    test->context = own;
    hair_test_live(test, &strands, &desc, &living);
    add_far_collider(test, living.hair);
    hair_test_wait(&living, 210); // The strand falls, and damping needs 2.7 s.
    hair_solver_stats solver_stats = ask(test, living.hair);
    print_message("    %u vertices, %s: %u gain, %u restless, fastest %.3g m/s, stretch %.2g, %u reset\n",
                  vertices, change, solver_stats.gaining, solver_stats.restless, (double)solver_stats.fastest,
                  (double)solver_stats.stretch, solver_stats.reset);
    hair_test_die(&living);
    test->context = context;
    hair_context_destroy(own);
    hair_test_strands_free(&strands);
    return solver_stats;
}

// Check an unchanged solver, and one whose damping adds energy.
static void solver_that_gains_energy_is_counted(void** state)
{
    static const struct {
        uint32_t vertices;
        const char* change;
    } cases[] = {
        {40, "sed -i 's/= 1.0 + b \\* guide_damping/= 1.0 - b * guide_damping/' mixed.glsl"},
        {16, "sed -i 's/ : b \\* hv;/ : 1.1 * b * hv;/' predict.glsl"},
    };
    for (int k = 0; k < 2; ++k) {
        hair_solver_stats sound = live_with(*state, "true", cases[k].vertices, 1);
        assert_true(!sound.gaining && !sound.restless && sound.fastest < 0.02f && !sound.overstretched);
        hair_solver_stats broken = live_with(*state, cases[k].change, cases[k].vertices, 1);
        assert_true(broken.gaining > 0 && broken.restless == 1 && broken.fastest > 0.02f);
        assert_int_equal(live_with(*state, cases[k].change, cases[k].vertices, 0).gaining, 0);
    }
}

int main(void)
{
    if (hair_test_shell_start("/bin/sh")) return 1;

    const struct CMUnitTest tests[] = {
        HAIR_TEST(haircuts_after_a_head_shake_gain_no_energy), HAIR_TEST(accurate_haircuts_gain_no_energy),
        HAIR_TEST(haircuts_on_a_box_gain_no_energy),           HAIR_TEST(energy_equals_the_reference),
        HAIR_TEST(too_stiff_guide_is_softened_and_counted),    HAIR_TEST(solver_that_gains_energy_is_counted),
    };
    int failed = cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
    return hair_test_shell_finish(NULL) ? 1 : failed;
}
