// host.c - memory and log through the application's callbacks.
#include "lib/base/host.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <malloc.h>
#endif

// Bytes before a block, which hold its size and keep its alignment.
#define HEADER 16

static void* default_alloc(size_t size, size_t align, void* user)
{
    (void)user;
    HAIR_ASSERT(align && (align & (align - 1)) == 0);
#ifdef _WIN32
    return _aligned_malloc(size, align);
#else
    return aligned_alloc(align, (size + align - 1) / align * align);
#endif
}

static void default_free(void* memory, size_t size, void* user)
{
    (void)size;
    (void)user;
#ifdef _WIN32
    _aligned_free(memory);
#else
    free(memory);
#endif
}

hair_host hair_host_or_default(const hair_host* host)
{
    hair_host own = {0};
    if (host) own = *host;
    if (!own.alloc || !own.free) {
        own.alloc = default_alloc;
        own.free = default_free;
    }
    return own;
}

void* hair_alloc_undefined(const hair_host* host, size_t count, size_t size)
{
    HAIR_ASSERT(host && host->alloc && host->free);
    if (size && count > (PTRDIFF_MAX - HEADER) / size) return NULL;
    size_t total = count * size + HEADER;
    unsigned char* block = host->alloc(total, HEADER, host->user);
    if (!block) return NULL;
    memset(block, 0, HEADER);
    memcpy(block, &total, sizeof total);
    return block + HEADER;
}

void* hair_alloc(const hair_host* host, size_t count, size_t size)
{
    void* memory = hair_alloc_undefined(host, count, size);
    if (memory) memset(memory, 0, count * size);
    return memory;
}

void hair_free(const hair_host* host, void* memory)
{
    if (!memory) return;
    unsigned char* block = (unsigned char*)memory - HEADER;
    size_t total;
    memcpy(&total, block, sizeof total);
    HAIR_ASSERT(total >= HEADER);
    host->free(block, total, host->user);
}

void* hair_grow(const hair_host* host, void* array, size_t size, uint32_t* room, uint32_t min)
{
    uint32_t more = *room > min / 2 ? 2 * *room : min;
    HAIR_ASSERT(more > *room && (array || !*room));
    void* grown = hair_alloc(host, more, size);
    if (!grown) return NULL;
    if (*room) memcpy(grown, array, *room * size);
    hair_free(host, array);
    *room = more;
    return grown;
}

static void log_sentence(const hair_host* host, hair_log_level level, const char* format, va_list arguments)
{
    HAIR_ASSERT(format);
    if (!host->log) return;
    char sentence[512];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    host->log(level, sentence, host->user);
}

void hair_run_tasks(const hair_tasks* tasks, hair_task task, void* data, uint32_t count)
{
    if (tasks->run && count > 1) {
        tasks->run(task, data, count, tasks->user);
        return;
    }
    for (uint32_t i = 0; i < count; ++i) task(i, data);
}

void hair_log(const hair_host* host, hair_log_level level, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    log_sentence(host, level, format, arguments);
    va_end(arguments);
}

hair_result hair_fail(const hair_host* host, hair_result result, const char* format, ...)
{
    HAIR_ASSERT(result != HAIR_OK);
    va_list arguments;
    va_start(arguments, format);
    log_sentence(host, HAIR_LOG_ERROR, format, arguments);
    va_end(arguments);
    return result;
}
