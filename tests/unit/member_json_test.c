// member_json_test.c - public structs are written as JSON and read again to the same bits. Any
// other text is refused and changes nothing.
#include "tests/support/kinds.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LENGTH 16384 // of the JSON of a struct

static struct hair_test_host test;
static hair_member members[HAIR_TEST_MEMBERS];
static char text[LENGTH];

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    return 0;
}

static hair_result read_look(hair_look* look, const char* json)
{
    return hair_read_json(&test.host, HAIR_STRUCT_LOOK, look, sizeof *look, json, strlen(json));
}

static void json_of_every_struct_gives_the_same_bits(void** state)
{
    (void)state;
    uint32_t seed = 1;
    for (int i = 0; i < HAIR_STRUCT_COUNT; ++i) {
        hair_struct kind = (hair_struct)i;
        size_t size = hair_test_kinds[i].size, length;
        uint32_t count = hair_test_describe(kind, members);
        for (int round = 0; round < 50; ++round) {
            _Alignas(16) unsigned char varied[HAIR_TEST_STRUCT], desc[HAIR_TEST_STRUCT];
            hair_test_kinds[i].init(varied);
            hair_test_kinds[i].init(desc);
            for (uint32_t k = 0; k < count; ++k)
                if (hair_test_is_text(&members[k])) hair_test_vary(varied, &members[k], &seed);
            assert_int_equal(hair_write_json(&test.host, kind, varied, size, NULL, text, LENGTH, &length), 0);
            assert_int_equal(strlen(text), length);
            assert_int_equal(hair_read_json(&test.host, kind, desc, size, text, length), HAIR_OK);
            for (uint32_t k = 0; k < count; ++k)
                if (memcmp(desc + members[k].offset, varied + members[k].offset,
                           members[k].size * members[k].count))
                    fail_msg("%s.%s has changed", hair_test_kinds[i].name, members[k].name);
        }
    }
    assert_int_equal(test.errors, 0);
}

// Check defaults, some of which are out of range because every application sets them.
static void defaults_of_every_struct_are_written(void** state)
{
    (void)state;
    for (int i = 0; i < HAIR_STRUCT_COUNT; ++i) {
        _Alignas(16) unsigned char desc[HAIR_TEST_STRUCT], again[HAIR_TEST_STRUCT];
        size_t size = hair_test_kinds[i].size, length;
        hair_test_kinds[i].init(desc);
        hair_test_kinds[i].init(again);
        assert_int_equal(hair_write_json(&test.host, (hair_struct)i, desc, size, NULL, text, LENGTH, &length),
                         0);
        assert_int_equal(hair_read_json(&test.host, (hair_struct)i, again, size, text, length), HAIR_OK);
        assert_memory_equal(desc, again, size);
    }
}

static void preset_is_the_difference_from_a_base(void** state)
{
    (void)state;
    hair_look base = hair_look_default(), look = base, again = base;
    size_t length;
    assert_int_equal(
        hair_write_json(NULL, HAIR_STRUCT_LOOK, &look, sizeof look, &base, text, LENGTH, &length), 0);
    assert_string_equal(text, "{}\n");
    look.color.root[1] = 0.5f;
    look.curl.shape = HAIR_CURL_SHAPE_EXAMPLE;
    look.wetness = 0.25f;
    assert_int_equal(
        hair_write_json(NULL, HAIR_STRUCT_LOOK, &look, sizeof look, &base, text, LENGTH, &length), 0);
    assert_string_equal(text, "{\n"
                              "  \"color.root\": [0.13, 0.5, 0.024],\n"
                              "  \"curl.shape\": \"example\",\n"
                              "  \"wetness\": 0.25\n"
                              "}\n");
    again.strand.segments = 7;
    assert_int_equal(read_look(&again, text), HAIR_OK);
    look.strand.segments = 7; // This member is not in the preset.
    assert_memory_equal(&again, &look, sizeof look);
}

