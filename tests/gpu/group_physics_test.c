// group_physics_test.c - groups of strands with physics of their own in one instance.
#include "tests/support/beams.h"
#include "tests/support/passes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define STEP HAIR_TEST_BEAM_STEP
#define GUIDES 6

// Groups of the six guides below.
static const uint8_t mixed_groups[GUIDES] = {0, 1, 2, 2, 1, 0};

// Return a straight strand and a curl of each group.
static struct hair_test_strands make_strands(const uint8_t* groups)
{
    struct hair_test_strands strands = hair_test_strands_make(GUIDES, 16);
    for (uint32_t g = 0; g < GUIDES; ++g)
        for (uint32_t i = 0; i < 16; ++i) {
            float t = (float)i / 15, curl = g % 2 ? 0.01f : 0;
            hair_store3(strands.positions + 3 * (size_t)strands.vertex_count++,
                        hair_v3(0.05f * (float)g + curl * (1 - cosf(7 * t)) + 0.03f * t, 0.1f - 0.12f * t,
                                curl * sinf(7 * t)));
        }
    for (uint32_t g = 0; g < GUIDES; ++g) strands.vertices[strands.count++] = 16;
    strands.groups = groups;
    return strands;
}

// Set the members that can differ by group for one of three groups.
static hair_physics physics_of(uint32_t group)
{
    hair_physics physics = hair_physics_default();
    if (group == 0) {
        physics.shape.frequency_root = 0, physics.shape.frequency_tip = 0;
    } else if (group == 1) {
        physics.fiber.youngs_modulus = 1e9f;
        physics.shape.stiffness_tip = 3;
        physics.shape.gravity_preload = 0.5f;
    } else if (group == 2) {
        physics.shape.stiffness_root = 2;
        physics.shape.frequency_root = 6, physics.shape.frequency_tip = 5;
        physics.tip_mass = 0.5f;
    }
    return physics;
}

static void set_groups(struct hair_test_living* living)
{
    for (uint32_t g = 1; g < 3; ++g) {
        hair_physics physics = physics_of(g);
        hair_test_ok(living->test, hair_set_group_physics(living->hair, g, &physics));
    }
}

static void pin(struct hair_test_living* living)
{
    hair_pin pins[2] = {hair_pin_default(), hair_pin_default()};
    pins[0].guide = 2, pins[0].vertex = 9;
    pins[1].guide = 5, pins[1].vertex = 12;
    for (int i = 0; i < 2; ++i)
        hair_store3(pins[i].position,
                    hair_add(hair_v3(0, 0, 0.02f), hair_test_at(living, pins[i].guide, pins[i].vertex)));
    hair_test_ok(living->test, hair_set_pins(living->hair, pins, 2, sizeof *pins));
}

// Compare each group with an instance whose guides all have the physics of the group.
static void check_groups_alone(struct hair_test* test, hair_solver solver, bool is_pinned)
{
    struct hair_test_strands strands = make_strands(mixed_groups);
    struct hair_test_living together, alone;
    hair_physics physics = physics_of(0);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(test, &strands, &desc, &together);
    set_groups(&together);
    if (is_pinned) pin(&together);
    hair_test_swing(&together);
    for (uint32_t group = 0; group < 3; ++group) {
        physics = physics_of(group);
        hair_test_live(test, &strands, &desc, &alone);
        if (is_pinned) pin(&alone);
        hair_test_swing(&alone);
        for (uint32_t g = 0; g < GUIDES; ++g) {
            bool is_equal = memcmp(together.positions + 48 * g, alone.positions + 48 * g, 48 * 4) == 0;
            if (is_equal != (mixed_groups[g] == group))
                fail_msg("solver %d: guide %u of group %u moves %s group %u", (int)solver, g, mixed_groups[g],
                         is_equal ? "like" : "unlike", group);
        }
        hair_test_die(&alone);
    }
    hair_test_die(&together);
    hair_test_strands_free(&strands);
}

static void groups_move_like_instances_of_their_physics(void** state)
{
    check_groups_alone(*state, HAIR_SOLVER_DIRECT, false);
    check_groups_alone(*state, HAIR_SOLVER_DIRECT, true);
    check_groups_alone(*state, HAIR_SOLVER_ACCURATE, false);
    check_groups_alone(*state, HAIR_SOLVER_FOLLOW, false);
}

