// getters_test.c - physics, look, wind and transform of an instance are returned as they were set.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

static struct hair_test_scene begin(struct hair_test* test, const hair_desc* desc)
{
    struct hair_test_scene f = hair_test_scene_make(test, NULL);
    hair_test_scene_add(&f, NULL, desc);
    return f;
}

// Set every number between its default and its maximum. Enums and switches get their maximum.
static void vary(void* desc, struct hair_schema schema)
{
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* member = &schema.member[i];
        uint32_t whole = (uint32_t)member->max;
        bool is_on = true;
        if (member->type == HAIR_MEMBER_TEXTURE || member->type == HAIR_MEMBER_POINTER) continue;
        for (uint32_t k = 0; k < member->count; ++k) {
            float real = (float)(0.75 * member->defaults[k] + 0.25 * fmin(member->max, 1e6));
            const void* value = member->type == HAIR_MEMBER_FLOAT  ? (const void*)&real
                                : member->type == HAIR_MEMBER_BOOL ? (const void*)&is_on
                                                                   : &whole;
            memcpy((char*)desc + member->offset + k * member->size, value, member->size);
        }
    }
}

static void check_same(const void* set, const void* got, struct hair_schema schema)
{
    assert_memory_equal(set, got, sizeof(hair_struct_header));
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* member = &schema.member[i];
        if (member->type != HAIR_MEMBER_POINTER &&
            memcmp((const char*)set + member->offset, (const char*)got + member->offset,
                   member->size * member->count))
            fail_msg("%s is not what was set", member->name);
    }
}

static void physics_are_those_that_were_set(void** state)
{
    hair_physics first = hair_physics_default(), second = first, wrong = first, got = first;
    hair_desc desc = hair_desc_default();
    first.damping = 7;
    desc.physics = &first;
    struct hair_test_scene f = begin(*state, &desc);
    hair_test_ok(f.test, hair_get_physics(f.hair, &got));
    check_same(&first, &got, hair_schema_of_hair_physics());
    vary(&second, hair_schema_of_hair_physics());
    hair_test_ok(f.test, hair_set_physics(f.hair, &second));
    wrong.damping = -1; // This set call changes nothing.
    assert_int_equal(hair_set_physics(f.hair, &wrong), HAIR_ERROR_ARGUMENT);
    hair_test_forgive(f.test);
    hair_test_ok(f.test, hair_get_physics(f.hair, &got));
    check_same(&second, &got, hair_schema_of_hair_physics());
    hair_test_scene_free(&f);
}

// Check a wet look too. The library draws other numbers than the application has set.
static void the_look_is_the_one_that_was_set(void** state)
{
    hair_look first = hair_look_default(), second = first, got = first;
    hair_desc desc = hair_desc_default();
    first.wetness = 1;
    desc.look = &first;
    struct hair_test_scene f = begin(*state, &desc);
    hair_test_ok(f.test, hair_get_look(f.hair, &got));
    check_same(&first, &got, hair_schema_of_hair_look());
    assert_true(f.hair->geometry.look.strays.fraction < got.strays.fraction);
    vary(&second, hair_schema_of_hair_look());
    hair_test_ok(f.test, hair_set_look(f.hair, &second));
    hair_test_ok(f.test, hair_get_look(f.hair, &got));
    check_same(&second, &got, hair_schema_of_hair_look());
    hair_test_ok(f.test, hair_set_look(f.hair, &got));
    hair_test_ok(f.test, hair_get_look(f.hair, &got));
    check_same(&second, &got, hair_schema_of_hair_look());
    hair_test_scene_free(&f);
}

static void the_wind_and_its_sources_are_those_that_were_set(void** state)
{
    hair_wind usual = hair_wind_default(), wind = usual, got = usual;
    hair_wind_source sources[4];
    hair_desc desc = hair_desc_default();
    struct hair_test_scene f = begin(*state, &desc);
    hair_test_ok(f.test, hair_get_wind(f.hair, &got));
    check_same(&usual, &got, hair_schema_of_hair_wind());
    assert_null(got.sources);
    vary(&wind, hair_schema_of_hair_wind());
    for (int i = 0; i < 4; ++i) {
        sources[i] = hair_wind_source_default();
        sources[i].speed = (float)i;
    }
    wind.sources = sources;
    hair_test_ok(f.test, hair_set_wind(f.hair, &wind));
    sources[3].speed = 9; // The instance has a copy.
    for (int again = 0; again < 2; ++again) {
        hair_test_ok(f.test, hair_get_wind(f.hair, &got));
        check_same(&wind, &got, hair_schema_of_hair_wind());
        assert_ptr_not_equal(got.sources, sources);
        for (int i = 0; i < 4; ++i) assert_true(got.sources[i].speed == (float)i);
        hair_test_ok(f.test, hair_set_wind(f.hair, &got));
    }
    hair_test_ok(f.test, hair_set_wind(f.hair, NULL));
    hair_test_ok(f.test, hair_get_wind(f.hair, &got));
    check_same(&usual, &got, hair_schema_of_hair_wind());
    hair_test_scene_free(&f);
}

