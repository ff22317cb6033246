// health_test.c - what hair_health tells: healthy hair is called healthy, hair that thrashes or gains energy is not.
#include <math.h>
#include <stdio.h>

#include "tests/support/haircut.h"
#include "tests/support/living.h"
#include "tests/support/shell.h"

enum { FPS = 60, GUIDES = 16, SHAKE = 30 };

static hair_health ask(struct hair_test* test, hair_instance* hair)
{
    hair_health health = hair_health_default();
    hair_test_ok(test, hair_get_health(hair, &health));
    return health;
}

// Turn the head to and fro for half a second, then leave it alone.
static void shake(struct hair_test* test, hair_instance* hair, uint32_t frames)
{
    for (uint32_t i = 0; i < frames; ++i) {
        float angle    = i < SHAKE ? 0.4f * sinf(6.2831853f * (float)(i + 1) / SHAKE) : 0;
        float head[16] = {cosf(angle), 0, -sinf(angle), 0, 0, 1, 0, 0, sinf(angle), 0, cosf(angle), 0, 0, 0, 0, 1};
        hair_test_ok(test, hair_set_transform(hair, head));
        hair_test_ok(test, hair_step(hair, 1.0f / FPS));
    }
}

static void check_haircut(struct hair_test* test, hair_style style, hair_solver solver, float damping,
                          int collides)
{
    hair_style_desc of      = hair_style_desc_default();
    hair_desc       desc    = hair_desc_default();
    hair_physics    physics = hair_physics_default();
    hair_instance*  hair    = NULL;
    of.style                = style;
    of.guide_count          = GUIDES;
    physics.damping         = damping;
    desc.physics            = &physics;
    desc.solver             = solver;
    desc.diagnose           = 1;
    hair_groom* groom       = hair_test_haircut(test, &of, 0);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_solid box = hair_test_body(HAIR_SHAPE_BOX, 0, -0.05f, 0);
    for (int k = 0; k < 3; ++k) box.size[k] = 0.15f;
    if (collides) hair_test_ok(test, hair_set_solids(hair, &box, 1, sizeof box));
    shake(test, hair, SHAKE + 90);
    hair_health health = ask(test, hair);
    print_message("    %s by solver %d, damping %g%s: %u gain, %u restless, fastest %.3g m/s, stretch %.2g\n",
                  hair_style_name(style), solver, (double)damping, collides ? ", box" : "", health.gaining,
                  health.restless, (double)health.fastest, (double)health.stretch);
    assert_int_equal(health.gaining, 0);
    assert_int_equal(health.restless, 0);
    assert_int_equal(health.overstretched, 0);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(haircuts_after_a_head_shake_gain_no_energy),
        HAIR_TEST(accurate_haircuts_gain_no_energy),
        HAIR_TEST(haircuts_on_a_box_gain_no_energy),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
