// host.h - the application's callbacks: memory, and a log that receives one sentence at a time.
#ifndef HAIR_BASE_HOST_H
#define HAIR_BASE_HOST_H

#include <hair/hair.h>
#include "lib/base/assert.h"

#if defined(__MINGW32__)
#define HAIR_PRINTF(string, first) __attribute__((format(gnu_printf, string, first)))
#elif defined(__GNUC__)
#define HAIR_PRINTF(string, first) __attribute__((format(printf, string, first)))
#else
#define HAIR_PRINTF(string, first)
#endif

// Return a complete host to keep, with the C library's allocator if `host` has none. NULL selects
// all defaults.
hair_host hair_host_or_default(const hair_host* host);

// Return the result of a call from the enclosing function unless the result is HAIR_OK.
#define HAIR_TRY(call)                                                                                       \
    do {                                                                                                     \
        hair_result hair_tried = (call);                                                                     \
        if (hair_tried) return hair_tried;                                                                   \
    } while (0)

// Allocate `count` elements of `size` bytes, aligned to 16 and zeroed. Return NULL if the product
// overflows or the application refuses. A count of 0 returns memory too. The block stores its size,
// so hair_free() needs none.
void* hair_alloc(const hair_host* host, size_t count, size_t size);
// Allocate likewise without zeros, for memory that is written as a whole. Threads that write such
// memory also touch its pages for the first time.
void* hair_alloc_undefined(const hair_host* host, size_t count, size_t size);
void hair_free(const hair_host* host, void* memory);

// Call task(index, data) for every index below `count`, on the application's threads if it has lent
// any.
void hair_run_tasks(const hair_tasks* tasks, hair_task task, void* data, uint32_t count);

// Send one sentence of at most 511 bytes to the application's log.
void hair_log(const hair_host* host, hair_log_level level, const char* format, ...) HAIR_PRINTF(3, 4);

// Log the sentence as an error and return `result`. A typical call is
//     return hair_fail(host, HAIR_ERROR_FILE, "...", ...);
hair_result hair_fail(const hair_host* host, hair_result result, const char* format, ...) HAIR_PRINTF(3, 4);

// Log "out of memory for WHAT" and return HAIR_ERROR_MEMORY.
static inline hair_result hair_fail_memory(const hair_host* host, const char* what)
{
    hair_fail(host, HAIR_ERROR_MEMORY, "out of memory for %s", what);
    return HAIR_ERROR_MEMORY; // A constant shows compilers and analyzers that this is not HAIR_OK.
}

#endif