static void groups_swing_at_their_frequency(void** state)
{
    static const uint8_t groups[HAIR_TEST_BEAMS] = {0, 5, 7};
    struct hair_test_strands strands = hair_test_beams(groups);
    struct hair_test_living living;
    hair_physics physics = hair_test_without_forces();
    physics.fiber.youngs_modulus = 0;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    static const float frequency[3] = {0, 2, 5};
    for (int g = 1; g < 3; ++g) {
        physics.shape.frequency_root = physics.shape.frequency_tip = frequency[g];
        hair_test_ok(*state, hair_set_group_physics(living.hair, groups[g], &physics));
    }
    physics.shape.frequency_root = physics.shape.frequency_tip = 3;
    hair_test_ok(*state, hair_set_physics(living.hair, &physics)); // Group 0 has not been set.
    double hz[HAIR_TEST_BEAMS];
    hair_test_measure_frequencies(&living, hz);
    printf("%.3f, %.3f and %.3f Hz\n", hz[0], hz[1], hz[2]);
    hair_test_near("frequency of group", 0, hz[0], 3, 0.03);
    hair_test_near("frequency of group", 5, hz[1], 2, 0.02);
    hair_test_near("frequency of group", 7, hz[2], 5, 0.05);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

// Check bending of clamped beams. Four times the stiffness doubles the frequency, and twice the
// mass at the tip lowers it.
static void groups_bend_at_the_frequency_of_their_stiffness(void** state)
{
    static const uint8_t groups[HAIR_TEST_BEAMS] = {0, 1, 2};
    struct hair_test_strands strands = hair_test_beams(groups);
    struct hair_test_living living;
    hair_physics physics = hair_test_without_forces();
    physics.fiber.youngs_modulus = 4e8f;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    hair_physics own = physics;
    own.fiber.youngs_modulus *= 4;
    hair_test_ok(*state, hair_set_group_physics(living.hair, 1, &own));
    own = physics, own.tip_mass = 1;
    hair_test_ok(*state, hair_set_group_physics(living.hair, 2, &own));
    double hz[HAIR_TEST_BEAMS];
    hair_test_measure_frequencies(&living, hz);
    // The first squared frequency of a beam of mass m with the mass M at its tip is near
    // 3 EI / (L^3 (M + 0.243 m)).
    printf("%.3f, %.3f and %.3f Hz\n", hz[0], hz[1], hz[2]);
    hair_test_near("ratio for the stiffness", 0, hz[1] / hz[0], 2, 0.04);
    hair_test_near("ratio for the mass", 0, hz[2] / hz[0], sqrt(0.243 / 1.243), 0.03);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

// Let guides that nothing holds fall, and then move without gravity. Their speeds decay at the rate
// of their group. One guide of each group is curled.
static void check_decay(struct hair_test* test, hair_solver solver)
{
    static const float rate[3] = {1, 3, 0};
    struct hair_test_strands strands = make_strands(mixed_groups);
    struct hair_test_living living;
    hair_physics physics = hair_test_without_forces();
    physics.gravity[1] = -9.81f, physics.root = HAIR_ROOT_FREE, physics.damping = rate[0];
    physics.shape.gravity_preload = 0;
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(test, &strands, &desc, &living);
    for (uint32_t g = 1; g < 3; ++g) {
        physics.damping = rate[g];
        hair_test_ok(test, hair_set_group_physics(living.hair, g, &physics));
    }
    hair_test_wait(&living, 12);
    physics.gravity[1] = 0, physics.damping = rate[0];
    hair_test_ok(test, hair_set_physics(living.hair, &physics));
    hair_test_wait(&living, 6);
    double y[3][GUIDES];
    for (int k = 0; k < 3; ++k) {
        hair_test_read_guides(&living);
        for (uint32_t g = 0; g < GUIDES; ++g) {
            y[k][g] = 0;
            for (uint32_t i = 0; i < 16; ++i) y[k][g] += (double)hair_test_at(&living, g, i).y / 16;
        }
        hair_test_wait(&living, 15);
    }
    for (uint32_t g = 0; g < GUIDES; ++g) {
        double found = log((y[0][g] - y[1][g]) / (y[1][g] - y[2][g])) / 0.25;
        printf("solver %d, group %u: %.4f 1/s\n", (int)solver, mixed_groups[g], found);
        hair_test_near("rate", g, found, (double)rate[mixed_groups[g]], 0.02);
    }
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

static void speeds_decay_at_the_damping_of_their_group(void** state)
{
    const struct hair_gl* gl = &((struct hair_test*)*state)->context->gl;
    uint32_t runs = hair_test_runs_of(gl, "_group_damping");
    check_decay(*state, HAIR_SOLVER_DIRECT);
    check_decay(*state, HAIR_SOLVER_ACCURATE);
    check_decay(*state, HAIR_SOLVER_FOLLOW);
    assert_true(hair_test_runs_of(gl, "_group_damping") > runs);
}

// Check that groups whose physics are those of the instance give the same bits, bytes and rods as
// no groups.
static void equal_groups_give_the_bits_of_none(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_living without, with;
    struct hair_test_strands strands = make_strands(NULL);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, NULL);
    uint64_t before = hair_test_gpu_bytes(test);
    hair_test_live(test, &strands, &desc, &without);
    hair_test_swing(&without);
    uint64_t bytes = hair_test_gpu_bytes(test) - before;
    strands.groups = mixed_groups;
    hair_test_live(test, &strands, &desc, &with);
    hair_physics physics = with.physics, other = physics;
    GLuint rods = with.hair->sim.rod;
    for (uint32_t g = 0; g < 3; ++g) hair_test_ok(test, hair_set_group_physics(with.hair, g, &physics));
    // Other physics that are taken back before a step are never used.
    other.shape.stiffness_root = 7;
    hair_test_ok(test, hair_set_group_physics(with.hair, 1, &other));
    hair_test_ok(test, hair_set_group_physics(with.hair, 1, NULL));
    hair_test_ok(test, hair_set_group_physics(with.hair, 6, NULL));
    uint32_t runs = hair_test_runs_of(&test->context->gl, "_group_damping");
    hair_test_swing(&with);
    assert_int_equal(hair_test_runs_of(&test->context->gl, "_group_damping"), runs);
    assert_int_equal(with.hair->sim.rod, rods);
    assert_int_equal(hair_test_gpu_bytes(test) - before, 2 * bytes);
    assert_memory_equal(with.positions, without.positions, 3 * with.vertices * sizeof(float));
    hair_test_die(&with);
    hair_test_die(&without);
    hair_test_strands_free(&strands);
}

// Check that groups keep their physics when a state is loaded and when others change.
static void groups_keep_their_physics(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_living living;
    struct hair_test_strands strands = make_strands(mixed_groups);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, NULL);
    hair_test_live(test, &strands, &desc, &living);
    set_groups(&living);
    hair_test_swing(&living);
    size_t size = 0;
    hair_test_ok(test, hair_save(living.hair, NULL, 0, &size));
    void* bytes = malloc(size);
    hair_test_ok(test, hair_save(living.hair, bytes, size, &size));
    hair_test_swing(&living);
    hair_test_ok(test, hair_load(living.hair, bytes, size));
    hair_test_swing(&living);
    assert_memory_equal(living.positions, living.before, 3 * living.vertices * sizeof(float));
    free(bytes);

    hair_physics physics = physics_of(0), got = hair_physics_default();
    physics.drag = 9, physics.shape.stiffness_tip = 5;
    hair_test_ok(test, hair_set_physics(living.hair, &physics));
    hair_test_ok(test, hair_get_group_physics(living.hair, 0, &got));
    assert_memory_equal(&got, &physics, sizeof got);
    physics = physics_of(1), physics.drag = 9;
    hair_test_ok(test, hair_get_group_physics(living.hair, 1, &got));
    assert_memory_equal(&got, &physics, sizeof got);
    hair_test_ok(test, hair_get_physics(living.hair, &got));
    hair_test_ok(test, hair_set_group_physics(living.hair, 1, NULL));
    hair_test_ok(test, hair_get_group_physics(living.hair, 1, &physics));
    assert_memory_equal(&got, &physics, sizeof got);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

static void wrong_physics_of_groups_are_refused(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_living living;
    struct hair_test_strands strands = make_strands(mixed_groups);
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, NULL);
    hair_test_live(test, &strands, &desc, &living);
    hair_instance* hair = living.hair;
    hair_test_refused(test, hair_set_group_physics(hair, 8, &physics), HAIR_ERROR_ARGUMENT,
                      "group is 8, not in [0, 7]");
    hair_test_refused(test, hair_get_group_physics(hair, UINT32_MAX, &physics), HAIR_ERROR_ARGUMENT,
                      "group is 4294967295, not in [0, 7]");
    physics.shape.stiffness_tip = -1;
    hair_test_refused(test, hair_set_group_physics(hair, 1, &physics), HAIR_ERROR_ARGUMENT,
                      "hair_physics.shape.stiffness_tip is -1, not in [0, 10000]");
    physics.shape.stiffness_tip = 1, physics.drag = 7;
    hair_test_refused(test, hair_set_group_physics(hair, 1, &physics), HAIR_ERROR_ARGUMENT,
                      "hair_physics.drag is 7 for group 1 but 0.1 for the instance, and this member cannot "
                      "differ by group");
    physics.drag = 0.1f, physics.root = HAIR_ROOT_HINGED;
    hair_test_refused(test, hair_set_group_physics(hair, 1, &physics), HAIR_ERROR_ARGUMENT,
                      "hair_physics.root is hinged for group 1 but clamped for the instance");
    hair_test_die(&living);
    physics.root = HAIR_ROOT_CLAMPED;
    desc.solver = HAIR_SOLVER_REDBLACK;
    hair_test_live(test, &strands, &desc, &living);
    hair_test_refused(test, hair_set_group_physics(living.hair, 1, &physics), HAIR_ERROR_ARGUMENT,
                      "redblack");
    hair_test_die(&living);
    hair_test_strands_free(&strands);
    assert_int_equal(hair_set_group_physics(NULL, 0, &physics), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_group_physics(NULL, 0, &physics), HAIR_ERROR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(groups_move_like_instances_of_their_physics),
        HAIR_TEST(groups_swing_at_their_frequency),
        HAIR_TEST(speeds_decay_at_the_damping_of_their_group),
        HAIR_TEST(groups_bend_at_the_frequency_of_their_stiffness),
        HAIR_TEST(equal_groups_give_the_bits_of_none),
        HAIR_TEST(groups_keep_their_physics),
        HAIR_TEST(wrong_physics_of_groups_are_refused),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
