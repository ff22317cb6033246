// formats.c - functions shared by the readers and writers of the formats.
#include "lib/asset/formats.h"

bool hair_counts_are_allowed(uint64_t strands, uint64_t vertices)
{
    return strands <= HAIR_FILE_MAX_STRANDS && vertices <= HAIR_FILE_MAX_VERTICES;
}

hair_result hair_check_counts(const struct hair_source* source, uint64_t strands, uint64_t vertices)
{
    if (hair_counts_are_allowed(strands, vertices)) return HAIR_OK;
    return hair_fail(source->host, HAIR_ERROR_FILE,
                     "the counts at byte 4 make %llu strands and %llu vertices, more than %u and %u",
                     (unsigned long long)strands, (unsigned long long)vertices, HAIR_FILE_MAX_STRANDS,
                     HAIR_FILE_MAX_VERTICES);
}

hair_result hair_check_section(const struct hair_source* source, const char* what, uint64_t offset,
                               uint64_t count, uint32_t size)
{
    HAIR_ASSERT(size > 0);
    if (offset <= source->size && count <= (source->size - offset) / size) return HAIR_OK;
    return hair_fail(source->host, HAIR_ERROR_FILE,
                     "the file ends at byte %zu, within the %s at byte %llu, which need %llu times %u bytes",
                     source->size, what, (unsigned long long)offset, (unsigned long long)count, size);
}

hair_result hair_strands_allocate(const hair_host* host, struct hair_strands* strands, uint32_t strand_count,
                                  uint32_t vertex_count)
{
    HAIR_ASSERT(!strands->positions && !strands->vertices);
    HAIR_ASSERT(strand_count > 0 && vertex_count > 0);
    strands->positions = hair_alloc(host, vertex_count, 3 * sizeof *strands->positions);
    strands->vertices = hair_alloc(host, strand_count, sizeof *strands->vertices);
    strands->strand_count = strand_count;
    strands->vertex_count = vertex_count;
    if (strands->positions && strands->vertices) return HAIR_OK;
    return hair_fail_memory(host, "the strands of a file");
}

static bool read_colors_of(const unsigned char* at, size_t size, uint32_t vertices, float* colors)
{
    bool fit = true;
    for (uint32_t i = 0; i < vertices; ++i)
        for (size_t c = 0; c < 3; ++c) {
            float value = hair_read_float(at + size * i + 4 * c);
            fit = fit && value >= 0 && value <= 1;
            colors[3 * (size_t)i + c] = hair_from_srgb(value);
        }
    return fit;
}

hair_result hair_read_colors(const struct hair_source* source, size_t at, size_t size,
                             struct hair_strands* strands)
{
    HAIR_ASSERT(size >= 12 && !strands->colors);
    HAIR_ASSERT(at + size * strands->vertex_count <= source->size);
    uint32_t max = 0;
    size_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        if (strands->vertices[i] > max) max = strands->vertices[i];
    float* own = hair_alloc(source->host, max, 3 * sizeof *own);
    strands->colors = hair_alloc(source->host, strands->strand_count, 3 * HAIR_STRAND_COLORS * sizeof *own);
    hair_result result =
        own && strands->colors ? HAIR_OK : hair_fail_memory(source->host, "the colours of a file");
    for (uint32_t i = 0; i < strands->strand_count && !result; ++i) {
        HAIR_ASSERT(first + strands->vertices[i] <= strands->vertex_count);
        if (!read_colors_of(source->bytes + at + size * first, size, strands->vertices[i], own)) {
            hair_log(source->host, HAIR_LOG_WARNING,
                     "a colour of the strand at byte %zu is not in [0, 1]: no colour is used",
                     at + size * first);
            hair_free(source->host, strands->colors);
            strands->colors = NULL;
            break;
        }
        hair_strand_colors(strands->positions + 3 * first, strands->vertices[i], own,
                           strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)i);
        first += strands->vertices[i];
    }
    hair_free(source->host, own);
    return result;
}

unsigned char* hair_write_colors(const struct hair_strands* strands, int channels, unsigned char* at)
{
    HAIR_ASSERT(strands->colors && (channels == 3 || channels == 4));
    const float* p = strands->positions;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        uint32_t vertices = strands->vertices[i];
        double length = hair_strand_length(p, vertices), passed = 0;
        HAIR_ASSERT(length > 0);
        for (uint32_t k = 0; k < vertices; ++k, p += 3) {
            float color[3];
            if (k) passed += hair_strand_length(p - 3, 2);
            hair_strand_color_at(strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)i,
                                 (float)(passed / length), color);
            for (int c = 0; c < channels; ++c) at = hair_write_float(at, c < 3 ? hair_to_srgb(color[c]) : 1);
        }
    }
    return at;
}
