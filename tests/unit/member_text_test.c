// member_text_test.c - members of public structs are set and got by name as text, to the same bits.
#include "tests/support/kinds.h"
#include "tests/support/support.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define LENGTH 512 // of the text of a member

static struct hair_test_host test;
static hair_member members[HAIR_TEST_MEMBERS];

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    return 0;
}

static void check_round_trip(hair_struct kind, const hair_member* member, const void* varied, void* desc)
{
    char text[LENGTH], name[96];
    size_t length = 0, size = hair_test_kinds[kind].size, bytes = (size_t)member->count * member->size;
    assert_int_equal(
        hair_get_member(&test.host, kind, varied, size, member->name, text, sizeof text, &length), HAIR_OK);
    assert_int_equal(strlen(text), length);
    assert_int_equal(hair_set_member(&test.host, kind, desc, size, member->name, text), HAIR_OK);
    if (memcmp((char*)desc + member->offset, (const char*)varied + member->offset, bytes))
        fail_msg("%s.%s is not %s again", hair_test_kinds[kind].name, member->name, text);
    for (uint32_t k = 0; k < member->count && member->count > 1; ++k) {
        snprintf(name, sizeof name, "%s[%u]", member->name, k);
        if (member->elements) snprintf(name, sizeof name, "%s.%s", member->name, member->elements[k]);
        memset((char*)desc + member->offset + k * member->size, 0, member->size);
        assert_int_equal(hair_get_member(&test.host, kind, varied, size, name, text, sizeof text, NULL), 0);
        hair_set_member(&test.host, kind, desc, size, name, text); // 0 may be out of range.
    }
    assert_memory_equal((char*)desc + member->offset, (const char*)varied + member->offset, bytes);
}

static void text_of_every_member_gives_the_same_bits(void** state)
{
    (void)state;
    uint32_t seed = 1;
    for (int kind = 0; kind < HAIR_STRUCT_COUNT; ++kind) {
        _Alignas(16) unsigned char varied[HAIR_TEST_STRUCT], desc[HAIR_TEST_STRUCT];
        uint32_t count = hair_test_describe((hair_struct)kind, members);
        for (int round = 0; round < 200; ++round) {
            hair_test_kinds[kind].init(varied);
            hair_test_kinds[kind].init(desc);
            for (uint32_t i = 0; i < count; ++i) {
                if (!hair_test_is_text(&members[i])) continue;
                hair_test_vary(varied, &members[i], &seed);
                check_round_trip((hair_struct)kind, &members[i], varied, desc);
            }
        }
    }
    assert_int_equal(test.errors, 0);
}

static void text_of_a_number_is_short(void** state)
{
    (void)state;
    static const struct {
        float value;
        const char* text;
    } known[] = {{4, "4"},         {0.1f, "0.1"},          {3.3f, "3.3"}, {1300, "1300"},
                 {1e-5f, "1e-05"}, {16777215, "16777215"}, {-0.0f, "-0"}, {1.0f / 3, "0.33333334"}};
    hair_light light = hair_light_default();
    char text[LENGTH];
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
        light.position[1] = known[i].value;
        assert_int_equal(hair_get_member(NULL, HAIR_STRUCT_LIGHT, &light, sizeof light, "position.y", text,
                                         sizeof text, NULL),
                         HAIR_OK);
        assert_string_equal(text, known[i].text);
    }
    hair_physics physics = hair_physics_default();
    hair_get_member(NULL, HAIR_STRUCT_PHYSICS, &physics, sizeof physics, "fiber.youngs_modulus", text,
                    sizeof text, NULL);
    assert_string_equal(text, "4e+09");
}

static void text_is_equal_in_every_locale(void** state)
{
    (void)state;
    static const char* const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"};
    hair_physics physics = hair_physics_default();
    char text[LENGTH];
    for (int i = 0; i < 3; ++i) {
        setlocale(LC_ALL, locales[i]);
        assert_int_equal(hair_set_member(NULL, HAIR_STRUCT_PHYSICS, &physics, sizeof physics, "drag", "0.5"),
                         0);
        assert_true(physics.drag == 0.5f);
        hair_get_member(NULL, HAIR_STRUCT_PHYSICS, &physics, sizeof physics, "drag", text, sizeof text, NULL);
        assert_string_equal(text, "0.5");
    }
    setlocale(LC_ALL, "C");
}

// Refusals ----------------------------------------------------------------------------------------

