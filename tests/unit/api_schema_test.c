// api_schema_test.c - ranges and defaults in the comments of the public headers agree with the
// table.
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/schema.h"

static const struct table {
    const char* name;
    struct hair_schema (*fields)(void);
} tables[] = {
#define BEGIN(S) {#S, hair_schema_of_##S},
#define FIELD(S, member, type, value, min, max)
#define MATRIX(S, member)
#define END(S)
#include "lib/api/schema.inl"
};
#define TABLES (sizeof tables / sizeof *tables)

// A member of a struct, as declared in its header. The name has that of its group: "curl.radius".
struct member {
    char owner[40], type[40], name[80];
    char comment[256];
};

static char headers[1 << 18]; // Text of all headers.
static struct member members[512];
static size_t member_count;

static void read_headers(void)
{
    static const char* const names[] = {"base", "groom",    "context", "look",        "physics", "colliders",
                                        "wind", "instance", "view",    "diagnostics", "buffers", "asset"};
    size_t size = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        char name[64];
        snprintf(name, sizeof name, "include/hair/hair_%s.h", names[i]);
        FILE* file = fopen(name, "rb");
        if (!file) fail_msg("%s is not there: run this where the Makefile is", name);
        size += fread(headers + size, 1, sizeof headers - 1 - size, file);
        fclose(file);
    }
    if (size == sizeof headers - 1) fail_msg("the headers are longer than %zu bytes", size);
}

// Read a member from a line such as "    float  scale;   ///< Metres per unit. [1e-6, 1e6]. Default
// 1."
static void read_member(const char* line, const char* owner)
{
    struct member member = {0};
    const char* end = strchr(line, ';');
    const char* about = strstr(line, "///<");
    snprintf(member.owner, sizeof member.owner, "%s", owner);
    const char* parenthesis = strchr(line, '(');
    if (!end || (parenthesis && parenthesis < end)) return; // The line is no member, or a function.
    if (sscanf(line, " %39s", member.type) != 1) return;
    const char* name = end;
    while (name > line && name[-1] != ' ' && name[-1] != '*') --name;
    snprintf(member.name, sizeof member.name, "%.*s", (int)strcspn(name, "[;"), name);
    if (about)
        snprintf(member.comment, sizeof member.comment, "%.*s", (int)strcspn(about + 4, "\n"), about + 4);
    members[member_count++] = member;
}

// Put the name of a group, which follows its members, before the names of its members.
static void close_group(const char* text, size_t first)
{
    for (size_t i = first; i < member_count; ++i) {
        char name[40];
        snprintf(name, sizeof name, "%.39s", members[i].name);
        snprintf(members[i].name, sizeof members[i].name, "%.*s.%s", (int)strcspn(text, ";"), text, name);
    }
}

static int read_members(void** state)
{
    (void)state;
    char owner[40] = "";
    size_t group = 0; // first member of the current group
    read_headers();
    for (char* line = headers; *line; line += strcspn(line, "\n") + 1) {
        char text[512];
        snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
        if (sscanf(text, "typedef struct %39s {", owner) == 1 && strchr(text, '{')) continue;
        if (*text == '}') *owner = 0;
        if (strcmp(text, "    struct {") == 0) group = member_count;
        if (strncmp(text, "    } ", 6) == 0)
            close_group(text + 6, group);
        else if (*owner && *text == ' ')
            read_member(text, owner);
        if (line[strcspn(line, "\n")] == 0) break;
    }
    return 0;
}

