// settings_test.c - settings of the tools are members of the library's structs: every choice has a
// name, members of several structs are set in all, and no row is about nothing.
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

// Tools are not linked into tests.
#include "tools/common/file.c"
#undef COUNT
#include "tools/common/settings_keys.c"
#undef COUNT
#include "tools/common/settings.c"

#include "lib/sim/sim.h"

static void every_choice_has_a_name_that_sets_it(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    struct hair_setting setting;
    uint32_t enums = 0;
    for (size_t at = 0; hair_setting_next(&at, &setting);) {
        size_t size;
        uint32_t value;
        enums += setting.member.choice_count > 0;
        for (uint32_t i = 0; i < setting.member.choice_count; ++i) {
            assert_true(hair_settings_set("test", &settings, setting.key, setting.member.choices[i]));
            memcpy(&value, hair_setting_bytes(&setting, &settings, &size), sizeof value);
            assert_int_equal(value, i);
        }
    }
    assert_in_range(enums, 10, 30);
}

static void settings_of_several_structs_are_set_in_all(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    assert_true(hair_settings_set("test", &settings, "seed", "77"));
    assert_true(hair_settings_set("test", &settings, "guides", "78"));
    assert_true(hair_settings_set("test", &settings, "vertices", "79"));
    assert_int_equal(settings.import.seed, 77);
    assert_int_equal(settings.groom.seed, 77);
    assert_int_equal(settings.style.seed, 77);
    assert_int_equal(settings.groom.guide_count, 78);
    assert_int_equal(settings.style.guide_count, 78);
    assert_int_equal(settings.import.strand_vertices, 79);
    assert_int_equal(settings.style.strand_vertices, 79);
}

// A style has 16 guides or more, but guides of a file may be fewer, or more than a style has.
static void values_that_one_struct_accepts_are_set_and_others_refused(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    assert_true(hair_settings_set("test", &settings, "guides", "8"));
    assert_int_equal(settings.groom.guide_count, 8);
    assert_int_equal(settings.style.guide_count, 8);
    assert_false(hair_setting_is_in_range(&settings, "guides"));
    assert_false(hair_settings_set("test", &settings, "guides", "262145"));
    assert_int_equal(settings.groom.guide_count, 8);
    assert_true(hair_settings_set("test", &settings, "guides", "100"));
    assert_true(hair_setting_is_in_range(&settings, "guides"));
    assert_false(hair_settings_set("test", &settings, "damping", "-1"));
    assert_true(settings.physics.damping == hair_physics_default().damping);
}

static void curves_have_evenly_spaced_points_of_their_text(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    assert_true(hair_settings_set("test", &settings, "strand.taper", "0,3.5"));
    for (int i = 0; i < 8; ++i) assert_float_equal(settings.look.strand.taper.at[i], 0.5f * (float)i, 1e-6);
    assert_true(hair_settings_set("test", &settings, "strand.taper", "0.25"));
    for (int i = 0; i < 8; ++i) assert_float_equal(settings.look.strand.taper.at[i], 0.25f, 0);
}

static void settings_of_the_tools_have_their_own_values(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    assert_true(hair_settings_set("test", &settings, "lod", "on"));
    assert_true(hair_settings_set("test", &settings, "hide", "1"));
    assert_true(settings.has_lod && settings.hides);
    assert_true(hair_settings_set("test", &settings, "hide", "off"));
    assert_false(settings.hides);
    assert_false(hair_settings_set("test", &settings, "hide", "2"));
    assert_false(settings.simulates_all);
    assert_true(hair_settings_set("test", &settings, "every_strand", "on"));
    assert_true(settings.simulates_all);
    for (size_t i = 0; i < sizeof extras / sizeof *extras; ++i)
        for (int k = 0; extras[i].preset && extras[i].preset(k); ++k)
            assert_true(hair_settings_set("test", &settings, extras[i].key, extras[i].preset(k)));
    // The last colour is blue.
    assert_true(settings.look.color.root[2] > settings.look.color.root[0]);
    assert_false(hair_settings_set("test", &settings, "look", "dry"));
    assert_false(hair_settings_set("test", &settings, "", "1"));
}

