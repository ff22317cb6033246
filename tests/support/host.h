// host.h - a host that counts memory, refuses memory on demand, and remembers the log.
#ifndef HAIR_TESTS_SUPPORT_HOST_H
#define HAIR_TESTS_SUPPORT_HOST_H

#include <hair/hair.h>

struct hair_test_host {
    hair_host host;
    size_t live, peak; // bytes
    uint32_t blocks; // number of blocks not yet freed
    uint32_t allocations;
    uint32_t refuse; // number of the allocation that fails, from 1. 0 disables.
    uint32_t errors, warnings;
    char sentence[512]; // last error
};

// Initialise a host. Its address must not change while it is in use.
void hair_test_host_init(struct hair_test_host* host);

#endif
