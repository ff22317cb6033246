// rod_pins_test.c - guides with pinned vertices: to the head, to the world, as a catenary between
// two ends, too far apart, and released.
#include "tests/support/live_hair.h"
#include "tests/support/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAME (1.0 / 60)
#define LENGTH 0.3f // Metres.
#define WAYS 6 // Number of solvers times mappings.
// Number of solvers. Their mappings alternate between work group and thread: ways 0, 3, 4.
#define SOLVERS 3

static hair_desc way_of(int way, const hair_physics* physics)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW};
    return hair_test_rods(
        solvers[way / 2],
        way % 2 ? HAIR_THREAD_MAPPING_THREAD_PER_GUIDE : HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, physics);
}

static int each(int solver)
{
    return 2 * solver + solver % 2;
}

static hair_pin pin_of(uint32_t guide, uint32_t vertex, hair_pin_to to, hair_vec3 position)
{
    hair_pin pin = hair_pin_default();
    pin.guide = guide;
    pin.vertex = vertex;
    pin.to = to;
    hair_store3(pin.position, position);
    return pin;
}

static void set_pin(struct hair_test_living* living, hair_pin pin)
{
    hair_test_ok(living->test, hair_set_pins(living->hair, &pin, 1, sizeof pin));
}

static void pin_tip(struct hair_test_living* living, hair_pin_to to, hair_vec3 position)
{
    set_pin(living, pin_of(0, UINT32_MAX, to, position));
}

static double apart(hair_vec3 a, hair_vec3 b)
{
    return (double)hair_length(hair_sub(a, b));
}

static hair_vec3 in_world(const struct hair_reference_rod_pose* head, hair_vec3 at)
{
    const double *q = head->rotation, *p = head->position;
    hair_quat turn = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
    return hair_add(hair_v3((float)p[0], (float)p[1], (float)p[2]), hair_rotate(turn, at));
}

static void live(struct hair_test* test, uint32_t count, uint32_t vertices, hair_vec3 along,
                 const hair_desc* desc, struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_strands_make(count, vertices);
    for (uint32_t i = 0; i < count; ++i)
        hair_test_add_straight(&strands, vertices, hair_v3(0, 0, 0.01f * (float)i), along, LENGTH);
    hair_test_live(test, &strands, desc, out);
    hair_test_strands_free(&strands);
}

// Pin the tip for a second on a shaken head, first to the head and then to a hand that moves.
static void hold_tip(struct hair_test_living* living)
{
    hair_vec3 at = hair_v3(0.2f, -0.05f, 0.02f);
    double of_head = 0, of_world = 0, stretch = 0;
    for (int k = 0; k < 60; ++k) {
        struct hair_reference_rod_pose head = hair_test_shaken(k * FRAME);
        float time = (float)(k * FRAME);
        hair_vec3 hand = hair_v3(0.1f + 0.1f * sinf(6 * time), 0.1f * time, -0.1f), tip;
        head.position[1] = 0.05 * sin(5 * k * FRAME);
        if (k == 0) pin_tip(living, HAIR_PIN_HEAD, at);
        if (k >= 30) pin_tip(living, HAIR_PIN_WORLD, hand);
        hair_test_advance(living, &head, FRAME);
        hair_test_read_guides(living);
        tip = hair_test_tip(living, 0);
        stretch = fmax(stretch, hair_test_stretch(living));
        if (k < 30)
            of_head = fmax(of_head, apart(tip, in_world(&head, at)));
        else
            of_world = fmax(of_world, apart(tip, hand));
    }
    print_message("    off by %.2g m from the head's, %.2g m from the hand's; stretch %.2g\n", of_head,
                  of_world, stretch);
    assert_true(of_head < 1e-6 && of_world < 1e-6 && stretch < 0.01);
}

static void pinned_tip_is_at_its_pin(void** state)
{
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(way, &physics);
        live(*state, 1, 32, hair_v3(1, -1, 0), &desc, &living);
        hold_tip(&living);
        assert_int_equal(hair_test_solver_stats(&living).reset, 0);
        hair_test_die(&living);
    }
}

// Check flat hair with pull, hair-hair grid and a collider, which uses other programs.
static void pinned_tip_stays_with_all_other_forces_enabled(void** state)
{
    for (int way = 0; way < 2; ++way) {
        struct hair_test_living living;
        hair_physics physics = hair_physics_default();
        hair_desc desc = way_of(way, &physics);
        hair_collider sphere = hair_collider_default();
        physics.fiber.flatness = 0.5f;
        physics.hair_hair.cohesion = 5;
        sphere.size[0] = 0.03f;
        sphere.position[0] = 0.1f;
        live(*state, 1, 20, hair_v3(1, -1, 0), &desc, &living);
        hair_test_ok(*state, hair_set_colliders(living.hair, &sphere, 1, sizeof sphere));
        hold_tip(&living);
        hair_test_die(&living);
    }
}

