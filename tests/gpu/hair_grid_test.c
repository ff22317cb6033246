// hair_grid_test.c - the hair around a hair: relative motion decays at its rate, volume is kept,
// and time is divided into blocks. Without cohesion and volume there is nothing of the grid.
#include "tests/support/hair_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/motion.h"

// Simulate pairs of free strands in one place, whose strands move in opposite directions. Return
// the fraction of the relative motion that remains after `time`. `drift` is the mean motion of all
// strands relative to the initial speed.
static double slowing(struct hair_test* test, hair_solver solver, double time, float cohesion, double* drift)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_only_hair_grid(cohesion, 0);
    physics.root = HAIR_ROOT_FREE;
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_hair_grid(test, &desc, 0.01f, &living);
    struct hair_sim* sim = &living.hair->sim;
    struct hair_state* at = hair_test_buffer(sim->state, living.vertices * sizeof *at);
    double relative = 0, speed = 0.005 * sim->substep;
    for (uint32_t i = 0; i < living.vertices; ++i) {
        at[i].displacement.x = (float)((i / HAIR_TEST_HAIR_GRID_VERTICES % 2 ? 1 : -1) * speed);
        at[i].position.w = 1;
    }
    hair_test_set_state(&living, at);
    free(at);
    for (int i = 0; i < (int)(time * 120 + 0.5); ++i) hair_test_advance(&living, NULL, 1.0 / 120);
    at = hair_test_buffer(sim->state, living.vertices * sizeof *at);
    *drift = 0;
    for (uint32_t i = 0; i < living.vertices; ++i) {
        relative += (i / HAIR_TEST_HAIR_GRID_VERTICES % 2 ? 1 : -1) * (double)at[i].displacement.x / speed /
                    living.vertices;
        *drift += (double)at[i].displacement.x / speed / living.vertices;
    }
    free(at);
    hair_test_healthy(&living);
    hair_test_die(&living);
    return relative;
}

static void relative_motion_decays_at_the_rate_of_cohesion(void** state)
{
    for (int solver = 0; solver < HAIR_SOLVER_FOLLOW; ++solver)
        for (int fast = 0; fast < 2; ++fast) {
            double drift, rate = fast ? 20 : 5,
                          left = slowing(*state, (hair_solver)solver, 0.1, (float)rate, &drift);
            print_message("    rate %g: %.4f left, by the exponential %.4f; drift %.1e\n", rate, left,
                          exp(-0.1 * rate), drift);
            hair_test_near("left", 0, left, exp(-0.1 * rate), 0.02);
            hair_test_near("drift", 0, drift, 0, 1e-3);
        }
    double drift;
    hair_test_near("left", 0, slowing(*state, HAIR_SOLVER_DIRECT, 0.1, 0, &drift), 1, 1e-4);
}

// Return the root mean square distance of the tips from their mean, after wind has blown hair
// against a ball.
static double spread(struct hair_test* test, float volume)
{
    struct hair_test_living living;
    hair_physics physics = hair_physics_default();
    hair_collider wall[2] = {hair_collider_default()};
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.hair_hair.pressure_stiffness = volume;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_hair_grid(test, &desc, 0.04f, &living);
    // Two walls leave half of the width.
    wall[0].size[0] = 1;
    wall[1] = wall[0];
    wall[0].position[0] = -0.99f, wall[1].position[0] = 1.03f;
    wall[0].position[1] = wall[1].position[1] = -0.08f;
    wall[0].position[2] = wall[1].position[2] = 0.02f;
    hair_test_ok(test, hair_set_colliders(living.hair, wall, 2, sizeof *wall));
    hair_test_wait(&living, 90);
    hair_test_read_guides(&living);
    double sum = 0, mean[3] = {0}, guides = living.groom->info.guide_count;
    for (uint32_t i = 0; i < guides; ++i) {
        hair_vec3 p = hair_test_tip(&living, i);
        mean[1] += (double)p.y / guides, mean[2] += (double)p.z / guides;
    }
    for (uint32_t i = 0; i < guides; ++i) {
        hair_vec3 p = hair_test_tip(&living, i);
        sum += pow((double)p.z - mean[2], 2) / guides;
    }
    hair_test_die(&living);
    return sqrt(sum);
}

