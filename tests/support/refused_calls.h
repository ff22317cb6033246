// refused_calls.h - every call that needs the OpenGL context of a hair_context, each of which must
// be refused.
#ifndef HAIR_TESTS_SUPPORT_REFUSED_CALLS_H
#define HAIR_TESTS_SUPPORT_REFUSED_CALLS_H

#include "tests/support/support.h"

// Check that each call on an instance that needs OpenGL fails with `expected` and logs `words`.
void hair_test_refuse_calls(struct hair_test* test, hair_instance* hair, hair_result expected,
                            const char* words);

// Check the same of each call on a context that needs OpenGL.
void hair_test_refuse_context_calls(struct hair_test* test, hair_context* context, const hair_groom* groom,
                                    hair_result expected, const char* words);

#endif
