// bytes.h - little-endian numbers of files and saved states, at any address.
#ifndef HAIR_BASE_BYTES_H
#define HAIR_BASE_BYTES_H

#include <stdint.h>
#include <string.h>

#include "lib/base/assert.h"

// Initial value of the FNV-1a hash.
#define HAIR_HASH_BEGIN 0xcbf29ce484222325u
// Continue the FNV-1a hash `hash` with `bytes`. Return the new hash.
static inline uint64_t hair_hash_bytes(uint64_t hash, const void* bytes, size_t size)
{
    const unsigned char* at = (const unsigned char*)bytes;
    for (size_t i = 0; i < size; ++i) hash = (hash ^ at[i]) * 0x100000001b3u;
    return hash;
}

// Continue the hash with `count` words of 32 bits, as the machine stores them, one word at a time.
static inline uint64_t hair_hash_words(uint64_t hash, const void* words, size_t count)
{
    const unsigned char* at = (const unsigned char*)words;
    for (size_t i = 0; i < count; ++i) {
        uint32_t word;
        memcpy(&word, at + 4 * i, sizeof word);
        hash = (hash ^ word) * 0x100000001b3u;
    }
    return hash;
}

static inline uint32_t hair_read_u16(const unsigned char* at)
{
    return at[0] | (uint32_t)at[1] << 8;
}
static inline uint32_t hair_read_u32(const unsigned char* at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static inline uint64_t hair_read_u64(const unsigned char* at)
{
    return hair_read_u32(at) | (uint64_t)hair_read_u32(at + 4) << 32;
}

static inline float hair_read_float(const unsigned char* at)
{
    uint32_t bits = hair_read_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline double hair_read_double(const unsigned char* at)
{
    uint64_t bits = hair_read_u64(at);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// The hair_write functions write a number at `at` and return the address after it.
static inline unsigned char* hair_write_u16(unsigned char* at, uint32_t value)
{
    HAIR_ASSERT(value <= 0xffff);
    for (int i = 0; i < 2; ++i) at[i] = (unsigned char)(value >> 8 * i);
    return at + 2;
}

static inline unsigned char* hair_write_u32(unsigned char* at, uint32_t value)
{
    for (int i = 0; i < 4; ++i) at[i] = (unsigned char)(value >> 8 * i);
    return at + 4;
}

static inline unsigned char* hair_write_u64(unsigned char* at, uint64_t value)
{
    return hair_write_u32(hair_write_u32(at, (uint32_t)value), (uint32_t)(value >> 32));
}

static inline unsigned char* hair_write_float(unsigned char* at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return hair_write_u32(at, bits);
}

static inline unsigned char* hair_write_double(unsigned char* at, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return hair_write_u64(at, bits);
}

#endif