static void pressure_stiffness_keeps_volume_of_pressed_hair(void** state)
{
    double without = spread(*state, 0), with = spread(*state, 0.3f);
    print_message("    between two walls: spread along them %.2f mm without, %.2f mm with\n", 1000 * without,
                  1000 * with);
    assert_true(with > 1.1 * without);
}

static void groom_at_rest_has_no_pressure(void** state)
{
    struct hair_test_living living;
    hair_physics physics = hair_physics_default();
    physics.hair_hair.cohesion = 10;
    physics.hair_hair.pressure_stiffness = 1;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_hair_grid(*state, &desc, 0.04f, &living);
    hair_test_wait(&living, 30);
    hair_test_read_guides(&living);
    hair_test_near("from rest", 0, hair_test_from_rest(&living), 0, 2e-4);
    hair_test_die(&living);
}

// Make clamped hair that falls and swings.
static void swing(struct hair_test_living* living, struct hair_test* test, hair_solver solver,
                  hair_thread_mapping mapping)
{
    hair_physics physics = hair_physics_default();
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.shape.gravity_preload = 0;
    physics.hair_hair.cohesion = 8;
    physics.hair_hair.pressure_stiffness = 0.2f;
    physics.gravity[0] = 7;
    hair_desc desc = hair_test_rods(solver, mapping, 0, &physics);
    hair_test_hair_grid(test, &desc, 0.04f, living);
}

static double apart(const struct hair_test_living* a, const struct hair_test_living* b)
{
    double max = 0;
    for (uint32_t i = 0; i < 3 * a->vertices; ++i)
        max = fmax(max, fabs((double)a->positions[i] - (double)b->positions[i]));
    return max;
}

// Check a single strand that swings through the grid, oblique to its axes.
static void lone_strand_feels_no_hair_force(void** state)
{
    struct hair_test_living living[2];
    double max = 0;
    for (int on = 0; on < 2; ++on) {
        struct hair_test_strands strand = hair_test_straight(16, hair_v3(0, 0, 0), hair_v3(2, -1, 1), 0.2f);
        hair_physics physics = hair_test_bare();
        physics.hair_hair.cohesion = on ? 20.0f : 0;
        physics.hair_hair.pressure_stiffness = on ? 1.0f : 0;
        hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
        hair_test_live(*state, &strand, &desc, &living[on]);
        hair_test_strands_free(&strand);
    }
    for (int k = 0; k < 30; ++k) {
        for (int on = 0; on < 2; ++on) hair_test_wait(&living[on], 1), hair_test_read_guides(&living[on]);
        const struct hair_sim* sim = &living[1].hair->sim;
        hair_vec4* push = hair_test_buffer(sim->hair_grid.acceleration, sim->guide_vertices * sizeof *push);
        for (uint32_t i = 0; i < sim->guide_vertices; ++i)
            max = fmax(max, hypot(hypot((double)push[i].x, (double)push[i].y), (double)push[i].z));
        free(push);
    }
    print_message("    accelerated by %.1e m/s^2, led %.1e m away\n", max, apart(&living[0], &living[1]));
    assert_true(hair_test_moved(&living[0]) > 1e-3);
    hair_test_near("acceleration", 0, max, 0, 1e-3);
    hair_test_near("way", 0, apart(&living[0], &living[1]), 0, 1e-5);
    for (int on = 0; on < 2; ++on) hair_test_die(&living[on]);
}

