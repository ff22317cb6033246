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
    int is_lasting; // 1 if all later allocations fail too
    uint32_t errors, warnings;
    char sentence[512]; // last error
};

// Initialise a host. Its address must not change while it is in use.
void hair_test_host_init(struct hair_test_host* host);

// Initialise the host that *state points to. Setup of a test.
int hair_test_host_setup(void** state);
// Fail if blocks of the host that *state points to are not freed. Teardown of a test.
int hair_test_host_teardown(void** state);
// Make a test of cmocka with a host, which tests of a program may share.
#define HAIR_TEST_WITH_HOST(function, host)                                                                  \
    cmocka_unit_test_prestate_setup_teardown(function, hair_test_host_setup, hair_test_host_teardown, host)

#endif