static void check_end(hair_struct kind, const hair_member* member, double value, hair_result expected)
{
    _Alignas(16) unsigned char desc[HAIR_TEST_STRUCT], before[HAIR_TEST_STRUCT];
    char text[64], words[160];
    hair_test_kinds[kind].init(desc);
    memcpy(before, desc, sizeof desc);
    snprintf(text, sizeof text, "%.17g", value);
    char name[96];
    snprintf(name, sizeof name, member->count > 1 ? "%s[1]" : "%s", member->name);
    hair_result result = hair_set_member(&test.host, kind, desc, hair_test_kinds[kind].size, name, text);
    if (result != expected)
        fail_msg("%s.%s = %s: %s", hair_test_kinds[kind].name, name, text, hair_result_string(result));
    if (!result) return;
    assert_memory_equal(desc, before, hair_test_kinds[kind].size);
    snprintf(words, sizeof words, "%s.%s", hair_test_kinds[kind].name, member->name);
    assert_memory_equal(test.sentence, words, strlen(words));
    snprintf(words, sizeof words, "not in [%.*g, %.*g]", member->type == HAIR_MEMBER_FLOAT ? 9 : 10,
             member->min, member->type == HAIR_MEMBER_FLOAT ? 9 : 10, member->max);
    if (!strstr(test.sentence, words)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, words);
}

// Check the ranges of the text. tests/gpu/errors_range_test.c passes values to the calls that use
// the structs, which have the same ranges.
static void set_member_accepts_exactly_the_range(void** state)
{
    (void)state;
    for (int i = 0; i < HAIR_STRUCT_COUNT; ++i) {
        hair_struct kind = (hair_struct)i;
        uint32_t count = hair_test_describe(kind, members);
        for (uint32_t k = 0; k < count; ++k) {
            const hair_member* member = &members[k];
            bool is_float = member->type == HAIR_MEMBER_FLOAT;
            if (!is_float && member->type != HAIR_MEMBER_UINT) continue;
            check_end(kind, member, member->min, HAIR_OK);
            check_end(kind, member, member->max, HAIR_OK);
            double above = is_float ? (double)nextafterf((float)member->max, INFINITY) : member->max + 1;
            double below = is_float ? (double)nextafterf((float)member->min, -INFINITY) : member->min - 1;
            check_end(kind, member, above, HAIR_ERROR_ARGUMENT);
            check_end(kind, member, below, HAIR_ERROR_ARGUMENT);
        }
    }
}

static void hostile_names_and_texts_are_refused_with_a_sentence(void** state)
{
    (void)state;
    static char long_text[70000];
    memset(long_text, 'x', sizeof long_text - 1);
    static const struct {
        const char *name, *text, *words;
    } wrong[] = {
        {"", "1", "hair_look has no member without a name"},
        {"nothing", "1", "hair_look has no member nothing"},
        {long_text, "1", "hair_look has no member xxx"},
        {"\x1b[31m\n", "1", "hair_look has no member ?[31m?"},
        {"strand", "1", "no member strand"},
        {"strand.", "1", "no member strand."},
        {"strand.segments.x", "1", "no member"},
        {"strand.segments[0]", "1", "no member"},
        {"strand.taper[8]", "1", "no member"},
        {"strand.taper[-1]", "1", "no member"},
        {"strand.taper[0", "1", "no member"},
        {"strand.taper[]", "1", "no member"},
        {"strand.taper[00000000000000000000]", "1", "no member"},
        {"strand.taper.at", "1", "no member"},
        {"color.root.x", "1", "no member"},
        {"color.root.", "1", "no member"},
        {"strand.segments", "", "hair_look.strand.segments is empty, not a whole number"},
        {"strand.segments", long_text, "not a whole number"},
        {"strand.segments", "1.5", "is 1.5, not a whole number"},
        {"strand.segments", "18 19", "is 18 19, not a whole number"},
        {"strand.segments", "1e99", "not in [1, 256]"},
        {"strand.segments", "nan", "not a whole number"},
        {"strand.length", "nan", "hair_look.strand.length is nan, not in [0.01, 1]"},
        {"strand.length", "1e999", "not in [0.01, 1]"},
        {"strand.length", "0,5", "not a number"},
        {"strand.length", "0x1", "not a number"},
        {"strand.length", "\n", "is empty, not a number"},
        {"color.root", "1", "hair_look.color.root is 1, not 3 numbers with commas between"},
        {"color.root", "1,1,1,1", "not 3 numbers"},
        {"color.root", "1,,1", "not 3 numbers"},
        {"color.root", "1,1,2", "hair_look.color.root[2] is 2, not in [0, 1]"},
        {"strand.taper", "1,2,3,4,5,6,7,8,9", "not 1 to 8 numbers"},
        {"strand.taper", "1,", "not 1 to 8 numbers"},
        {"strand.taper", "0,5", "hair_look.strand.taper.at[6] is 4.28571415, not in [0, 4]"},
        {"curl.shape", "spiral", "hair_look.curl.shape is spiral, not one of: helix, example"},
        {"curl.shape", "helix,", "not one of"},
        {"curl.shape", "0", "not one of"},
    };
    hair_look look = hair_look_default(), before = look;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        uint32_t errors = test.errors;
        assert_int_equal(
            hair_set_member(&test.host, HAIR_STRUCT_LOOK, &look, sizeof look, wrong[i].name, wrong[i].text),
            HAIR_ERROR_ARGUMENT);
        assert_int_equal(test.errors, errors + 1);
        if (!strstr(test.sentence, wrong[i].words))
            fail_msg("\"%s\" lacks \"%s\"", test.sentence, wrong[i].words);
        assert_memory_equal(&look, &before, sizeof look);
    }
}

