// crc.c - the checksum CRC-32, 8 bytes at a time (Kounavis and Berry 2005).
#include "lib/base/crc.h"
#include "lib/base/bytes.h"

#define POLYNOMIAL 0xedb88320u

void hair_crc_init(struct hair_crc_table* table)
{
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? POLYNOMIAL : 0);
        table->at[0][i] = crc;
    }
    for (int k = 1; k < 8; ++k)
        for (int i = 0; i < 256; ++i) {
            uint32_t crc = table->at[k - 1][i];
            table->at[k][i] = crc >> 8 ^ table->at[0][crc & 255];
        }
}

uint32_t hair_crc_add(const struct hair_crc_table* table, uint32_t crc, const void* bytes, size_t size)
{
    const unsigned char* at = bytes;
    const uint32_t(*t)[256] = table->at;
    crc = ~crc;
    for (; size >= 8; size -= 8, at += 8) {
        uint32_t low = crc ^ hair_read_u32(at), high = hair_read_u32(at + 4);
        crc = t[7][low & 255] ^ t[6][low >> 8 & 255] ^ t[5][low >> 16 & 255] ^ t[4][low >> 24] ^
              t[3][high & 255] ^ t[2][high >> 8 & 255] ^ t[1][high >> 16 & 255] ^ t[0][high >> 24];
    }
    for (; size; --size, ++at) crc = crc >> 8 ^ t[0][(crc ^ *at) & 255];
    return ~crc;
}
