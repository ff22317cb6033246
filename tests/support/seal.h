// seal.h - valid checksums for changed .groom files.
#ifndef HAIR_TESTS_SUPPORT_SEAL_H
#define HAIR_TESTS_SUPPORT_SEAL_H

#include <stddef.h>

// Replace the checksums of a .groom file by those of its bytes, as far as chunks are whole.
void hair_test_seal(unsigned char* bytes, size_t size);

#endif