static void json_of_another_program_is_read(void** state)
{
    (void)state;
    hair_look look = hair_look_default();
    assert_int_equal(
        read_look(&look, " \t\r\n{ \"strand.segments\" : 18 ,\n\"color.root.g\":2.5E-1, \"strays.frizz\":[ "
                         "0.0 , 1e-2 ], \"strand.taper[7]\": -0, \"curl.shape\":\"helix\" } \n"),
        HAIR_OK);
    assert_int_equal(look.strand.segments, 18);
    assert_true(look.color.root[1] == 0.25f && look.strays.frizz.at[7] == 0.01f);
    assert_true(look.strand.taper.at[7] == 0 && signbit(look.strand.taper.at[7]));
    hair_lod lod = hair_lod_default();
    assert_int_equal(hair_read_json(NULL, HAIR_STRUCT_LOD, &lod, sizeof lod, "{\"per_patch\":false}x", 19),
                     0);
    assert_false(lod.per_patch);
}

static void other_text_is_refused_and_changes_nothing(void** state)
{
    (void)state;
    static const struct {
        const char *json, *words;
        hair_result result;
    } wrong[] = {
        {"", "byte 0 of the JSON of hair_look: there is no '{'", HAIR_ERROR_FILE},
        {"[]", "byte 0 of", HAIR_ERROR_FILE},
        {"{", "byte 1 of the JSON of hair_look: there is no '\"'", HAIR_ERROR_FILE},
        {"{}x", "byte 2 of the JSON of hair_look: there is text after the object", HAIR_ERROR_FILE},
        {"{} {}", "byte 3 of", HAIR_ERROR_FILE},
        {"{\"wetness\": 1,}", "there is no '\"'", HAIR_ERROR_FILE},
        {"{\"wetness\" 1}", "there is no ':'", HAIR_ERROR_FILE},
        {"{\"wetness\": 1", "there is no '}'", HAIR_ERROR_FILE},
        {"{\"wetness\": }", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": .5}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": 01}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": +1}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": 1.}", "there is no digit after the point", HAIR_ERROR_FILE},
        {"{\"wetness\": 1e}", "there is no digit in the exponent", HAIR_ERROR_FILE},
        {"{\"wetness\": 1 1}", "there is no '}'", HAIR_ERROR_FILE},
        {"{\"wetness\": NaN}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": null}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": \"1\"}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wetness\": [1]}", "there is no number", HAIR_ERROR_FILE},
        {"{\"wet\\u006eess\": 1}", "an escape is in no name", HAIR_ERROR_FILE},
        {"{\"wetness\n\": 1}", "a control character", HAIR_ERROR_FILE},
        {"{\"wetness", "there is no '\"'", HAIR_ERROR_FILE},
        {"{\"color.root\": 1}", "there is no '['", HAIR_ERROR_FILE},
        {"{\"color.root\": [1, 1, 1}", "there is no ']'", HAIR_ERROR_FILE},
        {"{\"color.root\": [1, 1, ]}", "there is no number", HAIR_ERROR_FILE},
        {"{\"color.root\": []}", "there is no number", HAIR_ERROR_FILE},
        {"{\"color.root\": [1, [1], 1]}", "there is no number", HAIR_ERROR_FILE},
        {"{\"color.root\": [1, 1]}", "hair_look.color.root is 1, 1, not 3 numbers", HAIR_ERROR_ARGUMENT},
        {"{\"curl.shape\": 0}", "there is no '\"'", HAIR_ERROR_FILE},
        {"{\"curl.shape\": \"spiral\"}", "hair_look.curl.shape is spiral, not one of: helix",
         HAIR_ERROR_ARGUMENT},
        {"{\"wetness\": 2}", "hair_look.wetness is 2, not in [0, 1]", HAIR_ERROR_ARGUMENT},
        {"{\"wetness\": 1e999}", "hair_look.wetness is inf, not in [0, 1]", HAIR_ERROR_ARGUMENT},
        {"{\"strand.segments\": 1.5}", "not a whole number", HAIR_ERROR_ARGUMENT},
        {"{\"wet\": 1}", "hair_look has no member wet", HAIR_ERROR_ARGUMENT},
        {"{\"strand\": {\"segments\": 1}}", "hair_look has no member strand", HAIR_ERROR_ARGUMENT},
        {"{\"wetness\": 0.5, \"wetness\": 0.5}", "hair_look.wetness is in the JSON twice",
         HAIR_ERROR_ARGUMENT},
        {"{\"color.root.r\": 0.5, \"color.root\": [1, 1, 1]}", "color.root is in the JSON twice",
         HAIR_ERROR_ARGUMENT},
        {"{\"wetness\": 0.5, \"strand.length\": 9}", "hair_look.strand.length is 9", HAIR_ERROR_ARGUMENT},
    };
    hair_look look = hair_look_default(), before = look;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        uint32_t errors = test.errors;
        hair_result result = read_look(&look, wrong[i].json);
        if (result != wrong[i].result) fail_msg("%s: %s", wrong[i].json, hair_result_string(result));
        if (!strstr(test.sentence, wrong[i].words))
            fail_msg("%s: \"%s\" lacks \"%s\"", wrong[i].json, test.sentence, wrong[i].words);
        assert_int_equal(test.errors, errors + 1);
        assert_memory_equal(&look, &before, sizeof look);
    }
}