// Return the value of an enumerator, which is its position in its enum, or of HAIR_AUTO. Return -1
// if there is none of this name.
static double find_enumerator(const char* name, size_t length)
{
    if (length == strlen("HAIR_AUTO") && strncmp(name, "HAIR_AUTO", length) == 0) return HAIR_AUTO;
    for (const char* at = strstr(headers, "typedef enum"); at; at = strstr(at + 1, "typedef enum")) {
        const char* end = strchr(at, '}');
        double value = 0;
        for (const char* p = strchr(at, '{') + 1; p < end; ++p) {
            if (strncmp(p, "//", 2) == 0) p += strcspn(p, "\n");
            if (strncmp(p, "HAIR_", 5)) continue;
            size_t own = strspn(p, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789");
            if (own == length && strncmp(p, name, length) == 0) return value;
            ++value;
            p += own;
        }
    }
    return -1;
}

// Return the number of enumerators of the type, without the one that counts them. Return 0 if the
// type is no enum.
static int count_enumerators(const char* type)
{
    char head[64];
    snprintf(head, sizeof head, "typedef enum %s {", type);
    const char* at = strstr(headers, head);
    if (!at) return 0;
    int count = 0;
    for (const char* p = strchr(at, '{'); *p != '}'; ++p) {
        if (strncmp(p, "//", 2) == 0) p += strcspn(p, "\n");
        if (strncmp(p, "HAIR_", 5)) continue;
        size_t own = strspn(p, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789");
        count += strncmp(p + own - 6, "_COUNT", 6) != 0;
        p += own;
    }
    return count;
}

// Read a value such as "3", "1/120", "true" or "HAIR_UP_Y".
static double read_value(const char* at)
{
    char* end;
    if (strncmp(at, "true", 4) == 0) return 1;
    if (strncmp(at, "HAIR_", 5) == 0)
        return find_enumerator(at, strspn(at, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"));
    double value = strtod(at, &end);
    if (*end == '/') value /= strtod(end + 1, NULL);
    return value;
}

// Read the range "[a, b]" of a member's comment. Return 0 if there is none. A truth value has the
// range [0, 1].
static int read_range(const struct member* member, double* min, double* max)
{
    *min = 0, *max = 1;
    if (strcmp(member->type, "bool") == 0) return 1;
    for (const char* at = strchr(member->comment, '['); at; at = strchr(at + 1, '['))
        if (sscanf(at, "[%lf, %lf]", min, max) == 2) return 1;
    return 0;
}

// Read the i-th value of "Default x", "Default (x, y, z)" or "Default identity". Return 0 if there
// is none.
static int read_default(const char* comment, int i, double* out)
{
    const char* at = strstr(comment, "Default ");
    if (!at) return 0;
    at += 8;
    *out = i % 5 == 0;
    if (strncmp(at, "identity", 8) == 0) return 1;
    if (*at == '(') {
        ++at;
        for (int k = 0; k < i; ++k) at = strchr(at, ',') + 2;
    }
    *out = read_value(at);
    return 1;
}

static const struct member* find_member(const char* owner, const char* name)
{
    for (size_t i = 0; i < member_count; ++i)
        if (strcmp(members[i].owner, owner) == 0 && strcmp(members[i].name, name) == 0) return &members[i];
    return NULL;
}

static void check(const char* field, const char* what, double said, double held)
{
    double difference = said > held ? said - held : held - said, size = held < 0 ? -held : held;
    if (!(difference <= 1e-9 * size))
        fail_msg("%s: the header says %s %.9g, the table has %.9g", field, what, said, held);
}

// Return the length of the name that a header declares: that of curl.profile in
// "curl.profile.at[0]", and that of shading.gloss in "shading.gloss[1]".
static size_t declared_length(const char* name)
{
    const char* curve = strstr(name, ".at[");
    return curve ? (size_t)(curve - name) : strcspn(name, "[");
}

// Return the number of values that a field takes beside the public enumerators.
static int count_private_values(const char* field)
{
    return strcmp(field, "hair_view.render_path") == 0; // HAIR_RENDER_PATH_PROCEDURAL.
}

static void check_field(const char* owner, const struct hair_field* field)
{
    char name[48];
    const char* path = strchr(field->name, '.') + 1;
    const char* bracket = strchr(path, '[');
    int index = bracket ? atoi(bracket + 1) : 0;
    snprintf(name, sizeof name, "%.*s", (int)declared_length(path), path);
    const struct member* member = find_member(owner, name);
    if (!member) fail_msg("%s is in no header", field->name);

    double min, max, value;
    int enumerators = count_enumerators(member->type);
    int everything = field->max > 1e30 || (field->min == 0 && field->max == UINT32_MAX);
    if (read_range(member, &min, &max)) {
        check(field->name, "least", min, field->min);
        check(field->name, "most", max, field->max);
    } else if (enumerators) {
        check(field->name, "enumerators up to", enumerators - 1 + count_private_values(field->name),
              field->max);
        check(field->name, "enumerators from", 0, field->min);
    } else if (!everything) {
        fail_msg("%s: the header does not say that it is in [%.9g, %.9g]", field->name, field->min,
                 field->max);
    }
    if (read_default(member->comment, index, &value))
        check(field->name, "default", value, field->value);
    else if (field->value != 0)
        fail_msg("%s: the header does not say that its default is %.9g", field->name, field->value);
}

static void schema_ranges_and_defaults_are_in_the_headers(void** state)
{
    (void)state;
    uint32_t count = 0;
    for (size_t t = 0; t < TABLES; ++t) {
        struct hair_schema fields = tables[t].fields();
        for (uint32_t i = 0; i < fields.count; ++i) check_field(tables[t].name, &fields.field[i]);
        count += fields.count;
    }
    print_message("    %u numbers\n", count);
    assert_true(count > 100);
}

static int has_field(const struct member* member)
{
    for (size_t t = 0; t < TABLES; ++t) {
        if (strcmp(tables[t].name, member->owner)) continue;
        struct hair_schema fields = tables[t].fields();
        for (uint32_t i = 0; i < fields.count; ++i) {
            const char* name = strchr(fields.field[i].name, '.') + 1;
            if (declared_length(name) == strlen(member->name) &&
                strncmp(name, member->name, strlen(member->name)) == 0)
                return 1;
        }
    }
    return 0;
}

static int has_table(const char* owner)
{
    for (size_t t = 0; t < TABLES; ++t)
        if (strcmp(tables[t].name, owner) == 0) return tables[t].fields().count > 0;
    return 0;
}

// Check that headers promise no range outside the table, because the library checks only the table.
static void header_ranges_are_in_the_schema(void** state)
{
    (void)state;
    size_t ranges = 0;
    for (size_t i = 0; i < member_count; ++i) {
        const struct member* member = &members[i];
        double min, max;
        if (!has_table(member->owner) || strcmp(member->type, "const") == 0)
            continue; // Other tests check arrays.
        int range = read_range(member, &min, &max);
        if (!range && count_enumerators(member->type) == 0) continue;
        ++ranges;
        if (!has_field(member)) fail_msg("%s.%s is in no table", member->owner, member->name);
    }
    assert_true(ranges > 30);
}

// Check that the default functions return the table's defaults.
static void default_functions_return_the_schema_defaults(void** state)
{
    (void)state;
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    hair_light light = hair_light_default();
    assert_int_equal(physics.header.size, sizeof physics);
    assert_int_equal(physics.header.version, HAIR_VERSION);
    assert_true(physics.gravity[1] == -9.81f);
    assert_true(desc.substep == 0);
    for (int i = 0; i < 16; ++i) assert_true(desc.transform[i] == (float)(i % 5 == 0));
    assert_true(light.direction[1] == 0.8f);
}

// Check that members do not overlap. A member inside an older caller's shorter struct must not
// cross its end.
static void schema_fields_do_not_overlap(void** state)
{
    (void)state;
    for (size_t t = 0; t < TABLES; ++t) {
        struct hair_schema fields = tables[t].fields();
        for (uint32_t i = 0; i < fields.count; ++i) {
            assert_true(fields.field[i].offset >= sizeof(hair_struct_header) &&
                        fields.field[i].offset + hair_schema_size(fields.field[i].type) <= fields.size);
            for (uint32_t k = 0; k < i; ++k)
                assert_true(fields.field[k].offset + hair_schema_size(fields.field[k].type) <=
                            fields.field[i].offset);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(schema_ranges_and_defaults_are_in_the_headers),
        cmocka_unit_test(header_ranges_are_in_the_schema),
        cmocka_unit_test(default_functions_return_the_schema_defaults),
        cmocka_unit_test(schema_fields_do_not_overlap),
    };
    return cmocka_run_group_tests(tests, read_members, NULL);
}
