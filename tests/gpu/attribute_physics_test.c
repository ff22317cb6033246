// attribute_physics_test.c - guides whose physics differ by attributes of strands and by maps.
#include "tests/support/beams.h"
#include "tests/support/passes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define STEP HAIR_TEST_BEAM_STEP
#define GUIDES 6
#define VERTICES 16
#define KINDS 4

// Factors of guides 0 and 5, 1 and 4, and 2 and 3, by hair_strand_attribute_kind.
static const float factors[3][KINDS] = {{1, 1, 1, 1}, {0.25f, 3, 0, 0.5f}, {2, 0.2f, 1.5f, 1}};

static uint32_t set_of(uint32_t guide)
{
    return guide < 3 ? guide : GUIDES - 1 - guide;
}

// Values of the guides by attribute.
struct values {
    float of[KINDS][GUIDES];
    hair_strand_attribute attributes[KINDS];
};

// Write `count` attributes of strands.
static void fill_values(struct values* values, int count)
{
    for (int k = 0; k < count; ++k) {
        for (uint32_t g = 0; g < GUIDES; ++g) values->of[k][g] = factors[set_of(g)][k];
        values->attributes[k] = hair_strand_attribute_default();
        values->attributes[k].kind = (hair_strand_attribute_kind)k;
        values->attributes[k].strand_values = values->of[k];
    }
}

// Return straight strands and curls in turn.
static struct hair_test_strands make_strands(void)
{
    struct hair_test_strands strands = hair_test_strands_make(GUIDES, VERTICES);
    for (uint32_t g = 0; g < GUIDES; ++g) {
        for (uint32_t i = 0; i < VERTICES; ++i) {
            float t = (float)i / (VERTICES - 1), curl = g % 2 ? 0.01f : 0;
            hair_store3(strands.positions + 3 * (size_t)strands.vertex_count++,
                        hair_v3(0.05f * (float)g + curl * (1 - cosf(7 * t)) + 0.03f * t, 0.1f - 0.12f * t,
                                curl * sinf(7 * t)));
        }
        strands.vertices[strands.count++] = VERTICES;
    }
    return strands;
}

static void pin(struct hair_test_living* living)
{
    hair_pin pins[3] = {hair_pin_default(), hair_pin_default(), hair_pin_default()};
    for (uint32_t i = 0; i < 3; ++i) {
        pins[i].guide = 2 * i + 1, pins[i].vertex = 9;
        hair_store3(pins[i].position,
                    hair_add(hair_v3(0, 0, 0.02f), hair_test_at(living, pins[i].guide, pins[i].vertex)));
    }
    hair_test_ok(living->test, hair_set_pins(living->hair, pins, 3, sizeof *pins));
}

// Return the physics of the guides of a set.
static hair_physics multiplied(hair_physics physics, uint32_t set)
{
    physics.fiber.youngs_modulus *= factors[set][HAIR_STRAND_ATTRIBUTE_STIFFNESS];
    physics.damping *= factors[set][HAIR_STRAND_ATTRIBUTE_DAMPING];
    physics.shape.frequency_root *= factors[set][HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY];
    physics.shape.frequency_tip *= factors[set][HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY];
    physics.shape.gravity_preload *= factors[set][HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD];
    return physics;
}

// Compare guides that have factors with an instance whose guides all have the multiplied physics.
// Dampings that differ by guide are computed by other programs, whose results round differently.
static void check_guides_alone(struct hair_test* test, hair_solver solver, bool is_pinned)
{
    struct hair_test_strands strands = make_strands();
    struct hair_test_living together, alone;
    struct values values;
    hair_physics usual = hair_physics_default(), physics = usual;
    usual.sleep_threshold = 0, usual.shape.gravity_preload = 0.9f;
    fill_values(&values, KINDS);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &usual);
    strands.attributes = values.attributes, strands.attribute_count = KINDS;
    hair_test_live(test, &strands, &desc, &together);
    if (is_pinned) pin(&together);
    hair_test_swing(&together);
    strands.attribute_count = 0;
    double equal = 0, other = 1;
    for (uint32_t set = 0; set < 3; ++set) {
        physics = multiplied(usual, set);
        desc.physics = &physics;
        hair_test_live(test, &strands, &desc, &alone);
        if (is_pinned) pin(&alone);
        hair_test_swing(&alone);
        for (uint32_t g = 0; g < GUIDES; ++g) {
            double difference = 0;
            for (uint32_t i = 0; i < VERTICES; ++i)
                difference = fmax(difference, (double)hair_distance(hair_test_at(&together, g, i),
                                                                    hair_test_at(&alone, g, i)));
            if (set_of(g) == set)
                equal = fmax(equal, difference);
            else
                other = fmin(other, difference);
        }
        hair_test_die(&alone);
    }
    printf("solver %d: at most %.1e m off, at least %.1e m from other factors\n", (int)solver, equal, other);
    assert_true(equal < 2e-6 && other > 1e-4);
    hair_test_die(&together);
    hair_test_strands_free(&strands);
}