// Check an inextensible chain. Each row has its span and sag, relative to the length. Direct solves
// 64 vertices by the mixed scheme.
static void chain_between_two_pins_hangs_in_a_catenary(void** state)
{
    static const double rows[][2] = {{0.5, 0.3981941779}, {0.8, 0.2654375091}};
    hair_physics physics = hair_test_bare();
    physics.fiber.youngs_modulus = 0, physics.damping = 6, physics.root = HAIR_ROOT_HINGED;
    for (int i = 0; i < 4 * SOLVERS; ++i) {
        struct hair_test_living living;
        hair_desc desc = way_of(each(i / 4), &physics);
        hair_solver_stats stats = hair_solver_stats_default();
        uint32_t vertices = i % 4 < 2 ? 32 : 64;
        double sag = 0, span = rows[i % 2][0], expected = rows[i % 2][1];
        live(*state, 1, vertices, hair_v3(1, -1, 0), &desc, &living);
        pin_tip(&living, HAIR_PIN_HEAD, hair_v3((float)span * LENGTH, 0, 0));
        hair_test_wait(&living, 180);
        hair_test_read_guides(&living);
        hair_test_ok(*state, hair_get_solver_stats(living.hair, &stats));
        for (uint32_t k = 0; k < vertices; ++k)
            sag = fmax(sag, -(double)hair_test_at(&living, 0, k).y / (double)LENGTH);
        print_message("    span %.1f: sag %.5f, %.5f expected; stretch %.2g, %u fallbacks\n", span, sag,
                      expected, hair_test_stretch(&living), stats.follow_fallbacks);
        if (desc.solver != HAIR_SOLVER_FOLLOW) hair_test_near("sag", i, sag, expected, 0.005 * expected);
        assert_true(hair_test_stretch(&living) < (desc.solver == HAIR_SOLVER_FOLLOW ? 5e-3 : 5e-4));
        assert_true(stats.follow_fallbacks < 20); // The tip leaps to its pin once.
        hair_test_die(&living);
    }
}

// Check a ponytail. The part above its pin is held at both ends, and the part below hangs from the
// pin.
static void a_guide_can_be_pinned_at_several_vertices(void** state)
{
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(each(solver), &physics);
        hair_pin pins[] = {pin_of(0, 20, HAIR_PIN_WORLD, hair_v3(0.15f, 0, 0)),
                           pin_of(0, 10, HAIR_PIN_HEAD, hair_v3(0.07f, 0.03f, 0))};
        physics.damping = 6;
        live(*state, 2, 32, hair_v3(1, -1, 0), &desc, &living);
        hair_test_ok(*state, hair_set_pins(living.hair, pins, 2, sizeof *pins));
        hair_test_wait(&living, 180);
        hair_test_read_guides(&living);
        for (int i = 0; i < 2; ++i)
            assert_true(apart(hair_test_at(&living, 0, pins[i].vertex), hair_load3(pins[i].position)) < 1e-6);
        hair_vec3 tip = hair_test_tip(&living, 0);
        print_message("    tip at %.3f %.3f %.3f, stretch %.2g\n", (double)tip.x, (double)tip.y,
                      (double)tip.z, hair_test_stretch(&living));
        hair_test_near("x of the tip", 0, (double)tip.x, 0.15, 0.06);
        assert_true(tip.y < -0.06f && hair_test_stretch(&living) < 1e-3);
        assert_true(hair_test_tip(&living, 1).y < -0.2f); // Nothing pins this guide.
        hair_test_die(&living);
    }
}