static void check_transform(struct hair_test_scene* f, const float expected[16])
{
    float got[16];
    hair_test_ok(f->test, hair_get_transform(f->hair, got));
    for (int i = 0; i < 12; ++i) hair_test_near("rotation", i, got[i], expected[i], 1e-6);
    assert_memory_equal(got + 12, expected + 12, 4 * sizeof *got);
}

static void the_transform_is_that_of_the_last_call_that_sets_it(void** state)
{
    float c = cosf(0.4f), s = sinf(0.4f);
    hair_desc desc = hair_desc_default();
    // A rotation about y, x and z, so that no two axes can be exchanged.
    const float poses[3][16] = {{c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 1, 2, 3, 1},
                                {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 1e6f, 0.1f, -3, 1},
                                {c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, -1, 0, 7e-3f, 1}};
    memcpy(desc.transform, poses[0], sizeof desc.transform);
    struct hair_test_scene f = begin(*state, &desc);
    check_transform(&f, poses[0]);
    hair_test_ok(f.test, hair_set_transform(f.hair, poses[1]));
    check_transform(&f, poses[1]);
    hair_test_ok(f.test, hair_teleport(f.hair, poses[2]));
    check_transform(&f, poses[2]);
    hair_test_scene_free(&f);
}

// Check that nothing beyond the end of an older caller's struct is written, and that its header
// stays.
static void an_older_caller_gets_the_members_that_it_knows(void** state)
{
    hair_desc desc = hair_desc_default();
    struct hair_test_scene f = begin(*state, &desc);
    hair_physics physics = hair_physics_default(), untouched;
    memset(&physics, 0x55, sizeof physics);
    physics.header = (hair_struct_header){offsetof(hair_physics, fiber), 200};
    untouched = physics;
    hair_test_ok(f.test, hair_get_physics(f.hair, &physics));
    assert_int_equal(physics.header.size, offsetof(hair_physics, fiber));
    assert_int_equal(physics.header.version, 200);
    assert_true(physics.damping == 4 && physics.drag == 0.1f);
    assert_memory_equal(&physics.fiber, &untouched.fiber, sizeof physics - offsetof(hair_physics, fiber));
    hair_test_scene_free(&f);
}

static void a_struct_that_no_default_function_filled_in_is_refused(void** state)
{
    static const hair_struct_header wrong[] = {{0, 0},  {7, HAIR_VERSION}, {5000, HAIR_VERSION},
                                               {64, 0}, {64, 199},         {64, HAIR_VERSION + 10000}};
    hair_desc desc = hair_desc_default();
    struct hair_test_scene f = begin(*state, &desc);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        hair_physics physics = hair_physics_default();
        hair_look look = hair_look_default();
        hair_wind wind = hair_wind_default();
        physics.header = look.header = wind.header = wrong[i];
        physics.damping = look.wetness = wind.shelter = 0.625f;
        hair_test_refused(f.test, hair_get_physics(f.hair, &physics), HAIR_ERROR_VERSION, "hair_physics");
        hair_test_refused(f.test, hair_get_look(f.hair, &look), HAIR_ERROR_VERSION, "hair_look");
        hair_test_refused(f.test, hair_get_wind(f.hair, &wind), HAIR_ERROR_VERSION, "hair_wind");
        assert_true(physics.damping == 0.625f && look.wetness == 0.625f && wind.shelter == 0.625f);
    }
    hair_test_scene_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(physics_are_those_that_were_set),
        HAIR_TEST(the_look_is_the_one_that_was_set),
        HAIR_TEST(the_wind_and_its_sources_are_those_that_were_set),
        HAIR_TEST(the_transform_is_that_of_the_last_call_that_sets_it),
        HAIR_TEST(an_older_caller_gets_the_members_that_it_knows),
        HAIR_TEST(a_struct_that_no_default_function_filled_in_is_refused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
