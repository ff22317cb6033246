// crc.c - the checksum CRC-32, 8 bytes at a time (Kounavis and Berry 2005).
#include "lib/base/crc.h"
#include "lib/base/bytes.h"

// Checksum of the byte `i`, which is linear in its bits. The other arguments are those of the bytes
// 1, 2, 4 to 128.
#define SUM(i, a, b, c, d, e, f, g, h)                                                                       \
    (((i)&1 ? (a) : 0) ^ ((i)&2 ? (b) : 0) ^ ((i)&4 ? (c) : 0) ^ ((i)&8 ? (d) : 0) ^ ((i)&16 ? (e) : 0) ^    \
     ((i)&32 ? (f) : 0) ^ ((i)&64 ? (g) : 0) ^ ((i)&128 ? (h) : 0))
#define SUMS_4(i, ...)                                                                                       \
    SUM(i, __VA_ARGS__), SUM((i) + 1, __VA_ARGS__), SUM((i) + 2, __VA_ARGS__), SUM((i) + 3, __VA_ARGS__)
#define SUMS_16(i, ...)                                                                                      \
    SUMS_4(i, __VA_ARGS__), SUMS_4((i) + 4, __VA_ARGS__), SUMS_4((i) + 8, __VA_ARGS__),                      \
        SUMS_4((i) + 12, __VA_ARGS__)
#define SUMS_64(i, ...)                                                                                      \
    SUMS_16(i, __VA_ARGS__), SUMS_16((i) + 16, __VA_ARGS__), SUMS_16((i) + 32, __VA_ARGS__),                 \
        SUMS_16((i) + 48, __VA_ARGS__)
#define SUMS_256(...)                                                                                        \
    SUMS_64(0, __VA_ARGS__), SUMS_64(64, __VA_ARGS__), SUMS_64(128, __VA_ARGS__), SUMS_64(192, __VA_ARGS__)

// Checksums of every byte, followed by 0 to 7 bytes of 0.
static const uint32_t sums[8][256] = {
    {SUMS_256(0x77073096, 0xee0e612c, 0x076dc419, 0x0edb8832, 0x1db71064, 0x3b6e20c8, 0x76dc4190,
              0xedb88320)},
    {SUMS_256(0x191b3141, 0x32366282, 0x646cc504, 0xc8d98a08, 0x4ac21251, 0x958424a2, 0xf0794f05,
              0x3b83984b)},
    {SUMS_256(0x01c26a37, 0x0384d46e, 0x0709a8dc, 0x0e1351b8, 0x1c26a370, 0x384d46e0, 0x709a8dc0,
              0xe1351b80)},
    {SUMS_256(0xb8bc6765, 0xaa09c88b, 0x8f629757, 0xc5b428ef, 0x5019579f, 0xa032af3e, 0x9b14583d,
              0xed59b63b)},
    {SUMS_256(0x3d6029b0, 0x7ac05360, 0xf580a6c0, 0x30704bc1, 0x60e09782, 0xc1c12f04, 0x58f35849,
              0xb1e6b092)},
    {SUMS_256(0xcb5cd3a5, 0x4dc8a10b, 0x9b914216, 0xec53826d, 0x03d6029b, 0x07ac0536, 0x0f580a6c,
              0x1eb014d8)},
    {SUMS_256(0xa6770bb4, 0x979f1129, 0xf44f2413, 0x33ef4e67, 0x67de9cce, 0xcfbd399c, 0x440b7579,
              0x8816eaf2)},
    {SUMS_256(0xccaa009e, 0x4225077d, 0x844a0efa, 0xd3e51bb5, 0x7cbb312b, 0xf9766256, 0x299dc2ed,
              0x533b85da)},
};

uint32_t hair_crc_add(uint32_t crc, const void* bytes, size_t size)
{
    const unsigned char* at = bytes;
    const uint32_t(*t)[256] = sums;
    crc = ~crc;
    for (; size >= 8; size -= 8, at += 8) {
        uint32_t low = crc ^ hair_read_u32(at), high = hair_read_u32(at + 4);
        crc = t[7][low & 255] ^ t[6][low >> 8 & 255] ^ t[5][low >> 16 & 255] ^ t[4][low >> 24] ^
              t[3][high & 255] ^ t[2][high >> 8 & 255] ^ t[1][high >> 16 & 255] ^ t[0][high >> 24];
    }
    for (; size; --size, ++at) crc = crc >> 8 ^ t[0][(crc ^ *at) & 255];
    return ~crc;
}
