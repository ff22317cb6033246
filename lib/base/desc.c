// desc.c - defaults and copies of descs that can grow, and the check of every number in them.
#include "lib/base/desc.h"

#include <string.h>

static double read_field(const void* desc, const struct hair_field* field)
{
    const unsigned char* at = (const unsigned char*)desc + field->offset;
    if (field->type == HAIR_FIELD_UINT) {
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
    if (field->type == HAIR_FIELD_UINT) {
        uint32_t value = (uint32_t)field->value;
        memcpy(at, &value, sizeof value);
    } else {
        float value = (float)field->value;
        memcpy(at, &value, sizeof value);
    }
}

static void write_defaults(void* desc, uint32_t size, hair_made made, struct hair_fields fields)
{
    memset(desc, 0, size);
    memcpy(desc, &made, sizeof made);
    for (uint32_t i = 0; i < fields.count; ++i)
        if (fields.field[i].offset + 4 <= size) write_default(desc, &fields.field[i]);
}

void hair_fields_init(void* desc, hair_made made, struct hair_fields fields)
{
    if (!desc || made.size < sizeof made) return;
    write_defaults(desc, made.size, made, fields);
}

hair_result hair_made_check(const hair_host* host, const char* name, hair_made made)
{
    if (made.size < sizeof made || made.size > 4096 || made.version == 0)
        return hair_fail(host, HAIR_ERROR_VERSION, "%s.made is (%u, %u), not from %s_default()", name,
                         made.size, made.version, name);
    if (made.version / 10000 != HAIR_VERSION_MAJOR)
        return hair_fail(host, HAIR_ERROR_VERSION, "%s.made.version is %u, of another major version than %u",
                         name, made.version, HAIR_VERSION);
    return HAIR_OK;
}

hair_result hair_fields_take(const hair_host* host, const char* name, const void* desc, void* own,
                             struct hair_fields fields)
{
    if (!desc) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is NULL", name);
    hair_made made;
    memcpy(&made, desc, sizeof made);
    hair_result result = hair_made_check(host, name, made);
    if (result) return result;

    write_defaults(own, fields.size, made, fields);
    memcpy(own, desc, made.size < fields.size ? made.size : fields.size);
    for (uint32_t i = 0; i < fields.count; ++i) {
        const struct hair_field* field = &fields.field[i];
        double value = read_field(own, field);
        double least = field->type == HAIR_FIELD_FLOAT ? (float)field->min : field->min;
        double most = field->type == HAIR_FIELD_FLOAT ? (float)field->max : field->max;
        if (!(value >= least && value <= most)) // Written so that NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is %.9g, not in [%.9g, %.9g]", field->name, value,
                             field->min, field->max);
    }
    return HAIR_OK;
}
