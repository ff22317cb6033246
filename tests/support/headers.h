// headers.h - the members and enumerators of the public headers, read from their text.
#ifndef HAIR_TESTS_SUPPORT_HEADERS_H
#define HAIR_TESTS_SUPPORT_HEADERS_H

#include <stdbool.h>
#include <stddef.h>

// A member of a struct, as declared in its header. The name has that of its group: "curl.radius".
struct hair_test_member {
    char owner[40], type[40], name[80];
    bool is_pointer;
    unsigned count; // elements
    char comment[256]; // behind the member
    char above[512]; // above the member
};

#define HAIR_TEST_ENUMERATORS 16

// Read all headers. This is a setup of a group of tests.
int hair_test_read_headers(void** state);

// Return a member, or NULL beyond the last.
const struct hair_test_member* hair_test_member_at(size_t i);

// Return the member of a struct, or NULL. Members of a hair_map belong to the struct around it.
const struct hair_test_member* hair_test_find_member(const char* owner, const char* name);

// Copy the enumerators of a type, without the one that counts them. Return their number, or 0 if
// the type is no enum.
int hair_test_enumerators(const char* type, char out[HAIR_TEST_ENUMERATORS][64]);

// Return the value of an enumerator, which is its position in its enum, or of HAIR_AUTO. Return -1
// if there is none of this name.
double hair_test_enumerator(const char* name, size_t length);

// Copy the comment above an enum.
void hair_test_enum_comment(const char* type, char out[512]);

#endif
