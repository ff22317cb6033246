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
// Return an array of twice as many elements of `size` bytes as `*room`, but at least `min`. It has
// the elements of `array`, which is freed. Return NULL, and change nothing, if memory is missing.
void* hair_grow(const hair_host* host, void* array, size_t size, uint32_t* room, uint32_t min);

#define HAIR_MAX_TASKS 256
// Elements that are divided among tasks. The division depends on their number only.
struct hair_division {
    uint32_t count; // Number of elements.
    uint32_t each; // Number of elements of each task but the last.
    uint32_t tasks; // At most HAIR_MAX_TASKS.
};

// Divide elements among tasks of at least `min` elements. 0 elements have no task.
static inline struct hair_division hair_divide(uint32_t count, uint32_t min)
{
    uint32_t each = (uint32_t)(((uint64_t)count + HAIR_MAX_TASKS - 1) / HAIR_MAX_TASKS);
    HAIR_ASSERT(min > 0);
    if (each < min) each = min;
    return (struct hair_division){
        .count = count, .each = each, .tasks = (uint32_t)(((uint64_t)count + each - 1) / each)};
}

// Return the end of the elements of a task, the first of which is index * each.
static inline uint32_t hair_division_end(const struct hair_division* division, uint32_t index)
{
    uint32_t first = index * division->each, left = division->count - first;
    return first + (left < division->each ? left : division->each);
}

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
