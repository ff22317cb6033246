// preset_test.c - presets of physics are valid, and all differ.
#include <string.h>

#include "tests/support/support.h"

static void the_natural_preset_is_the_default(void** state)
{
    (void)state;
    hair_physics physics = hair_physics_default(), untouched = physics;
    assert_int_equal(hair_physics_preset(&physics, HAIR_PRESET_NATURAL), HAIR_OK);
    assert_memory_equal(&physics, &untouched, sizeof physics);
}

static void presets_differ_and_keep_other_settings(void** state)
{
    (void)state;
    hair_physics all[HAIR_PRESET_COUNT];
    for (int i = 0; i < HAIR_PRESET_COUNT; ++i) {
        all[i] = hair_physics_default();
        all[i].gravity[1] = -1.62f;
        all[i].redblack.iterations = 7;
        assert_int_equal(hair_physics_preset(&all[i], (hair_preset)i), HAIR_OK);
        assert_true(all[i].gravity[1] == -1.62f && all[i].redblack.iterations == 7);
        // The second call checks the ranges of the fields that the first one set.
        assert_int_equal(hair_physics_preset(&all[i], (hair_preset)i), HAIR_OK);
        for (int k = 0; k < i; ++k) assert_memory_not_equal(&all[i], &all[k], sizeof all[i]);
    }
}

static void every_preset_has_a_distinct_name(void** state)
{
    (void)state;
    for (int i = 0; i < HAIR_PRESET_COUNT; ++i) {
        assert_non_null(hair_preset_name((hair_preset)i));
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(hair_preset_name((hair_preset)i), hair_preset_name((hair_preset)k));
    }
    assert_null(hair_preset_name(HAIR_PRESET_COUNT));
}

static void invalid_presets_and_physics_are_refused(void** state)
{
    (void)state;
    hair_physics physics = hair_physics_default();
    assert_int_equal(hair_physics_preset(&physics, HAIR_PRESET_COUNT), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_physics_preset(NULL, HAIR_PRESET_FINE), HAIR_ERROR_ARGUMENT);
    physics.fiber.youngs_modulus = -1;
    assert_int_equal(hair_physics_preset(&physics, HAIR_PRESET_FINE), HAIR_ERROR_ARGUMENT);
    memset(&physics, 0, sizeof physics); // The default function did not make these.
    assert_int_equal(hair_physics_preset(&physics, HAIR_PRESET_FINE), HAIR_ERROR_VERSION);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_natural_preset_is_the_default),
        cmocka_unit_test(presets_differ_and_keep_other_settings),
        cmocka_unit_test(every_preset_has_a_distinct_name),
        cmocka_unit_test(invalid_presets_and_physics_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