static void guides_move_like_instances_of_their_physics(void** state)
{
    check_guides_alone(*state, HAIR_SOLVER_DIRECT, false);
    check_guides_alone(*state, HAIR_SOLVER_DIRECT, true);
    check_guides_alone(*state, HAIR_SOLVER_ACCURATE, false);
    check_guides_alone(*state, HAIR_SOLVER_FOLLOW, false);
}

// Multiply the frequency by strands, by a map that is linear in x, and by a group.
static void guides_swing_at_their_frequency(void** state)
{
    static const uint8_t groups[HAIR_TEST_BEAMS] = {0, 3, 0};
    static const float of_strands[HAIR_TEST_BEAMS] = {1, 0.75f, 1.25f};
    struct hair_test_strands strands = hair_test_beams(groups);
    struct hair_test_scalp scalp = hair_test_scalp_make(4, 0.4f);
    struct hair_test_living living;
    hair_strand_attribute attributes[2] = {hair_strand_attribute_default(), hair_strand_attribute_default()};
    float map[25];
    for (int i = 0; i < 25; ++i) map[i] = 1 + 5 * scalp.positions[3 * i];
    for (int k = 0; k < 2; ++k) attributes[k].kind = HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY;
    attributes[0].strand_values = of_strands;
    attributes[1].map.source = HAIR_MAP_SOURCE_VERTICES, attributes[1].map.values = map;
    strands.attributes = attributes, strands.attribute_count = 2, strands.scalp = &scalp;
    hair_physics physics = hair_test_without_forces(), own = physics;
    physics.fiber.youngs_modulus = 0;
    physics.shape.frequency_root = physics.shape.frequency_tip = 2;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    own = physics, own.shape.frequency_root = own.shape.frequency_tip = 3;
    hair_test_ok(*state, hair_set_group_physics(living.hair, 3, &own));
    double hz[HAIR_TEST_BEAMS];
    hair_test_measure_frequencies(&living, hz);
    printf("%.3f, %.3f and %.3f Hz\n", hz[0], hz[1], hz[2]);
    hair_test_near("frequency of beam", 0, hz[0], 2, 0.02);
    hair_test_near("frequency of beam", 1, hz[1], 3 * 0.75 * 1.5, 0.03);
    hair_test_near("frequency of beam", 2, hz[2], 2 * 1.25 * 2, 0.05);
    hair_test_die(&living);
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
}

