// desc.c - defaults and copies of public structs, and the check of every number in them.
#include "lib/base/desc.h"

#include <stdio.h>
#include <string.h>

#define OLDEST_VERSION 200u // The structs of earlier versions have another layout.

// Return whether a member has a range. Pointers have none, and names of textures are checked where
// they are used.
static bool has_range(const hair_member* member)
{
    return member->type != HAIR_MEMBER_POINTER && member->type != HAIR_MEMBER_TEXTURE &&
           member->type != HAIR_MEMBER_UINT64;
}

static double read_element(const void* desc, const hair_member* member, uint32_t i)
{
    const unsigned char* at = (const unsigned char*)desc + member->offset + i * member->size;
    HAIR_ASSERT(i < member->count && member->offset % member->size == 0);
    if (member->type == HAIR_MEMBER_BOOL) return *at; // A bool of a caller may hold any byte.
    if (member->type == HAIR_MEMBER_FLOAT) {
        float value;
        memcpy(&value, at, sizeof value);
        return value;
    }
    uint32_t value;
    memcpy(&value, at, sizeof value);
    return value;
}

static void write_default(void* desc, const hair_member* member)
{
    for (uint32_t i = 0; i < member->count; ++i) {
        unsigned char* at = (unsigned char*)desc + member->offset + i * member->size;
        double value = member->defaults[i];
        float real = (float)value;
        uint32_t whole = member->type == HAIR_MEMBER_FLOAT ? 0 : (uint32_t)value;
        if (member->type == HAIR_MEMBER_BOOL)
            *at = value != 0;
        else if (member->type == HAIR_MEMBER_FLOAT)
            memcpy(at, &real, sizeof real);
        else if (member->type != HAIR_MEMBER_UINT64) // Its default is 0.
            memcpy(at, &whole, sizeof whole);
    }
}

static void write_defaults(void* desc, size_t size, struct hair_schema schema)
{
    HAIR_ASSERT(schema.member || !schema.count);
    memset(desc, 0, size);
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* member = &schema.member[i];
        if (member->defaults && member->offset + member->count * member->size <= size)
            write_default(desc, member);
    }
}

// Clear the padding after a truth value, which ends at the next member or at a multiple of 4. Descs
// can then be compared as bytes.
static void clear_padding(void* desc, struct hair_schema schema, uint32_t i)
{
    uint32_t begin = schema.member[i].offset + 1, end = (begin + 3) / 4 * 4;
    if (i + 1 < schema.count && schema.member[i + 1].offset < end) end = schema.member[i + 1].offset;
    if (end > schema.size) end = schema.size;
    HAIR_ASSERT(begin <= end);
    memset((unsigned char*)desc + begin, 0, end - begin);
}

void hair_schema_init(void* desc, hair_struct_header header, struct hair_schema schema)
{
    if (!desc || header.size < sizeof header) return;
    write_defaults(desc, header.size, schema);
    memcpy(desc, &header, sizeof header);
}

void hair_schema_init_plain(void* desc, size_t size, struct hair_schema schema)
{
    if (desc) write_defaults(desc, size, schema);
}

hair_result hair_check_header(const hair_host* host, const char* name, hair_struct_header header)
{
    if (header.size < sizeof header || header.size > 4096 || header.version == 0)
        return hair_fail(host, HAIR_ERROR_VERSION, "%s.header is (%u, %u), not from %s_default()", name,
                         header.size, header.version, name);
    if (header.version / 10000 != HAIR_VERSION_MAJOR)
        return hair_fail(host, HAIR_ERROR_VERSION,
                         "%s.header.version is %u, of another major version than %u", name, header.version,
                         HAIR_VERSION);
    if (header.version < OLDEST_VERSION)
        return hair_fail(host, HAIR_ERROR_VERSION, "%s.header.version is %u, older than %u", name,
                         header.version, OLDEST_VERSION);
    return HAIR_OK;
}

// Return the first element outside the range, or the number of elements without one.
static uint32_t find_outside(const void* desc, const hair_member* member)
{
    if (!has_range(member)) return member->count;
    bool is_float = member->type == HAIR_MEMBER_FLOAT;
    double min = is_float ? (float)member->min : member->min;
    double max = is_float ? (float)member->max : member->max;
    HAIR_ASSERT(min <= max);
    for (uint32_t i = 0; i < member->count; ++i) {
        double value = read_element(desc, member, i);
        // The default 0 outside the range marks a number that every application must set.
        HAIR_ASSERT(member->defaults[i] == 0 ||
                    (member->min <= member->defaults[i] && member->defaults[i] <= member->max));
        if (!(value >= min && value <= max)) return i; // Written so that NaN fails too.
    }
    return member->count;
}

static hair_result fail_outside(const hair_host* host, const char* name, const void* desc,
                                const hair_member* member, uint32_t i)
{
    char element[16] = "";
    int digits = member->type == HAIR_MEMBER_FLOAT ? 9 : 10;
    if (member->count > 1)
        snprintf(element, sizeof element, member->layout == HAIR_LAYOUT_CURVE ? ".at[%u]" : "[%u]", i);
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s.%s%s is %.*g, not in [%.*g, %.*g]", name, member->name,
                     element, digits, read_element(desc, member, i), digits, member->min, digits,
                     member->max);
}

hair_result hair_schema_check_member(const hair_host* host, const char* name, const void* desc,
                                     const hair_member* member)
{
    uint32_t i = find_outside(desc, member);
    return i == member->count ? HAIR_OK : fail_outside(host, name, desc, member, i);
}

hair_result hair_schema_check_element(const hair_host* host, const char* name, uint32_t index,
                                      const void* desc, struct hair_schema schema)
{
    for (uint32_t k = 0; k < schema.count; ++k) {
        const hair_member* member = &schema.member[k];
        uint32_t i = find_outside(desc, member);
        if (i == member->count) continue;
        char element[64];
        snprintf(element, sizeof element, "%s[%u]", name, index);
        return fail_outside(host, element, desc, member, i);
    }
    return HAIR_OK;
}

hair_result hair_schema_copy_in(const hair_host* host, const void* desc, void* own, struct hair_schema schema)
{
    if (!desc) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is NULL", schema.name);
    hair_struct_header header;
    memcpy(&header, desc, sizeof header);
    HAIR_TRY(hair_check_header(host, schema.name, header));

    write_defaults(own, schema.size, schema);
    memcpy(own, desc, header.size < schema.size ? header.size : schema.size);
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* member = &schema.member[i];
        HAIR_ASSERT(member->offset + member->count * member->size <= schema.size);
        HAIR_TRY(hair_schema_check_member(host, schema.name, own, member));
        if (member->type == HAIR_MEMBER_BOOL) clear_padding(own, schema, i);
    }
    return HAIR_OK;
}

hair_result hair_schema_copy_out(const hair_host* host, const void* own, void* out, struct hair_schema schema)
{
    HAIR_ASSERT(own && schema.size >= sizeof(hair_struct_header));
    if (!out) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is NULL", schema.name);
    hair_struct_header header;
    memcpy(&header, out, sizeof header);
    HAIR_TRY(hair_check_header(host, schema.name, header));
    memcpy(out, own, header.size < schema.size ? header.size : schema.size);
    memcpy(out, &header, sizeof header);
    return HAIR_OK;
}
