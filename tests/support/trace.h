// trace.h - which OpenGL functions the library calls: a get_proc whose functions are counted before they are called.
#ifndef HAIR_TESTS_SUPPORT_TRACE_H
#define HAIR_TESTS_SUPPORT_TRACE_H

#include <stdint.h>

// For hair_context_desc.get_proc. One count for all contexts made with it.
void* hair_test_trace_proc(const char* name, void* user);

void hair_test_trace_clear(void);

// Calls since then: of all functions whose names begin so, "" being all of them.
uint32_t hair_test_trace_count(const char* begin);

// Whether the GPU is behind from now on, by what it answers who asks without waiting: no fence has been passed yet.
void hair_test_trace_hold(int behind);

// Of those, calls that may wait for the GPU: that read what it writes, or wait for it to come to somewhere.
uint32_t hair_test_trace_waits(void);

// The names of those called since, each with its count, for messages.
const char* hair_test_trace_list(void);

#endif
