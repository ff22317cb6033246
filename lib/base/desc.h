// desc.h - public structs that applications fill in: their defaults, copies, and the check of every
// number in them, by a table of their members.
#ifndef HAIR_BASE_DESC_H
#define HAIR_BASE_DESC_H

#include <hair/hair_members.h>

#include "lib/base/host.h"

// Members of a struct, in its order. An array or a curve is one member.
struct hair_schema {
    const char* name; // "hair_physics"
    const hair_member* member;
    uint32_t count;
    uint32_t size; // sizeof the struct in this library
    bool has_header; // Structs without a header are copied by stride.
};

// Fill in the part of the struct that the caller knows with zeros, `header` and the defaults. An
// older caller may know a shorter struct.
void hair_schema_init(void* desc, hair_struct_header header, struct hair_schema schema);

// Fill in a struct without a header. `size` is the size of the caller's struct.
void hair_schema_init_plain(void* desc, size_t size, struct hair_schema schema);

// Return HAIR_ERROR_VERSION unless a default function of this major version, from 0.2 on, has
// filled in `header`.
hair_result hair_check_header(const hair_host* host, const char* name, hair_struct_header header);

// Copy a caller's desc into `own`. Members that the caller's desc is too short for get their
// defaults. Return HAIR_ERROR_VERSION unless a default function of this major version has filled in
// the header. Return HAIR_ERROR_ARGUMENT if a number is outside its range.
hair_result hair_schema_copy_in(const hair_host* host, const void* desc, void* own,
                                struct hair_schema schema);

// Copy `own` to a caller's struct, which may be shorter.
hair_result hair_schema_copy_out(const hair_host* host, const void* own, void* out,
                                 struct hair_schema schema);

// Check one element of an array of structs without a header. Log a number outside its range as
// "NAME[INDEX].member".
hair_result hair_schema_check_element(const hair_host* host, const char* name, uint32_t index,
                                      const void* desc, struct hair_schema schema);

// Check all elements of one member. Log a number outside its range as "NAME.member".
hair_result hair_schema_check_member(const hair_host* host, const char* name, const void* desc,
                                     const hair_member* member);

#endif
