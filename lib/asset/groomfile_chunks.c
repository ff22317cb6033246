// groomfile_chunks.c - header and list of the chunks of .groom files.
#include "lib/asset/groomfile.h"
#include "lib/asset/track.h"
#include "lib/base/crc.h"

const char hair_groom_letters[HAIR_CHUNK_COUNT][5] = {"STRD", "CURV", "RADI", "GRUP", "COLR", "SCLP",
                                                      "DENS", "TEXC", "SKIN", "JNTN", "GUID"};

bool hair_is_groomfile(const unsigned char* bytes, size_t size)
{
    return size >= 5 && memcmp(bytes, HAIR_GROOMFILE_MAGIC, 5) == 0;
}

uint64_t hair_max_size_of_groomfile(const unsigned char* bytes, size_t size)
{
    if (size < HAIR_GROOMFILE_HEADER) return HAIR_GROOMFILE_HEADER;
    uint64_t claimed = hair_read_u64(bytes + 16);
    bool is_whole = hair_read_u32(bytes + 24) == hair_crc_add(0, bytes, 24);
    bool is_allowed = claimed >= HAIR_GROOMFILE_HEADER && claimed <= HAIR_GROOMFILE_MAX_BYTES;
    return is_whole && is_allowed ? claimed : HAIR_GROOMFILE_HEADER;
}

hair_result hair_check_chunk_size(const struct hair_groom_chunk* chunk, uint64_t size)
{
    if (chunk->size == size) return HAIR_OK;
    return HAIR_FAIL_CHUNK(chunk, "has %zu bytes, not %llu", chunk->size, (unsigned long long)size);
}

hair_result hair_read_groom_floats(const struct hair_groom_chunk* chunk, size_t at, size_t count,
                                   struct hair_attribute_range range, float** out)
{
    HAIR_ASSERT(at + 4 * count <= chunk->size);
    float* values = *out = hair_alloc(chunk->source->host, count, sizeof *values);
    if (!values) return hair_fail_memory(chunk->source->host, "the numbers of a file");
    for (size_t i = 0; i < count; ++i) {
        values[i] = hair_read_float(chunk->content + at + 4 * i);
        if (!(values[i] >= range.min && values[i] <= range.max)) // NaN fails too.
            return HAIR_FAIL_CHUNK(chunk, "has the number %g, not in [%g, %g]", (double)values[i],
                                   (double)range.min, (double)range.max);
    }
    return HAIR_OK;
}

unsigned char* hair_write_floats(unsigned char* at, const float* values, size_t count)
{
    for (size_t i = 0; i < count; ++i) at = hair_write_float(at, values[i]);
    return at;
}

// Header and list of chunks -----------------------------------------------------------------------

struct groom_header {
    uint32_t chunks;
    size_t end; // of the file
};

static hair_result check_end(const struct hair_source* source, struct groom_header* header)
{
    uint64_t end = hair_read_u64(source->bytes + 16);
    if (end < HAIR_GROOMFILE_HEADER || end > HAIR_GROOMFILE_MAX_BYTES)
        return hair_fail(
            source->host, HAIR_ERROR_FILE, "the size of the file at byte 16 is %llu bytes, not in [%d, %llu]",
            (unsigned long long)end, HAIR_GROOMFILE_HEADER, (unsigned long long)HAIR_GROOMFILE_MAX_BYTES);
    if (end > source->size)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the file ends at byte %zu, but it had %llu bytes by byte 16", source->size,
                         (unsigned long long)end);
    if (end < source->size)
        hair_log(source->host, HAIR_LOG_WARNING, "what follows the chunks, from byte %llu on, is not read",
                 (unsigned long long)end);
    header->end = (size_t)end;
    return HAIR_OK;
}

static hair_result read_groom_header(const struct hair_source* source, struct groom_header* header)
{
    HAIR_TRY(hair_check_section(source, "header", 0, HAIR_GROOMFILE_HEADER, 1));
    if (memcmp(source->bytes, HAIR_GROOMFILE_MAGIC, 8) != 0)
        return hair_fail(
            source->host, HAIR_ERROR_FILE,
            "bytes at byte 5 are not 13, 10, 26: a conversion of line ends has damaged the file");
    uint32_t crc = hair_read_u32(source->bytes + 24), own = hair_crc_add(0, source->bytes, 24);
    if (crc != own)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the checksum at byte 24 is 0x%08x, but that of the header is 0x%08x", crc, own);
    uint32_t version = hair_read_u32(source->bytes + 8);
    if (version != HAIR_GROOMFILE_VERSION)
        return hair_fail(
            source->host, HAIR_ERROR_FILE, "the version at byte 8 is %u%s, and only version %d can be read",
            version, version > HAIR_GROOMFILE_VERSION ? ", of a newer library" : "", HAIR_GROOMFILE_VERSION);
    header->chunks = hair_read_u32(source->bytes + 12);
    return check_end(source, header);
}

