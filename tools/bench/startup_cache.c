// startup_cache.c - Cache of program binaries in memory.
#include "tools/bench/startup_cache.h"

#include <stdlib.h>
#include <string.h>

struct startup_cache_entry {
    uint64_t key;
    size_t size;
    void* bytes;
};

static size_t find(uint64_t key, void* bytes, size_t capacity, void* user)
{
    const struct startup_cache* cache = user;
    for (uint32_t i = 0; i < cache->count; ++i) {
        const struct startup_cache_entry* entry = &cache->entries[i];
        if (entry->key != key) continue;
        if (bytes && capacity >= entry->size) memcpy(bytes, entry->bytes, entry->size);
        return entry->size;
    }
    return 0;
}

static void store(uint64_t key, const void* bytes, size_t size, void* user)
{
    struct startup_cache* cache = user;
    if (cache->count == cache->room) {
        uint32_t room = cache->room ? 2 * cache->room : 64;
        struct startup_cache_entry* more = realloc(cache->entries, room * sizeof *more);
        if (!more) return;
        cache->entries = more;
        cache->room = room;
    }
    void* copy = malloc(size);
    if (!copy) return;
    memcpy(copy, bytes, size);
    cache->entries[cache->count++] = (struct startup_cache_entry){key, size, copy};
}

hair_cache startup_cache_of(struct startup_cache* cache)
{
    return (hair_cache){.get = find, .put = store, .user = cache};
}

void startup_cache_free(struct startup_cache* cache)
{
    for (uint32_t i = 0; i < cache->count; ++i) free(cache->entries[i].bytes);
    free(cache->entries);
}