// Check a strand that is not finite. Only this strand is put back, and accelerations of the others
// stay within bounds.
static void nonfinite_strand_does_not_affect_others(void** state)
{
    static const float bad[] = {NAN, INFINITY, -3e38f};
    struct hair_test_living sound, hurt;
    double max = 0;
    swing(&sound, *state, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE);
    hair_test_wait(&sound, 20);
    hair_test_read_guides(&sound);
    for (int n = 0; n < 9; ++n) {
        swing(&hurt, *state, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE);
        hair_test_wait(&hurt, 18);
        struct hair_sim* sim = &hurt.hair->sim;
        GLintptr one = 7 * HAIR_TEST_HAIR_GRID_VERTICES + 5;
        GLuint at[] = {sim->state, sim->state, sim->history};
        GLintptr byte[] = {0, offsetof(struct hair_state, displacement), 0};
        glFinish();
        glNamedBufferSubData(at[n / 3], 32 * one + byte[n / 3], sizeof *bad, &bad[n % 3]);
        hair_test_wait(&hurt, 2);
        hair_test_read_guides(&hurt);
        assert_in_range(hair_test_solver_stats(&hurt).reset, 0, 1);
        for (uint32_t i = 0; i < hurt.vertices; ++i) {
            hair_vec3 a = hair_load3(hurt.positions + 3 * i), b = hair_load3(sound.positions + 3 * i);
            if (i / HAIR_TEST_HAIR_GRID_VERTICES != 7) max = fmax(max, (double)hair_length(hair_sub(a, b)));
        }
        hair_test_die(&hurt);
    }
    print_message("    the others are led %.1e m away\n", max);
    hair_test_near("way", 0, max, 0, 1e-4);
    hair_test_die(&sound);
}

static struct hair_test_subject moving(hair_solver solver, float cohesion, float volume)
{
    struct hair_test_subject subject = hair_test_subject_of(0);
    subject.desc.solver = solver;
    subject.desc.substep = 0;
    subject.physics.hair_hair.cohesion = cohesion;
    subject.physics.hair_hair.pressure_stiffness = volume;
    return subject;
}

static void run(struct hair_test* test, const struct hair_test_subject* subject, struct hair_test_seen* seen)
{
    hair_instance* hair = hair_test_subject_make(test, subject);
    hair_test_run(test, hair, subject, 0, 12);
    hair_test_look(test, hair, seen);
    hair_test_finite(seen);
    hair_destroy(hair);
}

static void equal_inputs_give_equal_bits(void** state)
{
    static struct hair_test_seen a, b;
    for (int solver = 0; solver <= HAIR_SOLVER_FOLLOW; ++solver)
        for (int mapping = solver == HAIR_SOLVER_DIRECT ? HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE
                                                        : HAIR_THREAD_MAPPING_THREAD_PER_GUIDE;
             mapping <= HAIR_THREAD_MAPPING_THREAD_PER_GUIDE; ++mapping) {
            struct hair_test_subject subject = moving((hair_solver)solver, 10, 0.3f);
            subject.desc.thread_mapping = (hair_thread_mapping)mapping;
            run(*state, &subject, &a);
            run(*state, &subject, &b);
            hair_test_same(&a, &b);
        }
}

static void greatest_settings_keep_hair_finite(void** state)
{
    static struct hair_test_seen seen;
    for (int solver = 0; solver <= HAIR_SOLVER_FOLLOW; ++solver) {
        struct hair_test_subject subject = moving((hair_solver)solver, 1000, 100);
        run(*state, &subject, &seen);
    }
}

static void motion_depends_neither_on_the_frame_rate_nor_on_the_mapping(void** state)
{
    // Number of parts that frames of 1/60 s are divided into. 4 and 5 divide blocks.
    static const int per[] = {1, 2, 4, 5};
    struct hair_test_living once, other;
    swing(&once, *state, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE);
    hair_test_wait(&once, 40);
    hair_test_read_guides(&once);
    assert_true(hair_test_moved(&once) > 0.01);
    for (size_t k = 1; k < sizeof per / sizeof *per; ++k) {
        swing(&other, *state, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE);
        for (int i = 0; i < 40 * per[k]; ++i) hair_test_advance(&other, NULL, 1.0 / 60 / per[k]);
        hair_test_read_guides(&other);
        hair_test_near("frames", k, apart(&once, &other), 0, 1e-6);
        hair_test_die(&other);
    }
    swing(&other, *state, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE);
    hair_test_wait(&other, 40);
    hair_test_read_guides(&other);
    print_message("    a group and a thread per guide: %.1e m apart\n", apart(&once, &other));
    hair_test_near("mapping", 0, apart(&once, &other), 0, 1e-3);
    hair_test_die(&other);
    hair_test_die(&once);
}

