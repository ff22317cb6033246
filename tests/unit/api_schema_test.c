// api_schema_test.c - the tables of members agree with the comments of the public headers in names,
// ranges, defaults, units, sentences and choices.
#include "tests/support/headers.h"
#include "tests/support/support.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lib/base/schema.h"

typedef struct hair_test_member declared; // a member as its header declares it

#define TABLE(S) {#S, hair_schema_of_##S},
static const struct table {
    const char* name;
    struct hair_schema (*schema)(void);
} tables[] = {HAIR_SCHEMAS(TABLE, TABLE, TABLE)};
#define TABLES (sizeof tables / sizeof *tables)

// Run a check on every row of every table.
static uint32_t check_rows(void (*check)(const char* owner, const hair_member* row, const declared* member))
{
    uint32_t count = 0;
    for (size_t t = 0; t < TABLES; ++t) {
        struct hair_schema schema = tables[t].schema();
        for (uint32_t i = 0; i < schema.count; ++i) {
            const declared* member = hair_test_find_member(schema.name, schema.member[i].name);
            if (!member) fail_msg("%s.%s is in no header", schema.name, schema.member[i].name);
            check(schema.name, &schema.member[i], member);
        }
        count += schema.count;
    }
    return count;
}

// Ranges and defaults -----------------------------------------------------------------------------

