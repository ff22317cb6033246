// support.h - an OpenGL context and a hair_context for every test program that needs them.
#ifndef HAIR_TESTS_SUPPORT_SUPPORT_H
#define HAIR_TESTS_SUPPORT_SUPPORT_H

// What cmocka.h wants before it, in one place.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <epoxy/gl.h>
#include <hair/hair_egl.h>

#include "tests/support/host.h"

struct hair_test {
    struct hair_test_host host;
    hair_egl* egl;
    hair_context* context;
    uint32_t blocks; // hair_test_blocks when a test begins
};

// Whether there is no OpenGL and that is no failure. With HAIR_TEST=required, as `make test` sets it, the
// program ends with a failure instead: a test that is skipped says nothing.
int hair_test_skips(void);

// For cmocka_run_group_tests: *state becomes a struct hair_test with a current context.
int hair_test_start(void** state);
int hair_test_finish(void** state); // fails when memory is left

// A test that ends with no memory left, no error in the log that it did not forgive, and no OpenGL error.
#define HAIR_TEST(function) cmocka_unit_test_setup_teardown(function, hair_test_begin, hair_test_end)
int hair_test_begin(void** state);
int hair_test_end(void** state);
// That the host has lent, but for what the context keeps: passes that have been needed.
uint32_t hair_test_blocks(const struct hair_test* test);

// The errors so far were meant. Returns how many there were; the last one's sentence stays in host.sentence.
uint32_t hair_test_forgive(struct hair_test* test);

// `result` is HAIR_OK, or the test fails with the last sentence of the log.
void hair_test_ok(const struct hair_test* test, hair_result result);

// The call failed with `expected` and logged one sentence, which holds `words`. Forgives it.
void hair_test_refused(struct hair_test* test, hair_result result, hair_result expected, const char* words);

// a and b differ by no more than `tolerance`; NaN differs from everything. `what` and `i` are for the
// message.
void hair_test_near(const char* what, size_t i, double a, double b, double tolerance);

#endif
