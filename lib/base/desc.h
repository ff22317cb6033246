// desc.h - descs that can grow: their size and version, and the table that defines and checks their
// fields.
#ifndef HAIR_BASE_DESC_H
#define HAIR_BASE_DESC_H

#include "lib/base/host.h"

typedef enum hair_schema_type { HAIR_SCHEMA_FLOAT = 0, HAIR_SCHEMA_UINT, HAIR_SCHEMA_BOOL } hair_schema_type;

// One number of a desc. Enums are unsigned here. A truth value is one byte, 0 or 1. The table has
// no pointers, so it is read-only without relocation.
struct hair_field {
    char name[48]; // "hair_physics.damping"
    uint32_t offset;
    hair_schema_type type;
    double value, min, max; // `value` is the default.
};

// Return the number of bytes of a field.
static inline uint32_t hair_schema_size(hair_schema_type type)
{
    return type == HAIR_SCHEMA_BOOL ? 1 : 4;
}

struct hair_schema {
    const struct hair_field* field;
    uint32_t count;
    uint32_t size; // sizeof the struct in this library
};

// Fill in the part of the struct that the caller knows with zeros, `header` and the defaults. An
// older caller may know a shorter struct.
void hair_schema_init(void* desc, hair_struct_header header, struct hair_schema fields);

// Return HAIR_ERROR_VERSION unless a default function of this major version, from 0.2 on, has
// filled in `header`.
hair_result hair_check_header(const hair_host* host, const char* name, hair_struct_header header);

// Copy a caller's desc into `own`. Fields that the caller's desc is too short for get their
// defaults. Return HAIR_ERROR_VERSION unless a default function of this major version has filled in
// `header`. Return HAIR_ERROR_ARGUMENT if a number is outside its range. `name` is the name of the
// struct.
hair_result hair_schema_copy_in(const hair_host* host, const char* name, const void* desc, void* own,
                                struct hair_schema fields);

#endif
