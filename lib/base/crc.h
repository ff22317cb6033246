// crc.h - the checksum CRC-32 with the polynomial of zlib, 8 bytes at a time.
#ifndef HAIR_BASE_CRC_H
#define HAIR_BASE_CRC_H

#include <stddef.h>
#include <stdint.h>

// Continue the checksum `crc` with `bytes`. Return the new checksum. A checksum begins with 0.
uint32_t hair_crc_add(uint32_t crc, const void* bytes, size_t size);

#endif
