// seal.c - valid checksums for changed .groom files.
#include "tests/support/seal.h"
#include "lib/base/bytes.h"
#include "lib/base/crc.h"

void hair_test_seal(unsigned char* bytes, size_t size)
{
    if (size < 32) return;
    hair_write_u32(bytes + 24, hair_crc_add(0, bytes, 24));
    for (size_t at = 32; at + 16 <= size;) {
        uint64_t content = hair_read_u64(bytes + at + 4);
        if (content > size - at - 16) return;
        uint32_t sum = hair_crc_add(0, bytes + at, 12);
        hair_write_u32(bytes + at + 12, hair_crc_add(sum, bytes + at + 16, (size_t)content));
        at += 16 + (size_t)content;
    }
}
