// members.c - public calls that describe the members of public structs, and members by name.
#include "lib/api/members.h"

#include <string.h>

// Tables in the order of hair_struct.
#define TABLE(S) hair_schema_of_##S,
#define NO_TABLE(S)
static struct hair_schema (*const schemas[])(void) = {HAIR_SCHEMAS(TABLE, TABLE, NO_TABLE)};
_Static_assert(sizeof schemas / sizeof *schemas == HAIR_STRUCT_COUNT, "a struct has no table, or no value");

struct hair_schema hair_schema_of_kind(hair_struct kind)
{
    return (unsigned)kind < HAIR_STRUCT_COUNT ? schemas[kind]() : (struct hair_schema){0};
}

const char* hair_struct_name(hair_struct kind)
{
    return hair_schema_of_kind(kind).name;
}

size_t hair_struct_size(hair_struct kind)
{
    return hair_schema_of_kind(kind).size;
}

uint32_t hair_describe(hair_struct kind, hair_member* out, uint32_t capacity, size_t stride)
{
    struct hair_schema schema = hair_schema_of_kind(kind);
    if (stride < sizeof(char*) || stride > HAIR_MAX_STRUCT) return 0;
    size_t known = stride < sizeof *out ? stride : sizeof *out;
    for (uint32_t i = 0; out && i < schema.count && i < capacity; ++i) {
        char* at = (char*)out + i * stride;
        memset(at, 0, stride);
        memcpy(at, &schema.member[i], known);
    }
    return schema.count;
}

// Names -------------------------------------------------------------------------------------------

const char* hair_quote(struct hair_span span, char out[64])
{
    size_t length = span.length < 63 ? span.length : 63;
    for (size_t i = 0; i < length; ++i)
        out[i] = span.text[i] >= ' ' && span.text[i] <= '~' ? span.text[i] : '?';
    out[length] = 0;
    return length ? out : "empty";
}

hair_result hair_check_struct(const hair_host* host, hair_struct kind, const void* desc, size_t size)
{
    struct hair_schema schema = hair_schema_of_kind(kind);
    if (!schema.name)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "the struct is %d, not in [0, %d]", (int)kind,
                         HAIR_STRUCT_COUNT - 1);
    if (!desc) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is NULL", schema.name);
    if (size < sizeof(hair_struct_header) || size > HAIR_MAX_STRUCT)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s has %zu bytes, not %zu to %d", schema.name, size,
                         sizeof(hair_struct_header), HAIR_MAX_STRUCT);
    if (!schema.has_header) return HAIR_OK;
    hair_struct_header header;
    memcpy(&header, desc, sizeof header);
    HAIR_TRY(hair_check_header(host, schema.name, header));
    if (header.size == size) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s has %zu bytes, but its header says %u", schema.name, size,
                     header.size);
}

static bool equals(struct hair_span span, const char* text)
{
    return strlen(text) == span.length && memcmp(span.text, text, span.length) == 0;
}

// Find an element by the text after the name of its member: ".x", "[3]", or ".at[3]" of a curve.
static bool find_element(const hair_member* member, struct hair_span rest, uint32_t* out)
{
    const char* at = rest.text;
    size_t length = rest.length;
    for (uint32_t i = 0; member->elements && i < member->count; ++i)
        if (*at == '.' && equals((struct hair_span){at + 1, length - 1}, member->elements[i])) {
            *out = i;
            return true;
        }
    if (member->layout == HAIR_LAYOUT_CURVE && length > 3 && !memcmp(at, ".at", 3)) at += 3, length -= 3;
    if (member->count == 1 || length < 3 || length > 4 || at[0] != '[' || at[length - 1] != ']') return false;
    *out = 0;
    for (size_t i = 1; i + 1 < length; ++i) {
        if (at[i] < '0' || at[i] > '9') return false;
        *out = 10 * *out + (uint32_t)(at[i] - '0');
    }
    return *out < member->count;
}

static bool find_member(struct hair_schema schema, struct hair_span name, struct hair_member_place* out)
{
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* member = &schema.member[i];
        size_t length = strlen(member->name);
        if (name.length < length || memcmp(name.text, member->name, length)) continue;
        struct hair_span rest = {name.text + length, name.length - length};
        *out = (struct hair_member_place){schema.name, member, 0, member->count};
        if (rest.length == 0) return true;
        if (!find_element(member, rest, &out->first)) continue;
        out->count = 1;
        return true;
    }
    return false;
}

hair_result hair_find_member(const hair_host* host, struct hair_schema schema, size_t size,
                             struct hair_span name, struct hair_member_place* out)
{
    char quoted[64];
    if (!find_member(schema, name, out))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s has no member %s", schema.name,
                         name.length ? hair_quote(name, quoted) : "without a name");
    const hair_member* member = out->member;
    if (!hair_member_is_text(member))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s.%s is a %s, which text cannot hold", schema.name,
                         member->name, member->type == HAIR_MEMBER_POINTER ? "pointer" : "texture");
    if (member->offset + member->count * member->size > size)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s.%s is newer than the struct of %zu bytes",
                         schema.name, member->name, size);
    return HAIR_OK;
}
