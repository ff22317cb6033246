// kinds.h - all structs that hair_describe() describes, for tests.
#ifndef HAIR_TESTS_SUPPORT_KINDS_H
#define HAIR_TESTS_SUPPORT_KINDS_H

#include <hair/hair_members.h>

#define HAIR_TEST_MEMBERS 64 // maximum of a struct
#define HAIR_TEST_STRUCT 1024 // maximum size of a struct, bytes

struct hair_test_kind {
    const char* name;
    size_t size; // bytes
    void (*init)(void*); // writes the defaults
    size_t header; // bytes before the first member
};

// Structs in the order of hair_struct.
extern const struct hair_test_kind hair_test_kinds[HAIR_STRUCT_COUNT];

// Describe a struct. Fail if it has no members, or too many.
uint32_t hair_test_describe(hair_struct kind, hair_member out[HAIR_TEST_MEMBERS]);

// Return whether text can hold a member.
bool hair_test_is_text(const hair_member* member);

// Write random values of the range: the ends, and magnitudes of any size.
void hair_test_vary(void* desc, const hair_member* member, uint32_t* seed);

#endif