static void refuse(hair_result expected, hair_struct kind, void* desc, size_t size, const char* name,
                   const char* words)
{
    char text[LENGTH];
    assert_int_equal(hair_set_member(&test.host, kind, desc, size, name, "1"), expected);
    if (!strstr(test.sentence, words)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, words);
    *test.sentence = 0;
    assert_int_equal(hair_get_member(&test.host, kind, desc, size, name, text, sizeof text, NULL), expected);
    if (!strstr(test.sentence, words)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, words);
}

static void wrong_structs_are_refused(void** state)
{
    (void)state;
    hair_look look = hair_look_default();
    hair_view view = hair_view_default();
    char words[64];
    snprintf(words, sizeof words, "the struct is %d, not in [0, %d]", HAIR_STRUCT_COUNT,
             HAIR_STRUCT_COUNT - 1);
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_COUNT, &look, sizeof look, "wetness", words);
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_LOOK, NULL, sizeof look, "wetness", "hair_look is NULL");
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_LOOK, &look, sizeof look - 4, "wetness", "its header says");
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_LOOK, &look, 0, "wetness", "hair_look has 0 bytes");
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_LOOK, &look, SIZE_MAX, "wetness", "bytes, not 8 to 4096");
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_LOOK, &look, sizeof look, NULL, "name is NULL");
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_VIEW, &view, sizeof view, "lights",
           "a pointer, which text cannot");
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_VIEW, &view, sizeof view, "color_texture", "is a texture");
    look.header.version = 0;
    refuse(HAIR_ERROR_VERSION, HAIR_STRUCT_LOOK, &look, sizeof look, "wetness", "hair_look_default()");
    // A caller of an older version has a shorter struct.
    look = hair_look_default();
    look.header.size = offsetof(hair_look, wetness);
    refuse(HAIR_ERROR_ARGUMENT, HAIR_STRUCT_LOOK, &look, look.header.size, "wetness",
           "newer than the struct");
    assert_int_equal(hair_set_member(NULL, HAIR_STRUCT_LOOK, &look, look.header.size, "strand.length", "0.5"),
                     0);
    assert_true(look.strand.length == 0.5f);
}

static void getters_end_their_text_and_refuse_invalid_values(void** state)
{
    (void)state;
    hair_physics physics = hair_physics_default();
    char text[16] = "xxxxxxxxxxxxxxx";
    size_t length = 0, size = sizeof physics;
    const hair_struct kind = HAIR_STRUCT_PHYSICS;
    assert_int_equal(hair_get_member(&test.host, kind, &physics, size, "gravity", NULL, 0, &length), HAIR_OK);
    assert_int_equal(length, strlen("0,-9.81,0"));
    assert_int_equal(hair_get_member(&test.host, kind, &physics, size, "gravity", text, length, NULL),
                     HAIR_ERROR_ARGUMENT);
    assert_string_equal(text, "");
    assert_int_equal(text[length], 'x');
    assert_int_equal(hair_get_member(&test.host, kind, &physics, size, "gravity", text, length + 1, NULL), 0);
    assert_string_equal(text, "0,-9.81,0");
    assert_int_equal(hair_get_member(&test.host, kind, &physics, size, "gravity", NULL, 4, NULL),
                     HAIR_ERROR_ARGUMENT);
    physics.gravity[2] = NAN;
    assert_int_equal(hair_get_member(&test.host, kind, &physics, size, "gravity", text, sizeof text, NULL),
                     HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "hair_physics.gravity[2] is nan, not in [-1000, 1000]"));
}

#define TEST(function) cmocka_unit_test_setup(function, start)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(text_of_every_member_gives_the_same_bits),
        TEST(text_of_a_number_is_short),
        TEST(text_is_equal_in_every_locale),
        TEST(set_member_accepts_exactly_the_range),
        TEST(hostile_names_and_texts_are_refused_with_a_sentence),
        TEST(wrong_structs_are_refused),
        TEST(getters_end_their_text_and_refuse_invalid_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
