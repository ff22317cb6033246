// trace.h - the OpenGL functions that the library calls: a get_proc whose functions are counted
// before each call.
#ifndef HAIR_TESTS_SUPPORT_TRACE_H
#define HAIR_TESTS_SUPPORT_TRACE_H

#include <stdint.h>

// Return a counted function, for hair_context_desc.get_proc. All contexts made with it share the
// counts.
void* hair_test_trace_proc(const char* name, void* user);

void hair_test_trace_clear(void);

// Return the calls since the last clear of all functions whose names begin with `begin`. "" counts
// all.
uint32_t hair_test_trace_count(const char* begin);

// Make the GPU appear to be behind from now on, to queries that do not wait. No fence has then been
// passed.
void hair_test_trace_hold(int behind);

// Let the OpenGL context be lost from the `call`-th call since the last clear on, from 1. Calls
// then do nothing, and glGetGraphicsResetStatus returns `status`. 0 loses none.
void hair_test_trace_lose(uint32_t call, uint32_t status);

// Return the calls since the last clear that may wait for the GPU, because they read its results or
// wait for its progress.
uint32_t hair_test_trace_waits(void);

// Return the names of the functions called since the last clear, with counts, for messages.
const char* hair_test_trace_list(void);

#endif
