// step_failure_test.c - a step that fails changes nothing. Memory and objects of OpenGL are refused
// one after the other, while a step changes what it needs. The next step then gives the same bits
// as without the failure.
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/handmade.h"
#include "tests/support/refusal.h"
#include "tests/support/ways.h"

#define STEPS 5
#define DT 0.0237f // Time of a step, s. Steps end within a substep.
#define BYTES (1 << 20) // Upper bound on the size of a state.

// Changes of settings, after which the next step needs more than the steps before.
enum change { FASTER, SLOWER, FIRST_COLLIDER, MANY_COLLIDERS, COHESION, PINS, FLUID, EVERYTHING, CHANGES };
static const char* const changes[CHANGES] = {"higher rate", "lower rate", "first collider", "many colliders",
                                             "cohesion",    "pins",       "fluid",          "all"};

struct scene {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_desc desc;
    enum change change;
};

static hair_physics physics_of(enum change change, bool changed)
{
    hair_physics physics = hair_physics_default();
    bool is_fast = change == SLOWER ? !changed : changed || (change != FASTER && change != EVERYTHING);
    physics.substep_rate = is_fast ? 1 : 0.25f;
    if (changed && (change == COHESION || change == EVERYTHING)) physics.hair_hair.cohesion = 5;
    return physics;
}

static void set_colliders(const struct scene* s, hair_instance* hair, uint32_t count)
{
    hair_collider colliders[40];
    for (uint32_t i = 0; i < count; ++i) {
        colliders[i] = hair_collider_default();
        colliders[i].size[0] = 0.03f;
        colliders[i].position[0] = 0.01f * (float)i;
        colliders[i].position[1] = -0.2f;
    }
    hair_test_ok(s->test, hair_set_colliders(hair, colliders, count, sizeof *colliders));
}

static void apply(const struct scene* s, hair_instance* hair)
{
    hair_physics physics = physics_of(s->change, true);
    bool has_rods = s->desc.solver != HAIR_SOLVER_REDBLACK, all = s->change == EVERYTHING;
    hair_pin pins[2] = {hair_pin_default(), hair_pin_default()};
    hair_wind wind = hair_wind_default();
    pins[1].guide = 1;
    wind.model = HAIR_WIND_FLUID;
    wind.velocity[0] = 2;
    wind.fluid.resolution = 16;
    hair_test_ok(s->test, hair_set_physics(hair, &physics));
    if (s->change == FIRST_COLLIDER) set_colliders(s, hair, 1);
    if (s->change == MANY_COLLIDERS || all) set_colliders(s, hair, 40);
    if (has_rods && (s->change == PINS || all))
        hair_test_ok(s->test, hair_set_pins(hair, pins, 2, sizeof *pins));
    if (s->change == FLUID || all) hair_test_ok(s->test, hair_set_wind(hair, &wind));
}

// Create an instance that moves, and apply the change.
static hair_instance* begin(const struct scene* s)
{
    hair_instance* hair = NULL;
    hair_desc desc = s->desc;
    hair_physics physics = physics_of(s->change, false);
    desc.physics = &physics;
    hair_test_ok(s->test, hair_create(s->context, s->groom, &desc, &hair));
    for (int i = 0; i < STEPS; ++i) hair_test_ok(s->test, hair_step(hair, DT));
    apply(s, hair);
    return hair;
}

struct state {
    unsigned char* bytes;
    size_t size;
};

static struct state save(const struct scene* s, hair_instance* hair)
{
    struct state state = {malloc(BYTES), 0};
    assert_non_null(state.bytes);
    hair_test_ok(s->test, hair_save(hair, state.bytes, BYTES, &state.size));
    return state;
}

static void check_same(const struct state* a, const struct state* b)
{
    assert_int_equal(a->size, b->size);
    assert_memory_equal(a->bytes, b->bytes, a->size);
}

// Refuse the n-th allocation or creation in a step. Return whether there was one. If the step
// fails, nothing has changed. With `retries` the next step leads to the state `expected`.
static bool refuse(const struct scene* s, uint32_t* done, uint32_t* number, uint32_t n, bool retries,
                   const struct state* expected)
{
    hair_instance* hair = begin(s);
    struct state before = save(s, hair);
    *done = 0;
    *number = n;
    hair_result result = hair_step(hair, DT);
    *number = 0;
    bool was_refused = *done >= n;
    assert_int_equal(result != HAIR_OK, was_refused);
    if (result) {
        struct state after = save(s, hair);
        assert_true(hair_test_forgive(s->test) >= 1);
        check_same(&before, &after);
        free(after.bytes);
        if (retries) hair_test_ok(s->test, hair_step(hair, DT));
    }
    if ((!result || retries) && expected->bytes) {
        struct state after = save(s, hair);
        check_same(expected, &after);
        free(after.bytes);
    }
    free(before.bytes);
    hair_destroy(hair);
    return was_refused;
}

static void torture(const struct scene* s)
{
    struct hair_test_host* host = &s->test->host;
    uint32_t *done[] = {&hair_test_refusal.creations, &host->allocations},
             *number[] = {&hair_test_refusal.refuse, &host->refuse}, counts[2][2];
    struct state expected = {NULL, 0};
    for (int retries = 0; retries < 2; ++retries) {
        for (int k = 0; k < 2; ++k) {
            uint32_t n = 1;
            while (n < 500 && refuse(s, done[k], number[k], n, retries, &expected)) ++n;
            assert_true(n < 500);
            counts[retries][k] = n - 1;
        }
        if (retries) break;
        hair_instance* hair = begin(s); // All programs are compiled now.
        hair_test_ok(s->test, hair_step(hair, DT));
        expected = save(s, hair);
        hair_destroy(hair);
    }
    print_message("    %s: %u creations and %u allocations at first, %u and %u later\n", changes[s->change],
                  counts[0][0], counts[0][1], counts[1][0], counts[1][1]);
    free(expected.bytes);
}

static void failing_step_changes_nothing(void** state)
{
    static const int ways[] = {0, 2, 5}; // See hair_test_way().
    for (size_t w = 0; w < sizeof ways / sizeof *ways; ++w) {
        struct scene s = {.test = *state, .desc = hair_test_way(ways[w])};
        hair_context_desc desc = hair_context_desc_default();
        s.desc.substep = s.desc.solver == HAIR_SOLVER_ACCURATE ? 0 : s.desc.substep;
        s.groom = hair_test_groom(&s.test->host.host, hair_test_handmade_default());
        desc.host = &s.test->host.host;
        desc.get_proc = hair_test_refusing_proc;
        print_message("    %s\n", hair_test_way_name(ways[w]));
        for (s.change = 0; s.change < CHANGES; ++s.change) {
            hair_test_ok(s.test, hair_context_create(&desc, &s.context));
            torture(&s);
            hair_context_destroy(s.context);
        }
        hair_groom_destroy(s.groom);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(failing_step_changes_nothing)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
