// track.h - sequences of points with three whole coordinates, packed into bits.
//
// The first point of a track is known. Each axis stores the difference of the second point from the
// first, and then the difference of each difference from the one before. Smooth curves give small
// numbers. An axis has one width in bits for its first number and one for its other numbers.
#ifndef HAIR_ASSET_TRACK_H
#define HAIR_ASSET_TRACK_H

#include "lib/base/assert.h"

#include <stddef.h>
#include <stdint.h>

#define HAIR_TRACK_WIDTHS 0x3fffffffu // Bits of the six widths, with 5 bits each.

// Bits of a file, from the lowest of each byte on. Writing to NULL only counts.
struct hair_bit_writer {
    unsigned char* at;
    uint64_t held; // bits that do not fill a byte yet
    uint32_t held_count;
    uint64_t count; // of all bits
};
struct hair_bit_reader {
    const unsigned char *at, *end;
    uint64_t held;
    uint32_t held_count;
};

// Write the lowest `width` bits of a number. Requires a width of at most 32.
void hair_bits_write(struct hair_bit_writer* writer, uint32_t value, uint32_t width);
// Fill the last byte with bits of 0.
void hair_bits_finish(struct hair_bit_writer* writer);
// Read a number of `width` bits, at most 32. Bits beyond the end are 0.
static inline uint32_t hair_bits_read(struct hair_bit_reader* reader, uint32_t width)
{
    HAIR_ASSERT(width <= 32);
    while (reader->held_count < width) {
        uint64_t byte = reader->at < reader->end ? *reader->at++ : 0;
        reader->held |= byte << reader->held_count;
        reader->held_count += 8;
    }
    uint32_t value = (uint32_t)(reader->held & ((1ull << width) - 1));
    reader->held >>= width;
    reader->held_count -= width;
    return value;
}

// Find the six widths of a track, packed into one number. Differences must have at most 30 bits.
uint32_t hair_track_find_widths(const int32_t* points, uint32_t count);
// Return the number of bits of a track after its first point.
uint64_t hair_track_count_bits(uint32_t widths, uint32_t count);
void hair_track_write(struct hair_bit_writer* writer, uint32_t widths, const int32_t* points, uint32_t count);
// Read all points but the first, which the caller has set. Malformed bits may give any coordinates.
void hair_track_read(struct hair_bit_reader* reader, uint32_t widths, int32_t* points, uint32_t count);

#endif
