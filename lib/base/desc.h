// desc.h - descs that can grow: their size and version, and the table that defines and checks their fields.
#ifndef HAIR_BASE_DESC_H
#define HAIR_BASE_DESC_H

#include "lib/base/host.h"

typedef enum hair_field_type { HAIR_FIELD_FLOAT = 0, HAIR_FIELD_UINT } hair_field_type;

// One number of a desc. Enums are unsigned here. No pointers, so that tables are read-only without relocation.
struct hair_field {
    char name[40]; // "hair_physics.damping"
    uint32_t offset;
    hair_field_type type;
    double value, min, max; // value: the default
};

struct hair_fields {
    const struct hair_field* field;
    uint32_t count;
    uint32_t size; // sizeof the struct, as this library knows it
};

// Fill what the caller knows of the struct, all of it or a shorter older one: zeros, `made`, the defaults.
void hair_fields_init(void* desc, hair_made made, struct hair_fields fields);

// HAIR_ERROR_VERSION unless a default function of this major version filled it in.
hair_result hair_made_check(const hair_host* host, const char* name, hair_made made);

// Take a caller's desc into `own`: what the caller's is too short to hold gets its default. Fails with
// HAIR_ERROR_VERSION when `made` was not filled in by a default function of this major version, with
// HAIR_ERROR_ARGUMENT when a number is outside its range. `name` is the struct's.
hair_result hair_fields_take(const hair_host* host, const char* name, const void* desc, void* own,
                             struct hair_fields fields);

#endif
