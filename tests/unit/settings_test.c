// settings_test.c - settings of the tools are the public numbers of the library: every value of an
// enum has a name, numbers of several structs are set in all, and no row is about nothing.
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

// Tools are not linked into tests.
#include "lib/draw/render_path.h"
#include "tools/common/file.c"
#include "tools/common/settings.c"
#include "tools/common/settings_fields.c"
#include "tools/common/settings_texts.c"

// Maximum of each row of `fields`. The first two rows are the tools' own.
static const double maximum[] = {
    1,
    1,
#define BEGIN(S)
#define FIELD(S, member, type, value, min, max) max,
#define MATRIX(S, member)
#define END(S)
#include "lib/api/schema.inl"
};

static uint32_t value_at(const struct hair_settings* settings, size_t offset)
{
    uint32_t value;
    memcpy(&value, (const char*)settings + offset, sizeof value);
    return value;
}

static void every_value_of_an_enum_has_a_name_that_sets_it(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    uint32_t enums = 0;
    for (size_t i = 0; i < COUNT(fields); ++i) {
        struct hair_setting setting;
        char names[128], name[64];
        if (!make_setting(&fields[i], &setting) || setting.kind != HAIR_SETTING_UINT) continue;
        const char* at = hair_setting_choices(setting.key, names);
        uint32_t count = 0;
        for (; at; ++count) {
            snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ","), at);
            assert_true(hair_settings_set("test", &settings, setting.key, name));
            assert_int_equal(value_at(&settings, setting.offset), count);
            at = strchr(at, ',') ? strchr(at, ',') + 2 : NULL;
        }
        enums += count > 0;
        if (count && count < maximum[i] + 1) fail_msg("%s has only %u names", setting.key, count);
    }
    assert_in_range(enums, 10, 30);
}

static void numbers_of_several_structs_are_set_in_all(void** state)
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

static void curves_have_evenly_spaced_points_of_their_text(void** state)
{
    (void)state;
    struct hair_settings settings = hair_settings_default();
    assert_true(hair_settings_set("test", &settings, "strand.taper", "0,7"));
    for (int i = 0; i < HAIR_SETTING_CURVE_POINTS; ++i)
        assert_float_equal(settings.look.strand.taper.at[i], (float)i, 1e-6);
    assert_true(hair_settings_set("test", &settings, "strand.taper", "0.25"));
    for (int i = 0; i < HAIR_SETTING_CURVE_POINTS; ++i)
        assert_float_equal(settings.look.strand.taper.at[i], 0.25f, 0);
}

static bool has_member(const char* owner, const char* member)
{
    for (size_t i = 0; i < COUNT(fields); ++i) {
        size_t length = strlen(member);
        char next = strncmp(fields[i].member, member, length) ? 'x' : fields[i].member[length];
        if (!strcmp(fields[i].owner, owner) && (next == 0 || next == '[')) return true;
    }
    return false;
}

// Check rows that outlive their member when the member is renamed or removed.
static void every_row_of_settings_is_about_a_public_number(void** state)
{
    (void)state;
    struct hair_setting setting;
    for (size_t i = 0; i < COUNT(excluded); ++i)
        if (!has_member(excluded[i][0], excluded[i][1])) fail_msg("there is no %s", excluded[i][1]);
    for (size_t i = 0; i < COUNT(renamed); ++i)
        if (!has_member(renamed[i].owner, renamed[i].member)) fail_msg("there is no %s", renamed[i].member);
    for (size_t i = 0; i < COUNT(components); ++i)
        if (!has_member(components[i].owner, components[i].member))
            fail_msg("there is no %s", components[i].member);
    for (size_t i = 0; i < TEXT_COUNT; ++i)
        if (!preset_of(texts[i].key, 0) && strcmp(texts[i].key, "fit_curl") &&
            !hair_setting_find(texts[i].key, &setting))
            fail_msg("there is no setting %s", texts[i].key);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_value_of_an_enum_has_a_name_that_sets_it),
        cmocka_unit_test(numbers_of_several_structs_are_set_in_all),
        cmocka_unit_test(curves_have_evenly_spaced_points_of_their_text),
        cmocka_unit_test(every_row_of_settings_is_about_a_public_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
