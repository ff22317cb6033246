// support.h - an OpenGL context and a hair_context for every test program that needs them.
#ifndef HAIR_TESTS_SUPPORT_SUPPORT_H
#define HAIR_TESTS_SUPPORT_SUPPORT_H

// Headers that cmocka.h requires, in one place.
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
    uint32_t blocks; // hair_test_blocks() at the start of a test
};

// Return whether there is no OpenGL and that is no failure. With HAIR_TEST=required, as `make test`
// sets it, the program fails instead, because a skipped test proves nothing.
int hair_test_skips(void);

// Set *state to a struct hair_test with a current context. For cmocka_run_group_tests().
int hair_test_start(void** state);
int hair_test_finish(void** state); // Fails if memory is left.
// Start as hair_test_start(), with a context of the compatibility profile. The environment variable
// HAIR_TEST_PROFILE=compatibility does the same for every context of libhair_egl.
int hair_test_start_compatibility(void** state);
void hair_test_set_compatibility(bool is_wanted);

// A test that must end without memory left, errors in the log that it has not forgiven, or OpenGL
// errors.
#define HAIR_TEST(function) cmocka_unit_test_setup_teardown(function, hair_test_begin, hair_test_end)
int hair_test_begin(void** state);
int hair_test_end(void** state);
// Return the number of blocks that the host has lent, without those that the context keeps for
// passes used so far, and to record commands.
uint32_t hair_test_blocks(const struct hair_test* test);
// Return the memory of the GPU that the context has in use, in bytes.
uint64_t hair_test_gpu_bytes(struct hair_test* test);
// Return the memory of samples of compute rasterisation, which all instances share, in bytes.
uint64_t hair_test_sample_bytes(const hair_context* context);
// Count the OpenGL objects that are not deleted, by trying all names.
uint32_t hair_test_count_objects(void);

// Create a context of a test's own, which times its passes. Destroy it with hair_context_destroy().
hair_context* hair_test_context(struct hair_test* test, void* (*get_proc)(const char* name, void* user));

// Forgive the errors so far. Return their number. The sentence of the last one stays in
// host.sentence.
uint32_t hair_test_forgive(struct hair_test* test);

// Fail the test with the last sentence of the log unless `result` is HAIR_OK.
void hair_test_ok(const struct hair_test* test, hair_result result);

// Check that the call failed with `expected` and logged one sentence that contains `words`. Forgive
// it.
void hair_test_refused(struct hair_test* test, hair_result result, hair_result expected, const char* words);

// Check that a and b differ by at most `tolerance`. NaN differs from everything. `what` and `i`
// appear in the message.
void hair_test_near(const char* what, size_t i, double a, double b, double tolerance);

#endif