static void settings_of_a_group_leave_other_groups_inherited(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    assert_true(hair_settings_set("test", &settings, "groups.3.tip_mass", "0.5"));
    assert_true(hair_settings_set("test", &settings, "groups.7.color.enabled", "on"));
    assert_true(hair_settings_set("test", &settings, "groups.0.color.tip.b", "0.25"));
    assert_true(settings.groups[3].physics.tip_mass == 0.5f);
    assert_true(settings.groups[3].physics.shape.stiffness_tip == HAIR_GROUP_INHERITED);
    assert_true(settings.groups[2].physics.tip_mass == HAIR_GROUP_INHERITED);
    assert_true(settings.physics.tip_mass == 0);
    assert_true(settings.groups[7].look.color.enabled && !settings.groups[0].look.color.enabled);
    assert_true(settings.groups[0].look.color.tip[2] == 0.25f);
    assert_false(hair_settings_set("test", &settings, "groups.3.tip_mass", "inf"));
    assert_false(hair_settings_set("test", &settings, "groups.3.radius", "5"));
    assert_false(hair_settings_set("test", &settings, "groups.8.radius", "1"));
    assert_false(hair_settings_set("test", &settings, "groups.3.drag", "1"));
    assert_true(settings.groups[3].physics.tip_mass == 0.5f);
}

// Compare the keys of groups with the members that the library copies for each group.
static void groups_have_keys_of_the_members_that_can_differ(void** state)
{
    (void)state;
    hair_member members[MAX_MEMBERS];
    uint32_t count = hair_describe(HAIR_STRUCT_PHYSICS, members, MAX_MEMBERS, sizeof *members), own = 0;
    for (uint32_t i = 0; i < count; ++i) {
        hair_physics from, to;
        memset(&from, 1, sizeof from);
        memset(&to, 2, sizeof to);
        hair_sim_copy_group_members(&from, &to);
        bool is_copied = *((const char*)&to + members[i].offset) == 1;
        if (can_differ_by_group(&members[i]) != is_copied) fail_msg("%s", members[i].name);
        own += is_copied;
    }
    assert_in_range(own, 7, count - 1);
}

// Check rows that outlive their member when the member is renamed or removed.
static void every_row_of_settings_is_about_a_member(void** state)
{
    (void)state;
    hair_member members[MAX_MEMBERS];
    struct hair_setting setting;
    size_t keys = 0;
    for (size_t i = 0; i < sizeof renamed / sizeof *renamed; ++i) {
        uint32_t count = hair_describe(renamed[i].kind, members, MAX_MEMBERS, sizeof *members), k = 0;
        while (k < count && strcmp(members[k].name, renamed[i].member)) ++k;
        if (k == count) fail_msg("there is no %s", renamed[i].member);
    }
    for (size_t at = 0; hair_setting_next(&at, &setting); ++keys)
        if (find_extra(setting.key)) fail_msg("%s is a setting twice", setting.key);
    assert_in_range(keys, 250, MAX_SETTINGS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_choice_has_a_name_that_sets_it),
        cmocka_unit_test(settings_of_several_structs_are_set_in_all),
        cmocka_unit_test(values_that_one_struct_accepts_are_set_and_others_refused),
        cmocka_unit_test(curves_have_evenly_spaced_points_of_their_text),
        cmocka_unit_test(settings_of_the_tools_have_their_own_values),
        cmocka_unit_test(settings_of_a_group_leave_other_groups_inherited),
        cmocka_unit_test(groups_have_keys_of_the_members_that_can_differ),
        cmocka_unit_test(every_row_of_settings_is_about_a_member),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
