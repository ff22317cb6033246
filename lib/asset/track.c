// track.c - sequences of points with three whole coordinates, packed into bits.
#include "lib/asset/track.h"

void hair_bits_write(struct hair_bit_writer* writer, uint32_t value, uint32_t width)
{
    HAIR_ASSERT(width == 32 || (width < 32 && value >> width == 0));
    writer->count += width;
    if (!writer->at) return;
    writer->held |= (uint64_t)value << writer->held_count;
    for (writer->held_count += width; writer->held_count >= 8; writer->held_count -= 8) {
        *writer->at++ = (unsigned char)writer->held;
        writer->held >>= 8;
    }
}

void hair_bits_finish(struct hair_bit_writer* writer)
{
    hair_bits_write(writer, 0, (uint32_t)(-writer->count & 7));
}

// Small numbers of both signs become small numbers: 0, -1, 1, -2 become 0, 1, 2, 3.
static uint32_t fold(uint32_t difference)
{
    return difference << 1 ^ (difference >> 31 ? UINT32_MAX : 0);
}

static uint32_t unfold(uint32_t number)
{
    return number >> 1 ^ (number & 1 ? UINT32_MAX : 0);
}

// Return number i, from 1 on, of an axis. Arithmetic wraps.
static uint32_t number_of(const int32_t* axis, uint32_t i)
{
    uint32_t now = (uint32_t)axis[3 * (size_t)i], before = (uint32_t)axis[3 * (size_t)i - 3];
    if (i == 1) return fold(now - before);
    return fold(now - 2 * before + (uint32_t)axis[3 * (size_t)i - 6]);
}

static uint32_t count_bits(uint32_t bits)
{
    uint32_t width = 0;
    for (; bits; bits >>= 1) ++width;
    HAIR_ASSERT(width <= 31);
    return width;
}

uint32_t hair_track_find_widths(const int32_t* points, uint32_t count)
{
    uint32_t widths = 0;
    for (uint32_t k = 0; k < 3 && count > 1; ++k) {
        uint32_t bits = 0;
        for (uint32_t i = 2; i < count; ++i) bits |= number_of(points + k, i);
        widths |= (count_bits(number_of(points + k, 1)) | count_bits(bits) << 5) << 10 * k;
    }
    return widths;
}

static uint32_t width_of(uint32_t widths, uint32_t axis, uint32_t i)
{
    return widths >> (10 * axis + (i > 1 ? 5 : 0)) & 31;
}

uint64_t hair_track_count_bits(uint32_t widths, uint32_t count)
{
    uint64_t bits = 0;
    if (count < 2) return 0;
    for (uint32_t k = 0; k < 3; ++k)
        bits += width_of(widths, k, 1) + (uint64_t)(count - 2) * width_of(widths, k, 2);
    return bits;
}

void hair_track_write(struct hair_bit_writer* writer, uint32_t widths, const int32_t* points, uint32_t count)
{
    for (uint32_t k = 0; k < 3; ++k)
        for (uint32_t i = 1; i < count; ++i)
            hair_bits_write(writer, number_of(points + k, i), width_of(widths, k, i));
}

void hair_track_read(struct hair_bit_reader* reader, uint32_t widths, int32_t* points, uint32_t count)
{
    for (uint32_t k = 0; k < 3; ++k) {
        uint32_t difference = 0, value = (uint32_t)points[k];
        for (uint32_t i = 1; i < count; ++i) {
            difference += unfold(hair_bits_read(reader, width_of(widths, k, i)));
            value += difference;
            points[3 * (size_t)i + k] = (int32_t)value;
        }
    }
}