static void pins_too_far_apart_pull_a_guide_straight(void** state)
{
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(each(solver), &physics);
        hair_vec3 far = hair_v3(0.45f, 0, 0);
        double astray = 0;
        live(*state, 1, 32, hair_v3(1, -1, 0), &desc, &living);
        pin_tip(&living, HAIR_PIN_HEAD, far);
        hair_test_wait(&living, 30);
        hair_test_read_guides(&living);
        for (uint32_t k = 0; k < 32; ++k)
            astray = fmax(astray, apart(hair_test_at(&living, 0, k), hair_scale(far, (float)k / 31)));
        hair_solver_stats pulled = hair_test_solver_stats(&living);
        print_message("    %.2g m off the straight line, stretch %.4f, %u times overextended, %u by Euler, "
                      "%u by following\n",
                      astray, hair_test_stretch(&living), pulled.overextended, pulled.euler_fallbacks,
                      pulled.follow_fallbacks);
        assert_true(astray < 0.03 && pulled.overextended > 0);
        float lower[3], upper[3];
        hair_test_ok(*state, hair_get_bounds(living.hair, lower, upper));
        assert_true(upper[0] >= far.x && lower[0] < 0);
        hair_test_near("stretch", 0, hair_test_stretch(&living), 0.5, 0.02);
        pin_tip(&living, HAIR_PIN_HEAD, hair_v3(0.2f, 0, 0));
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        hair_solver_stats after = hair_test_solver_stats(&living);
        assert_true(hair_test_stretch(&living) < 1e-3 && after.overextended < pulled.overextended + 60);
        hair_test_wait(&living, 10);
        assert_int_equal(hair_test_solver_stats(&living).overextended, after.overextended);
        hair_test_die(&living);
    }
}

static void unpinned_guide_rests_like_one_never_pinned(void** state)
{
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(each(solver), &physics);
        physics.damping = 6;
        live(*state, 1, 24, hair_v3(1, -1, 0), &desc, &living);
        pin_tip(&living, HAIR_PIN_WORLD, hair_v3(0.1f, 0.2f, 0));
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        assert_true(hair_test_tip(&living, 0).y > 0.19f);
        hair_test_ok(*state, hair_set_pins(living.hair, NULL, 0, 0));
        hair_test_wait(&living, 6);
        hair_test_read_guides(&living);
        double fallen = 0.2 - (double)hair_test_tip(&living, 0).y;
        print_message("    %.3f m in a tenth of a second\n", fallen);
        assert_true(fallen > 0.03 && fallen < 0.3);
        hair_test_wait(&living, 240);
        hair_test_read_guides(&living);
        struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
        assert_true(hair_reference_rod_rest(rod).converged);
        assert_true(hair_test_off(&living, 0, rod) < 0.01 * (double)LENGTH);
        hair_reference_rod_destroy(rod);
        hair_test_die(&living);
    }
}

static void teleport_takes_pins_along(void** state)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_bare();
    hair_desc desc = way_of(0, &physics);
    struct hair_reference_rod_pose far =
        hair_test_pose_of(hair_v3(100, 0, 0), hair_v3(0, 1, 0), 1.5707963267948966);
    const float turned[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 100, 0, 0, 1};
    live(*state, 1, 16, hair_v3(1, -1, 0), &desc, &living);
    pin_tip(&living, HAIR_PIN_WORLD, hair_v3(0.2f, 0, 0));
    hair_test_wait(&living, 30);
    hair_test_ok(*state, hair_teleport(living.hair, turned));
    hair_test_wait(&living, 30);
    hair_test_read_guides(&living);
    assert_true(apart(hair_test_tip(&living, 0), in_world(&far, hair_v3(0.2f, 0, 0))) < 1e-4);
    assert_true(hair_test_stretch(&living) < 2e-3);
    assert_int_equal(hair_test_solver_stats(&living).overextended, 0);
    hair_test_die(&living);
}

static void saved_state_with_pins_continues_bit_for_bit(void** state)
{
    static struct hair_test_seen seen[2];
    hair_physics physics = hair_physics_default();
    hair_desc desc = way_of(0, &physics);
    struct hair_test_living living[2];
    hair_pin pins[] = {pin_of(1, UINT32_MAX, HAIR_PIN_WORLD, hair_v3(0.1f, 0.1f, 0)),
                       pin_of(0, 7, HAIR_PIN_HEAD, hair_v3(0.1f, 0, 0))};
    for (int i = 0; i < 2; ++i) live(*state, 3, 16, hair_v3(1, -1, 0), &desc, &living[i]);
    hair_test_ok(*state, hair_set_pins(living[0].hair, pins, 2, sizeof *pins));
    for (int k = 0; k < 20; ++k) hair_test_advance(&living[0], NULL, 0.011);
    struct hair_test_blob blob = hair_test_save(*state, living[0].hair);
    hair_test_ok(*state, hair_load(living[1].hair, blob.bytes, blob.size));
    struct hair_test_blob again = hair_test_save(*state, living[1].hair);
    assert_int_equal(again.size, blob.size);
    assert_memory_equal(again.bytes, blob.bytes, blob.size);
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 20; ++k) {
            pins[0].position[1] = 0.1f + 0.005f * (float)k;
            if (k > 5) hair_test_ok(*state, hair_set_pins(living[i].hair, pins, 2, sizeof *pins));
            hair_test_advance(&living[i], NULL, 0.011);
        }
        hair_test_look(*state, living[i].hair, &seen[i]);
    }
    hair_test_same(&seen[0], &seen[1]);
    for (int i = 0; i < 2; ++i) hair_test_die(&living[i]);
    free(blob.bytes), free(again.bytes);
}