// Read a value such as "3", "1/120", "true" or "HAIR_UP_Y".
static double read_value(const char* at)
{
    char* end;
    if (strncmp(at, "true", 4) == 0) return 1;
    if (strncmp(at, "HAIR_", 5) == 0)
        return hair_test_enumerator(at, strspn(at, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"));
    double value = strtod(at, &end);
    if (*end == '/') value /= strtod(end + 1, NULL);
    return value;
}

// Read the range "[a, b]" of a member's comment. Return 0 if there is none. A truth value has the
// range [0, 1].
static int read_range(const declared* member, double* min, double* max)
{
    *min = 0, *max = 1;
    if (strcmp(member->type, "bool") == 0) return 1;
    for (const char* at = strchr(member->comment, '['); at; at = strchr(at + 1, '['))
        if (sscanf(at, "[%lf, %lf]", min, max) == 2) return 1;
    return 0;
}

// Read the i-th value of "Default x", "Default (x, y, z)" or "Default identity". Return 0 if there
// is none.
static int read_default(const declared* member, uint32_t i, double* out)
{
    const char* at = strstr(member->comment, "Default ");
    if (!at) return 0;
    at += 8;
    *out = member->count == 4 ? i == 3 : i % 5 == 0; // A rotation is a quaternion.
    if (strncmp(at, "identity", 8) == 0) return 1;
    if (*at == '(') {
        ++at;
        for (uint32_t k = 0; k < i; ++k) at = strchr(at, ',') + 2;
    }
    *out = read_value(at);
    return 1;
}

static void check_value(const char* owner, const hair_member* row, const char* what, double said, double held)
{
    double difference = said > held ? said - held : held - said, size = held < 0 ? -held : held;
    if (!(difference <= 1e-9 * size))
        fail_msg("%s.%s: the header says %s %.9g, the table has %.9g", owner, row->name, what, said, held);
}

static void check_range(const char* owner, const hair_member* row, const declared* member)
{
    double min, max;
    char names[HAIR_TEST_ENUMERATORS][64];
    int enumerators = hair_test_enumerators(member->type, names);
    bool is_whole = row->type == HAIR_MEMBER_UINT64 || row->type == HAIR_MEMBER_TEXTURE;
    bool is_everything = row->max > 1e30 || (row->min == 0 && row->max == UINT32_MAX);
    if (row->type == HAIR_MEMBER_POINTER) {
        assert_true(member->is_pointer && row->min == 0 && row->max == 0);
    } else if (read_range(member, &min, &max)) {
        check_value(owner, row, "least", min, row->min);
        check_value(owner, row, "most", max, row->max);
    } else if (enumerators) {
        // The render path has one private value.
        int private_values = strcmp(row->name, "render_path") == 0;
        check_value(owner, row, "enumerators up to", enumerators - 1 + private_values, row->max);
        check_value(owner, row, "enumerators from", 0, row->min);
    } else if (!is_everything && !is_whole) {
        fail_msg("%s.%s: the header does not say that it is in [%.9g, %.9g]", owner, row->name, row->min,
                 row->max);
    }
}

static void check_defaults(const char* owner, const hair_member* row, const declared* member)
{
    double value;
    if (row->type == HAIR_MEMBER_POINTER) {
        assert_null(row->defaults);
        return;
    }
    for (uint32_t i = 0; i < row->count; ++i)
        if (read_default(member, i, &value))
            check_value(owner, row, "default", value, row->defaults[i]);
        else if (row->defaults[i] != 0)
            fail_msg("%s.%s: the header does not say that its default is %.9g", owner, row->name,
                     row->defaults[i]);
    bool has_auto = strstr(member->comment, "Default HAIR_AUTO") != NULL;
    if (row->has_auto != has_auto)
        fail_msg("%s.%s: HAIR_AUTO is %d in the table", owner, row->name, !has_auto);
}

static void ranges_of_the_table_are_in_the_headers(void** state)
{
    (void)state;
    uint32_t count = check_rows(check_range);
    print_message("    %u members\n", count);
    assert_true(count > 180);
}

static void defaults_of_the_table_are_in_the_headers(void** state)
{
    (void)state;
    check_rows(check_defaults);
}

static bool has_row(const declared* member)
{
    for (size_t t = 0; t < TABLES; ++t) {
        struct hair_schema schema = tables[t].schema();
        for (uint32_t i = 0; i < schema.count && !strcmp(schema.name, member->owner); ++i)
            if (!strcmp(schema.member[i].name, member->name)) return true;
    }
    return false;
}

static bool has_rows(const char* owner)
{
    for (size_t t = 0; t < TABLES; ++t)
        if (!strcmp(tables[t].name, owner)) return tables[t].schema().count > 0;
    return false;
}

// Check that every member of a struct that applications fill in has a row. The rest of hair_buffers
// are results, and rows of other structs stand for each member of a hair_map.
static void every_member_of_the_headers_is_in_the_table(void** state)
{
    (void)state;
    uint32_t count = 0;
    for (size_t i = 0; hair_test_member_at(i); ++i) {
        const declared* member = hair_test_member_at(i);
        bool is_result = !strcmp(member->owner, "hair_buffers") && !strstr(member->above, "Input.");
        bool is_map = !strcmp(member->type, "hair_map");
        if (!has_rows(member->owner) || is_result || is_map || !strcmp(member->name, "header")) continue;
        if (!has_row(member)) fail_msg("%s.%s is in no table", member->owner, member->name);
        ++count;
    }
    assert_true(count > 180);
}

// Texts -------------------------------------------------------------------------------------------

static bool is_unit(const char* text, size_t length)
{
    static const char* const units[] = {"m",  "s",  "m/s",  "m/s^2",  "m^2/s^2", "1/s",   "1/m",
                                        "Hz", "Pa", "Pa s", "kg/m^3", "Radians", "Turns", "Pixels"};
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i)
        if (strlen(units[i]) == length && strncmp(units[i], text, length) == 0) return true;
    return false;
}

// Copy the first sentence of a comment.
static void copy_sentence(const char* comment, char out[512])
{
    const char* end = strstr(comment, ". ");
    snprintf(out, 512, "%.*s", end ? (int)(end - comment) + 1 : (int)strlen(comment), comment);
}

// Copy what a comment behind a member says before the range and the default.
static void copy_before_range(const declared* member, char out[256])
{
    const char* end = strstr(member->comment, "Default ");
    size_t length = strcspn(member->comment, "[");
    if (end && (size_t)(end - member->comment) < length) length = (size_t)(end - member->comment);
    while (length && member->comment[length - 1] == ' ') --length;
    snprintf(out, 256, "%.*s", (int)length, member->comment);
}

static void check_unit(const char* owner, const hair_member* row, const declared* member)
{
    char text[256];
    if (row->type == HAIR_MEMBER_POINTER) return; // The unit is that of the array.
    copy_before_range(member, text);
    size_t length = strlen(text);
    if (length && text[length - 1] == '.') text[--length] = 0;
    const char* last = text;
    for (const char* at = text; (at = strstr(at, ". ")); ++at) last = at + 2;
    const char* unit = is_unit(last, strlen(last)) ? last : "";
    if (strcasecmp(row->unit, unit))
        fail_msg("%s.%s: the header says \"%s\", the table \"%s\"", owner, row->name, unit, row->unit);
}

// Check that the sentence is the first of the comment of the member, or else of its enum.
static void check_sentence(const char* owner, const hair_member* row, const declared* member)
{
    char text[256], comment[512], sentence[512];
    copy_before_range(member, text);
    copy_sentence(*member->above ? member->above : text, sentence);
    size_t length = strlen(sentence);
    if (length && is_unit(sentence, length - 1)) *sentence = 0;
    if (!*sentence) {
        hair_test_enum_comment(member->type, comment);
        copy_sentence(comment, sentence);
    }
    if (!*sentence || strcmp(sentence, row->about))
        fail_msg("%s.%s: the header says \"%s\", the table \"%s\"", owner, row->name, sentence, row->about);
}

// Check that the name of a choice is that of its enumerator, without what all enumerators share.
static void check_choices(const char* owner, const hair_member* row, const declared* member)
{
    char names[HAIR_TEST_ENUMERATORS][64];
    int count = hair_test_enumerators(member->type, names);
    assert_int_equal(row->choice_count, row->type == HAIR_MEMBER_ENUM ? row->max + 1 : 0);
    assert_true((row->type == HAIR_MEMBER_ENUM) == (count > 0 && !member->is_pointer));
    if (!row->choice_count) return;
    size_t shared = strspn(names[0], "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
    for (int i = 1; i < count; ++i)
        while (strncmp(names[0], names[i], shared)) --shared;
    while (shared && names[0][shared - 1] != '_') --shared;
    for (int i = 0; i < count; ++i) {
        for (char* c = names[i]; *c; ++c) *c = (char)tolower(*c);
        if (strcmp(names[i] + shared, row->choices[i]))
            fail_msg("%s.%s: choice %d is %s, not %s", owner, row->name, i, row->choices[i],
                     names[i] + shared);
    }
}

static void units_and_sentences_are_those_of_the_headers(void** state)
{
    (void)state;
    check_rows(check_unit);
    check_rows(check_sentence);
}

static void choices_are_the_enumerators_of_the_headers(void** state)
{
    (void)state;
    check_rows(check_choices);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_of_the_table_are_in_the_headers),
        cmocka_unit_test(defaults_of_the_table_are_in_the_headers),
        cmocka_unit_test(every_member_of_the_headers_is_in_the_table),
        cmocka_unit_test(units_and_sentences_are_those_of_the_headers),
        cmocka_unit_test(choices_are_the_enumerators_of_the_headers),
    };
    return cmocka_run_group_tests(tests, hair_test_read_headers, NULL);
}