static void state_saved_between_grid_updates_continues_bit_for_bit(void** state)
{
    struct hair_test_living straight, loaded;
    swing(&straight, *state, HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE);
    swing(&loaded, *state, HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE);
    for (int i = 0; i < 10; ++i) hair_test_advance(&straight, NULL, 1.0 / 144);
    assert_int_not_equal(straight.hair->sim.hair_grid.substeps_done, 0);
    struct hair_test_blob blob = hair_test_save(*state, straight.hair);
    hair_test_ok(*state, hair_load(loaded.hair, blob.bytes, blob.size));
    for (int i = 0; i < 10; ++i) hair_test_advance(&straight, NULL, 1.0 / 144);
    for (int i = 0; i < 10; ++i) hair_test_advance(&loaded, NULL, 1.0 / 144);
    hair_test_read_guides(&straight);
    hair_test_read_guides(&loaded);
    assert_memory_equal(straight.positions, loaded.positions, 3 * sizeof(float) * straight.vertices);
    // An instance without the hair-hair grid goes on without it.
    hair_physics off = straight.physics;
    hair_test_die(&loaded);
    off.hair_hair.cohesion = off.hair_hair.pressure_stiffness = 0;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 0, &off);
    hair_test_hair_grid(*state, &desc, 0.04f, &loaded);
    hair_test_ok(*state, hair_load(loaded.hair, blob.bytes, blob.size));
    assert_int_equal(loaded.hair->sim.hair_grid.substeps_done, 0);
    hair_test_wait(&loaded, 3);
    hair_test_die(&loaded);
    hair_test_die(&straight);
    free(blob.bytes);
}

static void disabled_hair_grid_has_no_buffer_and_no_effect(void** state)
{
    static struct hair_test_seen never, off;
    struct hair_test_subject subject = moving(HAIR_SOLVER_DIRECT, 0, 0);
    run(*state, &subject, &never);
    // The physics are turned on and off before any step. The buffers exist, but nothing reads them.
    hair_instance* hair = hair_test_subject_make(*state, &subject);
    assert_int_equal(hair->sim.hair_grid.texture, 0);
    assert_int_equal(hair->sim.hair_grid.grid, 0);
    subject.physics.hair_hair.cohesion = 50;
    hair_test_ok(*state, hair_set_physics(hair, &subject.physics));
    hair_test_ok(*state, hair_step(hair, 0.01f));
    assert_int_not_equal(hair->sim.hair_grid.texture, 0);
    subject.physics.hair_hair.cohesion = 0;
    hair_test_ok(*state, hair_set_physics(hair, &subject.physics));
    hair_test_ok(*state, hair_reset(hair));
    hair_test_run(*state, hair, &subject, 0, 12);
    hair_test_look(*state, hair, &off);
    hair_test_same(&never, &off);
    hair_destroy(hair);
    subject = moving(HAIR_SOLVER_REDBLACK, 100, 1); // This solver has no hair-hair grid.
    hair = hair_test_subject_make(*state, &subject);
    hair_test_ok(*state, hair_step(hair, 0.02f));
    assert_int_equal(hair->sim.hair_grid.texture, 0);
    hair_destroy(hair);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(relative_motion_decays_at_the_rate_of_cohesion),
        HAIR_TEST(pressure_stiffness_keeps_volume_of_pressed_hair),
        HAIR_TEST(groom_at_rest_has_no_pressure),
        HAIR_TEST(lone_strand_feels_no_hair_force),
        HAIR_TEST(nonfinite_strand_does_not_affect_others),
        HAIR_TEST(equal_inputs_give_equal_bits),
        HAIR_TEST(greatest_settings_keep_hair_finite),
        HAIR_TEST(motion_depends_neither_on_the_frame_rate_nor_on_the_mapping),
        HAIR_TEST(state_saved_between_grid_updates_continues_bit_for_bit),
        HAIR_TEST(disabled_hair_grid_has_no_buffer_and_no_effect),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
