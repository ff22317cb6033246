// members.h - members of public structs by name, and their text.
#ifndef HAIR_API_MEMBERS_H
#define HAIR_API_MEMBERS_H

#include "lib/base/schema.h"

#define HAIR_MAX_STRUCT 4096 // bytes
#define HAIR_MAX_ELEMENTS 16 // of a member

// A member of a struct, or one element of a member.
struct hair_member_place {
    const char* owner; // name of the struct
    const hair_member* member;
    uint32_t first, count; // elements
};

// Text with a length. It need not end with a 0.
struct hair_span {
    const char* text;
    size_t length;
};

// Receiver of text. Text beyond the capacity is counted only.
struct hair_text_out {
    char* text;
    size_t capacity, length;
};

// Return the table of a struct. The name of the table is NULL beyond the last struct.
struct hair_schema hair_schema_of_kind(hair_struct kind);

// Check that a struct of the caller has the kind and the size.
hair_result hair_check_struct(const hair_host* host, hair_struct kind, const void* desc, size_t size);

// Find a member by its name, or an element by the name of the member and its own. Fail for members
// beyond the size of the caller's struct, and for members that text cannot hold.
hair_result hair_find_member(const hair_host* host, struct hair_schema schema, size_t size,
                             struct hair_span name, struct hair_member_place* out);

// Return whether text can hold a member.
static inline bool hair_member_is_text(const hair_member* member)
{
    return member->type != HAIR_MEMBER_POINTER && member->type != HAIR_MEMBER_TEXTURE;
}

// Write printable ASCII of a text of the caller, at most 63 characters, for a sentence of the log.
const char* hair_quote(struct hair_span span, char out[64]);

// Set elements of `desc` from text, and check their range. `desc` is changed also on failure.
hair_result hair_parse_member(const hair_host* host, const struct hair_member_place* place,
                              struct hair_span text, void* desc);

// Write elements as text, with a separator between them. Choices are in quotes if `is_json`.
void hair_print_member(const struct hair_member_place* place, const void* desc, const char* separator,
                       bool is_json, struct hair_text_out* out);

void hair_text_put(struct hair_text_out* out, const char* text);

// End the text with a 0. Fail if the capacity is too small.
hair_result hair_text_end(const hair_host* host, struct hair_text_out* out, size_t* length);

#endif
