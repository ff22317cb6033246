// fuzz_asset.h - the properties of every haircut file that is accepted.
#ifndef HAIR_TESTS_FUZZ_FUZZ_ASSET_H
#define HAIR_TESTS_FUZZ_FUZZ_ASSET_H

#include "tests/fuzz/fuzz.h"

// Read a haircut file with two imports. A file is refused with one sentence that names a byte.
// Accepted strands are finite, within the limits, and equal after they are written and read again.
bool hair_fuzz_asset(const uint8_t* bytes, size_t size, uint64_t* hash);

#endif
