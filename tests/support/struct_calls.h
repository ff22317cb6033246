// struct_calls.h - a call for each public struct that has numbers.
#ifndef HAIR_TESTS_SUPPORT_STRUCT_CALLS_H
#define HAIR_TESTS_SUPPORT_STRUCT_CALLS_H

#include "tests/support/scene.h"

// A struct, its name in messages, and a call that takes it.
struct hair_test_struct_call {
    hair_struct kind;
    const char* name;
    hair_result (*use)(struct hair_test_scene*, void*);
    void (*init)(void*); // writes the defaults
    bool has_header;
};

// All structs but hair_asset_desc, which has no numbers.
#define HAIR_TEST_STRUCT_CALLS (HAIR_STRUCT_COUNT - 1)
extern const struct hair_test_struct_call hair_test_struct_calls[HAIR_TEST_STRUCT_CALLS];

#endif