// Check bending of clamped beams. Four times the stiffness doubles the frequency.
static void guides_bend_at_the_frequency_of_their_stiffness(void** state)
{
    static const float of_strands[HAIR_TEST_BEAMS] = {1, 4, 0.25f};
    struct hair_test_strands strands = hair_test_beams(NULL);
    struct hair_test_living living;
    hair_strand_attribute stiffness = hair_strand_attribute_default();
    stiffness.strand_values = of_strands;
    strands.attributes = &stiffness, strands.attribute_count = 1;
    hair_physics physics = hair_test_without_forces();
    physics.fiber.youngs_modulus = 4e8f;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    double hz[HAIR_TEST_BEAMS];
    hair_test_measure_frequencies(&living, hz);
    printf("%.3f, %.3f and %.3f Hz\n", hz[0], hz[1], hz[2]);
    hair_test_near("ratio of beam", 1, hz[1] / hz[0], 2, 0.04);
    hair_test_near("ratio of beam", 2, hz[2] / hz[0], 0.5, 0.01);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

// Check level beams, whose tips sag by rho g L^4 / (2 E r^2) under the part of gravity that their
// rest shape does not balance.
static void guides_sag_by_the_gravity_that_they_do_not_balance(void** state)
{
    static const float of_strands[HAIR_TEST_BEAMS] = {0, 0.5f, 1};
    const double length = 0.03, radius = 4e-5;
    const double full = 1300 * 9.81 * pow(length, 4) / (2 * 4e9 * radius * radius);
    struct hair_test_strands strands = hair_test_strands_make(HAIR_TEST_BEAMS, 17);
    struct hair_test_living living;
    hair_strand_attribute preload = hair_strand_attribute_default();
    for (int g = 0; g < HAIR_TEST_BEAMS; ++g)
        hair_test_add_straight(&strands, 17, hair_v3(0.1f * (float)g, 0, 0), hair_v3(0, 0, 1), (float)length);
    preload.kind = HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD, preload.strand_values = of_strands;
    strands.attributes = &preload, strands.attribute_count = 1;
    hair_physics physics = hair_test_without_forces();
    physics.gravity[1] = -9.81f, physics.damping = 30;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, STEP, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    hair_test_wait(&living, 90);
    hair_test_read_guides(&living);
    for (uint32_t g = 0; g < HAIR_TEST_BEAMS; ++g) {
        double sag = -(double)hair_test_tip(&living, g).y;
        printf("preload %.1f: %.4f mm\n", (double)of_strands[g], 1e3 * sag);
        // Half of the first of 16 segments is clamped.
        hair_test_near("sag of beam", g, sag, (1 - (double)of_strands[g]) * full, 0.08 * full);
    }
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

// Let guides that nothing holds fall, and then move without gravity. Their speeds decay at their
// own rate.
static void speeds_decay_at_the_damping_of_their_guide(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_strands strands = make_strands();
    struct hair_test_living living;
    struct values values;
    fill_values(&values, KINDS);
    strands.attributes = &values.attributes[HAIR_STRAND_ATTRIBUTE_DAMPING], strands.attribute_count = 1;
    hair_physics physics = hair_test_without_forces();
    physics.gravity[1] = -9.81f, physics.root = HAIR_ROOT_FREE, physics.damping = 1;
    physics.shape.gravity_preload = 0;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, STEP / 4, &physics);
    hair_test_live(test, &strands, &desc, &living);
    hair_test_wait(&living, 12);
    physics.gravity[1] = 0;
    hair_test_ok(test, hair_set_physics(living.hair, &physics));
    hair_test_wait(&living, 6);
    double y[3][GUIDES];
    for (int k = 0; k < 3; ++k) {
        hair_test_read_guides(&living);
        for (uint32_t g = 0; g < GUIDES; ++g) {
            y[k][g] = 0;
            for (uint32_t i = 0; i < VERTICES; ++i)
                y[k][g] += (double)hair_test_at(&living, g, i).y / VERTICES;
        }
        hair_test_wait(&living, 15);
    }
    for (uint32_t g = 0; g < GUIDES; ++g) {
        double found = log((y[0][g] - y[1][g]) / (y[1][g] - y[2][g])) / 0.25;
        double rate = (double)factors[set_of(g)][HAIR_STRAND_ATTRIBUTE_DAMPING];
        printf("guide %u: %.4f 1/s, not %.4f\n", g, found, rate);
        hair_test_near("rate", g, found, rate, 0.02);
    }
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

// Check that factors of 1 give the bits, bytes and programs of no factors, that no factors take
// memory of the GPU, and that the motion continues after a state is loaded.
static void factors_cost_no_memory_and_stay_with_a_state(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_living without, with;
    struct hair_test_strands strands = make_strands();
    struct values values;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, NULL);
    uint64_t before = hair_test_gpu_bytes(test);
    hair_test_live(test, &strands, &desc, &without);
    hair_test_swing(&without);
    uint64_t bytes = hair_test_gpu_bytes(test) - before;
    fill_values(&values, KINDS);
    strands.attributes = values.attributes, strands.attribute_count = KINDS;
    const uint32_t runs = hair_test_runs_of(&test->context->gl, "_group_damping");
    for (int is_used = 0; is_used < 2; ++is_used) {
        for (uint32_t g = 0; g < GUIDES && !is_used; ++g)
            for (int k = 0; k < KINDS; ++k) values.of[k][g] = 1;
        if (is_used) fill_values(&values, KINDS);
        hair_test_live(test, &strands, &desc, &with);
        hair_test_swing(&with);
        assert_int_equal(hair_test_gpu_bytes(test) - before, 2 * bytes);
        bool is_equal = memcmp(with.positions, without.positions, 3 * with.vertices * sizeof(float)) == 0;
        assert_int_equal(is_equal, !is_used);
        assert_int_equal(hair_test_runs_of(&test->context->gl, "_group_damping") > runs, is_used);
        size_t size = 0;
        hair_test_ok(test, hair_save(with.hair, NULL, 0, &size));
        void* saved = malloc(size);
        hair_test_ok(test, hair_save(with.hair, saved, size, &size));
        hair_test_swing(&with);
        hair_test_ok(test, hair_load(with.hair, saved, size));
        hair_test_swing(&with);
        assert_memory_equal(with.positions, with.before, 3 * with.vertices * sizeof(float));
        free(saved);
        hair_test_die(&with);
    }
    hair_test_die(&without);
    hair_test_strands_free(&strands);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(guides_move_like_instances_of_their_physics),
        HAIR_TEST(guides_swing_at_their_frequency),
        HAIR_TEST(guides_bend_at_the_frequency_of_their_stiffness),
        HAIR_TEST(guides_sag_by_the_gravity_that_they_do_not_balance),
        HAIR_TEST(speeds_decay_at_the_damping_of_their_guide),
        HAIR_TEST(factors_cost_no_memory_and_stay_with_a_state),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
