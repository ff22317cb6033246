// startup_cache.h - Cache of program binaries in memory.
#ifndef HAIR_TOOLS_BENCH_STARTUP_CACHE_H
#define HAIR_TOOLS_BENCH_STARTUP_CACHE_H

#include <hair/hair_context.h>

struct startup_cache {
    uint32_t count, room;
    struct startup_cache_entry* entries;
};

// Return the callbacks of a cache. The cache must live as long as the context.
hair_cache startup_cache_of(struct startup_cache* cache);
void startup_cache_free(struct startup_cache* cache);

#endif