static void invalid_pins_are_refused_and_change_nothing(void** state)
{
    const float inf = INFINITY;
    struct hair_test* test = *state;
    hair_physics physics = hair_test_bare();
    hair_desc desc = way_of(0, &physics);
    struct hair_test_living living;
    hair_vec3 at = hair_v3(0.1f, 0.1f, 0.1f);
    const struct {
        hair_pin pin;
        const char* words;
    } wrong[] = {
        {pin_of(2, 3, HAIR_PIN_HEAD, at), "pins[1].guide is 2, not in [0, 1]"},
        {pin_of(1, 0, HAIR_PIN_HEAD, at), "pins[1].vertex is 0"},
        {pin_of(1, 3, (hair_pin_to)2, at), "pins[1].to is 2"},
        {pin_of(1, 3, HAIR_PIN_WORLD, hair_v3(0, NAN, 0)), "pins[1].position[1] is"},
        {pin_of(1, 3, HAIR_PIN_WORLD, hair_v3(0, 0, -inf)), "pins[1].position[2] is -inf"},
        {pin_of(0, 15, HAIR_PIN_WORLD, at), "pins[0] and pins[1] both hold vertex 15 of guide 0"},
        {pin_of(0, 99, HAIR_PIN_WORLD, at), "both hold vertex 15 of guide 0"},
    };
    live(test, 2, 16, hair_v3(1, -1, 0), &desc, &living);
    hair_instance* hair = living.hair;
    pin_tip(&living, HAIR_PIN_HEAD, hair_v3(0.2f, 0, 0));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        hair_pin pins[] = {pin_of(0, 15, HAIR_PIN_HEAD, at), wrong[i].pin};
        hair_test_refused(test, hair_set_pins(hair, pins, 2, sizeof *pins), HAIR_ERROR_ARGUMENT,
                          wrong[i].words);
    }
    hair_pin one = pin_of(0, 15, HAIR_PIN_HEAD, at);
    hair_test_refused(test, hair_set_pins(hair, &one, 1, 8), HAIR_ERROR_ARGUMENT, "stride is 8");
    hair_test_refused(test, hair_set_pins(hair, NULL, 1, sizeof one), HAIR_ERROR_ARGUMENT, "pins is NULL");
    hair_test_refused(test, hair_set_pins(hair, &one, 1048577, sizeof one), HAIR_ERROR_ARGUMENT, "pin count");
    assert_int_equal(hair_set_pins(NULL, &one, 1, sizeof one), HAIR_ERROR_ARGUMENT);
    hair_test_wait(&living, 2);
    hair_test_read_guides(&living);
    assert_true(apart(hair_test_tip(&living, 0), hair_v3(0.2f, 0, 0)) < 1e-6);

    // A position that no hair reaches is allowed. Hair must come back from it.
    pin_tip(&living, HAIR_PIN_WORLD, hair_v3(1e9f, -1e9f, 0));
    hair_test_wait(&living, 10);
    hair_test_read_guides(&living);
    pin_tip(&living, HAIR_PIN_WORLD, hair_v3(0.1f, 0, 0));
    hair_test_wait(&living, 60);
    hair_test_read_guides(&living);
    assert_true(hair_test_stretch(&living) < 0.01);
    hair_test_die(&living);

    desc = hair_test_rods(HAIR_SOLVER_REDBLACK, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    live(test, 2, 16, hair_v3(1, -1, 0), &desc, &living);
    hair_test_refused(test, hair_set_pins(living.hair, &one, 1, sizeof one), HAIR_ERROR_ARGUMENT, "redblack");
    hair_test_die(&living);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(pinned_tip_is_at_its_pin),
        HAIR_TEST(pinned_tip_stays_with_all_other_forces_enabled),
        HAIR_TEST(chain_between_two_pins_hangs_in_a_catenary),
        HAIR_TEST(a_guide_can_be_pinned_at_several_vertices),
        HAIR_TEST(pins_too_far_apart_pull_a_guide_straight),
        HAIR_TEST(unpinned_guide_rests_like_one_never_pinned),
        HAIR_TEST(teleport_takes_pins_along),
        HAIR_TEST(saved_state_with_pins_continues_bit_for_bit),
        HAIR_TEST(invalid_pins_are_refused_and_change_nothing),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
