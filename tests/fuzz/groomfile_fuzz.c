// groomfile_fuzz.c - fuzz target of .groom files, also with valid checksums, because few changed
// files pass them.
#include "lib/base/bytes.h"
#include "tests/fuzz/fuzz_asset.h"
#include "tests/support/seal.h"

#include <string.h>

// Let the header tell the size of the file and the number of its whole chunks.
static void repair_header(unsigned char* bytes, size_t size)
{
    uint32_t chunks = 0;
    if (size < 32) return;
    for (size_t at = 32; size - at >= 16; ++chunks) {
        uint64_t content = hair_read_u64(bytes + at + 4);
        if (content > size - at - 16) break;
        at += 16 + (size_t)content;
    }
    memcpy(bytes, "GROOM\r\n\x1a\1\0\0", 12);
    hair_write_u32(bytes + 12, chunks);
    hair_write_u64(bytes + 16, size);
}

HAIR_FUZZ(groomfile)
{
    unsigned char* sealed = hair_fuzz_alloc(size ? size : 1);
    HAIR_FUZZ_CHECK(sealed);
    if (size) memcpy(sealed, bytes, size);
    // Half of the inputs test the header, too.
    if (hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size) >> 8 & 1) repair_header(sealed, size);
    hair_test_seal(sealed, size);
    bool is_changed = size && memcmp(sealed, bytes, size) != 0;
    bool is_accepted = hair_fuzz_asset(bytes, size, hash);
    if (is_changed) is_accepted |= hair_fuzz_asset(sealed, size, hash);
    free(sealed);
    return is_accepted;
}
