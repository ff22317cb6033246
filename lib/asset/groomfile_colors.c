// groomfile_colors.c - colours of strands in .groom files, as square roots in 16 bits.
#include "lib/asset/groomfile.h"
#include "lib/asset/track.h"

#include <math.h>

#define ONE 65535
#define FIXED 6 // bytes of a strand before its widths

static void pack_colors(const float* colors, int32_t* points)
{
    for (int i = 0; i < 3 * HAIR_STRAND_COLORS; ++i)
        points[i] = (int32_t)floor(sqrt((double)colors[i]) * ONE + 0.5);
}

uint64_t hair_write_groom_colors(const struct hair_strands* strands, unsigned char* at)
{
    size_t count = strands->strand_count, fixed = (FIXED + 4) * count;
    struct hair_bit_writer writer = {.at = at ? at + fixed : NULL};
    int32_t points[3 * HAIR_STRAND_COLORS];
    for (size_t i = 0; i < count; ++i) {
        pack_colors(strands->colors + 3 * HAIR_STRAND_COLORS * i, points);
        uint32_t widths = hair_track_find_widths(points, HAIR_STRAND_COLORS);
        hair_track_write(&writer, widths, points, HAIR_STRAND_COLORS);
        if (!at) continue;
        for (size_t k = 0; k < 3; ++k) hair_write_u16(at + FIXED * i + 2 * k, (uint32_t)points[k]);
        hair_write_u32(at + FIXED * count + 4 * i, widths);
    }
    hair_bits_finish(&writer);
    return fixed + writer.count / 8;
}

hair_result hair_read_groom_colors(const struct hair_groom_chunk* chunk, struct hair_strands* strands)
{
    size_t count = strands->strand_count;
    HAIR_TRY(hair_check_tracks(chunk, strands->strand_count, NULL, FIXED));
    strands->colors = hair_alloc(chunk->source->host, count, 3 * HAIR_STRAND_COLORS * sizeof(float));
    if (!strands->colors) return hair_fail_memory(chunk->source->host, "the colours of a file");
    const unsigned char *roots = chunk->content, *widths = roots + FIXED * count;
    struct hair_bit_reader reader = {.at = widths + 4 * count, .end = roots + chunk->size};
    for (size_t i = 0; i < count; ++i) {
        int32_t points[3 * HAIR_STRAND_COLORS];
        for (size_t k = 0; k < 3; ++k) points[k] = (int32_t)hair_read_u16(roots + FIXED * i + 2 * k);
        hair_track_read(&reader, hair_read_u32(widths + 4 * i), points, HAIR_STRAND_COLORS);
        for (size_t k = 0; k < 3 * HAIR_STRAND_COLORS; ++k) {
            if (points[k] < 0 || points[k] > ONE)
                return HAIR_FAIL_CHUNK(chunk, "has a colour %d of strand %zu, not in [0, %d]", points[k], i,
                                       ONE);
            double root = points[k] / (double)ONE;
            strands->colors[3 * HAIR_STRAND_COLORS * i + k] = (float)(root * root);
        }
    }
    return HAIR_OK;
}
