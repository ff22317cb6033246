// host.c - a host that counts memory, refuses memory on demand, and remembers the log.
#include "tests/support/host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <malloc.h>
#define ALIGNED_ALLOC(align, size) _aligned_malloc(size, align)
#define ALIGNED_FREE _aligned_free
#else
#define ALIGNED_ALLOC(align, size) aligned_alloc(align, (size + align - 1) / align * align)
#define ALIGNED_FREE free
#endif

static void* take(size_t size, size_t align, void* user)
{
    struct hair_test_host* host = user;
    ++host->allocations;
    if (host->allocations == host->refuse) return NULL;
    if (host->refuse && host->is_lasting && host->allocations > host->refuse) return NULL;
    void* memory = ALIGNED_ALLOC(align, size);
    if (!memory) return NULL;
    memset(memory, 0xa5, size);
    host->live += size;
    if (host->live > host->peak) host->peak = host->live;
    ++host->blocks;
    return memory;
}

static void give_back(void* memory, size_t size, void* user)
{
    struct hair_test_host* host = user;
    host->live -= size;
    --host->blocks;
    ALIGNED_FREE(memory);
}

static void listen(hair_log_level level, const char* sentence, void* user)
{
    struct hair_test_host* host = user;
    host->errors += level == HAIR_LOG_ERROR;
    host->warnings += level == HAIR_LOG_WARNING;
    if (level == HAIR_LOG_ERROR) snprintf(host->sentence, sizeof host->sentence, "%s", sentence);
}

void hair_test_host_init(struct hair_test_host* host)
{
    memset(host, 0, sizeof *host);
    host->host = (hair_host){take, give_back, listen, host};
}

int hair_test_host_setup(void** state)
{
    hair_test_host_init(*state);
    return 0;
}

int hair_test_host_teardown(void** state)
{
    return ((const struct hair_test_host*)*state)->blocks ? -1 : 0;
}
