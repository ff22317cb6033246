// host.h - a host that counts and refuses memory on demand, and remembers what was logged.
#ifndef HAIR_TESTS_SUPPORT_HOST_H
#define HAIR_TESTS_SUPPORT_HOST_H

#include <hair/hair.h>

struct hair_test_host {
    hair_host host;
    size_t live, peak; // bytes
    uint32_t blocks; // not yet freed
    uint32_t allocations;
    uint32_t refuse; // the allocation that fails, from 1; 0: none
    uint32_t errors, warnings;
    char sentence[512]; // the last error
};

// Must stay where it is while in use.
void hair_test_host_init(struct hair_test_host* host);

#endif