// Check every beginning of a valid text, in memory of its exact length, and every changed byte.
static void cut_and_damaged_text_is_refused_or_read(void** state)
{
    (void)state;
    hair_look look = hair_look_default(), before = look;
    size_t length;
    assert_int_equal(hair_write_json(NULL, HAIR_STRUCT_LOOK, &look, sizeof look, NULL, text, LENGTH, &length),
                     0);
    for (size_t cut = 0; cut + 1 < length; ++cut) {
        char* part = malloc(cut + 1);
        memcpy(part, text, cut);
        assert_int_not_equal(hair_read_json(NULL, HAIR_STRUCT_LOOK, &look, sizeof look, part, cut), HAIR_OK);
        free(part);
    }
    assert_memory_equal(&look, &before, sizeof look);
    for (size_t i = 0; i < length; ++i)
        for (int bit = 0; bit < 8; ++bit) {
            text[i] = (char)(text[i] ^ 1 << bit);
            hair_look own = before;
            hair_result result = hair_read_json(NULL, HAIR_STRUCT_LOOK, &own, sizeof own, text, length);
            text[i] = (char)(text[i] ^ 1 << bit);
            if (result) assert_memory_equal(&own, &before, sizeof own);
        }
}

static void wrong_arguments_are_refused(void** state)
{
    (void)state;
    hair_look look = hair_look_default(), other = look;
    const hair_struct kind = HAIR_STRUCT_LOOK;
    size_t length = 0, size = sizeof look;
    assert_int_equal(hair_write_json(&test.host, kind, &look, size, NULL, NULL, 0, &length), HAIR_OK);
    assert_in_range(length, 1000, LENGTH - 1);
    assert_int_equal(hair_write_json(&test.host, kind, &look, size, NULL, text, length, NULL),
                     HAIR_ERROR_ARGUMENT);
    assert_string_equal(text, "");
    assert_int_equal(hair_write_json(&test.host, kind, &look, size, NULL, text, length + 1, NULL), HAIR_OK);
    assert_int_equal(hair_write_json(&test.host, kind, &look, size, NULL, NULL, 4, NULL),
                     HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_read_json(&test.host, kind, &look, size, NULL, 0), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_read_json(&test.host, HAIR_STRUCT_COUNT, &look, size, "{}", 2),
                     HAIR_ERROR_ARGUMENT);
    other.header.version = 0;
    assert_int_equal(hair_write_json(&test.host, kind, &look, size, &other, text, LENGTH, NULL),
                     HAIR_ERROR_VERSION);
    look.wetness = NAN;
    assert_int_equal(hair_write_json(&test.host, kind, &look, size, NULL, text, LENGTH, NULL),
                     HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "hair_look.wetness is nan, not in [0, 1]"));
}

#define TEST(function) cmocka_unit_test_setup(function, start)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(json_of_every_struct_gives_the_same_bits),
        TEST(defaults_of_every_struct_are_written),
        TEST(preset_is_the_difference_from_a_base),
        TEST(json_of_another_program_is_read),
        TEST(other_text_is_refused_and_changes_nothing),
        TEST(cut_and_damaged_text_is_refused_or_read),
        TEST(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
