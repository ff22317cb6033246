// groups_loss_test.c - physics and looks of groups are restored after the OpenGL context is lost,
// also when memory runs out meanwhile.
#include "tests/support/context_loss.h"
#include "tests/support/live_hair.h"

#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define GUIDES 3

static const uint8_t groups[GUIDES] = {0, 1, 2};

struct fixture {
    struct hair_test* test;
    struct hair_test_restorable restorable;
    struct hair_test_strands strands;
    struct hair_test_living living;
};

// Set physics of group 1 and a look of group 2.
static void begin(struct hair_test* test, struct fixture* f)
{
    hair_physics physics = hair_test_loose(0.3f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_group_look look = hair_group_look_default();
    *f = (struct fixture){.test = test, .strands = hair_test_strands_make(GUIDES, 8)};
    for (uint32_t g = 0; g < GUIDES; ++g)
        hair_test_add_straight(&f->strands, 8, hair_v3(0.05f * (float)g, 0, 0), hair_v3(1, -1, 0), 0.2f);
    f->strands.groups = groups;
    hair_test_restorable_begin(test, &f->restorable);
    hair_test_live(test, &f->strands, &desc, &f->living);
    physics.tip_mass = 0.5f, physics.fiber.youngs_modulus = 1e9f;
    hair_test_ok(test, hair_set_group_physics(f->living.hair, 1, &physics));
    look.radius = 0.5f, look.color.enabled = true, look.frizz = 2;
    hair_test_ok(test, hair_set_group_look(f->living.hair, 2, &look));
    hair_test_wait(&f->living, 3);
    hair_test_restorable_lose(test, &f->restorable);
}

static void check_groups(struct fixture* f)
{
    hair_instance* hair = f->living.hair;
    hair_physics physics = hair_physics_default();
    hair_group_look look = hair_group_look_default();
    hair_test_ok(f->test, hair_get_group_physics(hair, 1, &physics));
    assert_true(physics.tip_mass == 0.5f && physics.fiber.youngs_modulus == 1e9f);
    hair_test_ok(f->test, hair_get_group_physics(hair, 2, &physics));
    assert_true(physics.tip_mass == f->living.physics.tip_mass);
    hair_test_ok(f->test, hair_get_group_look(hair, 2, &look));
    assert_true(look.radius == 0.5f && look.frizz == 2 && hair->geometry.groups.factors &&
                look.color.enabled);
    hair_test_wait(&f->living, 3);
    hair_test_read_guides(&f->living);
    // The rods and the colours of the groups are there too.
    assert_int_equal(hair->sim.rods->made_for_groups, hair->sim.groups.version);
    assert_int_not_equal(hair->sim.groups.version, 0);
    assert_true(hair->lighting.has_group_colors && hair->lighting.groom_color);
}

static void end(struct fixture* f)
{
    hair_test_die(&f->living);
    hair_test_strands_free(&f->strands);
    hair_test_restorable_end(f->test, &f->restorable);
}

static void restored_groups_keep_their_physics_and_looks(void** state)
{
    struct fixture f;
    begin(*state, &f);
    hair_test_ok(f.test, hair_context_restore(f.test->context));
    check_groups(&f);
    end(&f);
}

static void refused_memory_keeps_groups_for_the_next_attempt(void** state)
{
    struct fixture f;
    begin(*state, &f);
    hair_test_restore_against_refusals(f.test, f.living.hair);
    check_groups(&f);
    end(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(restored_groups_keep_their_physics_and_looks),
        HAIR_TEST(refused_memory_keeps_groups_for_the_next_attempt),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
