// host.h - what the program lends the library: memory, and an ear for one sentence at a time.
#ifndef HAIR_BASE_HOST_H
#define HAIR_BASE_HOST_H

#include <hair/hair.h>

#if defined(__GNUC__)
#define HAIR_PRINTF(string, first) __attribute__((format(printf, string, first)))
#else
#define HAIR_PRINTF(string, first)
#endif

// A whole host to keep: the C library's allocator where the program gave none. NULL: all defaults.
hair_host hair_host_take(const hair_host* host);

// Memory of `count` elements of `size` bytes, aligned to 16, all zero. NULL when the product overflows or the
// host refuses; a count of 0 gives memory too. The block knows its size, so that free needs none.
void* hair_alloc(const hair_host* host, size_t count, size_t size);
void hair_free(const hair_host* host, void* memory);

// One sentence to the host's log, at most 511 bytes.
void hair_log(const hair_host* host, hair_log_level level, const char* format, ...) HAIR_PRINTF(3, 4);

// The sentence as an error, and `result` back: `return hair_fail(host, HAIR_ERROR_FILE, "…", …);`
hair_result hair_fail(const hair_host* host, hair_result result, const char* format, ...) HAIR_PRINTF(3, 4);

// For HAIR_ERROR_MEMORY: "out of memory for WHAT".
hair_result hair_fail_memory(const hair_host* host, const char* what);

#endif
