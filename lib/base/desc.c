// desc.c - defaults and copies of descs that can grow, and the check of every number in them.
#include "lib/base/desc.h"

#include <string.h>

#define OLDEST_VERSION 200u // The structs of earlier versions have another layout.

static double read_field(const void* desc, const struct hair_field* field)
{
    const unsigned char* at = (const unsigned char*)desc + field->offset;
    HAIR_ASSERT(field->offset % hair_schema_size(field->type) == 0);
    HAIR_ASSERT(field->offset >= sizeof(hair_struct_header));
    if (field->type == HAIR_SCHEMA_BOOL) return *at; // A bool of a caller may hold any byte.
    if (field->type == HAIR_SCHEMA_UINT) {
        uint32_t value;
        memcpy(&value, at, sizeof value);
        return value;
    }
    float value;
    memcpy(&value, at, sizeof value);
    return value;
}

static void write_default(void* desc, const struct hair_field* field)
{
    unsigned char* at = (unsigned char*)desc + field->offset;
    if (field->type == HAIR_SCHEMA_BOOL) {
        *at = field->value != 0;
    } else if (field->type == HAIR_SCHEMA_UINT) {
        uint32_t value = (uint32_t)field->value;
        memcpy(at, &value, sizeof value);
    } else {
        float value = (float)field->value;
        memcpy(at, &value, sizeof value);
    }
}

static void write_defaults(void* desc, uint32_t size, hair_struct_header header, struct hair_schema fields)
{
    HAIR_ASSERT(size >= sizeof header && fields.field);
    memset(desc, 0, size);
    memcpy(desc, &header, sizeof header);
    for (uint32_t i = 0; i < fields.count; ++i)
        if (fields.field[i].offset + hair_schema_size(fields.field[i].type) <= size)
            write_default(desc, &fields.field[i]);
}

// Clear the padding after a truth value, which ends at the next field or at a multiple of 4. Descs
// can then be compared as bytes.
static void clear_padding(void* desc, struct hair_schema fields, uint32_t i)
{
    uint32_t begin = fields.field[i].offset + 1, end = (begin + 3) / 4 * 4;
    if (i + 1 < fields.count && fields.field[i + 1].offset < end) end = fields.field[i + 1].offset;
    if (end > fields.size) end = fields.size;
    HAIR_ASSERT(begin <= end);
    memset((unsigned char*)desc + begin, 0, end - begin);
}

void hair_schema_init(void* desc, hair_struct_header header, struct hair_schema fields)
{
    if (!desc || header.size < sizeof header) return;
    write_defaults(desc, header.size, header, fields);
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

hair_result hair_schema_copy_in(const hair_host* host, const char* name, const void* desc, void* own,
                                struct hair_schema fields)
{
    if (!desc) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is NULL", name);
    hair_struct_header header;
    memcpy(&header, desc, sizeof header);
    HAIR_TRY(hair_check_header(host, name, header));

    write_defaults(own, fields.size, header, fields);
    memcpy(own, desc, header.size < fields.size ? header.size : fields.size);
    for (uint32_t i = 0; i < fields.count; ++i) {
        const struct hair_field* field = &fields.field[i];
        HAIR_ASSERT(field->offset + hair_schema_size(field->type) <= fields.size);
        // The default 0 outside the range marks a number that every application must set.
        HAIR_ASSERT(field->min <= field->max);
        HAIR_ASSERT(field->value == 0 || (field->min <= field->value && field->value <= field->max));
        double value = read_field(own, field);
        double min = field->type == HAIR_SCHEMA_FLOAT ? (float)field->min : field->min;
        double max = field->type == HAIR_SCHEMA_FLOAT ? (float)field->max : field->max;
        if (!(value >= min && value <= max)) // Written so that NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is %.9g, not in [%.9g, %.9g]", field->name, value,
                             field->min, field->max);
        if (field->type == HAIR_SCHEMA_BOOL) clear_padding(own, fields, i);
    }
    return HAIR_OK;
}