// Read the letters of a chunk. Other bytes than capital letters are shown as '?'.
static void read_letters(const unsigned char* at, char letters[5])
{
    for (int i = 0; i < 4; ++i) letters[i] = at[i] >= 'A' && at[i] <= 'Z' ? (char)at[i] : '?';
    letters[4] = 0;
}

// Fail unless a whole chunk with the right checksum begins at `at`. *end receives its end.
static hair_result check_chunk(const struct hair_source* source, const struct groom_header* header, size_t at,
                               size_t* end)
{
    char letters[5];
    size_t left = header->end - at;
    if (left < HAIR_GROOMFILE_CHUNK)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the file ends at byte %zu, but byte 12 says that it has %u chunks", header->end,
                         header->chunks);
    const unsigned char* bytes = source->bytes + at;
    uint64_t size = hair_read_u64(bytes + 4);
    read_letters(bytes, letters);
    if (size > left - HAIR_GROOMFILE_CHUNK)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the chunk \"%s\" at byte %zu has %llu bytes, but the file ends at byte %zu",
                         letters, at, (unsigned long long)size, header->end);
    uint32_t crc = hair_read_u32(bytes + 12), own = hair_crc_add(0, bytes, 12);
    own = hair_crc_add(own, bytes + HAIR_GROOMFILE_CHUNK, (size_t)size);
    if (crc != own)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the chunk \"%s\" at byte %zu is damaged: its checksum is 0x%08x, not 0x%08x",
                         letters, at, own, crc);
    *end = at + HAIR_GROOMFILE_CHUNK + (size_t)size;
    return HAIR_OK;
}

static hair_result add_chunk(const struct hair_source* source, size_t at, size_t end,
                             struct hair_groom_chunk chunks[HAIR_CHUNK_COUNT], uint32_t* unknown)
{
    int i = 0;
    char letters[5];
    read_letters(source->bytes + at, letters);
    if (!strcmp(letters, HAIR_GROOM_FACTORS) || !strcmp(letters, HAIR_GROOM_MAP)) return HAIR_OK;
    while (i < HAIR_CHUNK_COUNT && strcmp(hair_groom_letters[i], letters) != 0) ++i;
    if (i == HAIR_CHUNK_COUNT) {
        if (!(*unknown)++)
            hair_log(source->host, HAIR_LOG_WARNING, "the chunk \"%s\" at byte %zu is unknown and not read",
                     letters, at);
        return HAIR_OK;
    }
    if (chunks[i].letters) return HAIR_FAIL_CHUNK(&chunks[i], "stands again at byte %zu", at);
    size_t content = at + HAIR_GROOMFILE_CHUNK;
    chunks[i] =
        (struct hair_groom_chunk){source, hair_groom_letters[i], at, end - content, source->bytes + content};
    return HAIR_OK;
}

hair_result hair_find_groom_chunks(const struct hair_source* source,
                                   struct hair_groom_chunk chunks[HAIR_CHUNK_COUNT])
{
    struct groom_header header = {0};
    HAIR_TRY(read_groom_header(source, &header));
    size_t at = HAIR_GROOMFILE_HEADER;
    uint32_t unknown = 0;
    for (uint32_t i = 0; i < header.chunks; ++i) {
        size_t end = at;
        HAIR_TRY(check_chunk(source, &header, at, &end));
        HAIR_TRY(add_chunk(source, at, end, chunks, &unknown));
        at = end;
    }
    if (at != header.end)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the %u chunks end at byte %zu, but the file ends at byte %zu", header.chunks, at,
                         header.end);
    for (int i = HAIR_CHUNK_STRANDS; i <= HAIR_CHUNK_CURVES; ++i)
        if (!chunks[i].letters)
            return hair_fail(source->host, HAIR_ERROR_FILE,
                             "the file ends at byte %zu without a chunk \"%s\"", at, hair_groom_letters[i]);
    return HAIR_OK;
}

hair_result hair_check_tracks(const struct hair_groom_chunk* chunk, uint32_t strands,
                              const unsigned char* counts, uint32_t each)
{
    uint64_t fixed = ((uint64_t)each + 4) * strands, bits = 0;
    if (chunk->size < fixed)
        return HAIR_FAIL_CHUNK(chunk, "has %zu bytes, too few for %u strands", chunk->size, strands);
    for (size_t i = 0; i < strands; ++i) {
        uint32_t widths = hair_read_u32(chunk->content + each * (size_t)strands + 4 * i);
        uint32_t count = counts ? counts[i] + 1u : HAIR_STRAND_COLORS;
        bool is_raw = counts && chunk->content[12 * (size_t)strands + i] == 0;
        if (widths > (is_raw ? 0 : HAIR_TRACK_WIDTHS))
            return HAIR_FAIL_CHUNK(chunk, "has the widths 0x%x of strand %zu", widths, i);
        bits += is_raw ? 96 * (uint64_t)counts[i] : hair_track_count_bits(widths, count);
    }
    return hair_check_chunk_size(chunk, fixed + (bits + 7) / 8);
}
