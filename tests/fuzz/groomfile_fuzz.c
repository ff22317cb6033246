// groomfile_fuzz.c - fuzz target of .groom files, also with valid checksums, because few changed
// files pass them.
#include "tests/fuzz/fuzz_asset.h"
#include "tests/support/seal.h"

#include <string.h>

HAIR_FUZZ(groomfile)
{
    unsigned char* sealed = hair_fuzz_alloc(size ? size : 1);
    HAIR_FUZZ_CHECK(sealed);
    if (size) memcpy(sealed, bytes, size);
    hair_test_seal(sealed, size);
    bool is_changed = size && memcmp(sealed, bytes, size) != 0;
    bool is_accepted = hair_fuzz_asset(bytes, size, hash);
    if (is_changed) is_accepted |= hair_fuzz_asset(sealed, size, hash);
    free(sealed);
    return is_accepted;
}
