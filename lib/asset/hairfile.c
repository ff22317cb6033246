// hairfile.c - the .hair format ("cyHair"): all strands, each with its own number of vertices.
//
//   byte  0  "HAIR"                        20  f32 thickness without the array (not read)
//         4  u32 strands                   24  f32 transparency
//         8  u32 vertices of all           28  f32[3] colour
//        12  u32 bits of the arrays        40  88 bytes of text, not always ended by 0
//        16  u32 segments of each strand without the array
//       128  the arrays whose bit is set, in the order of the bits: u16 segments, f32[3] points,
//            f32 thickness, f32 transparency, f32[3] colours. Segments are per strand, the
//            others per vertex.
//
// There is no unit. Thickness is taken as a diameter in the unit of the points, and colours as
// sRGB. Arrays of higher bits would follow everything that is read, so unknown bits are accepted
// with a warning.
#include "lib/asset/formats.h"

#include <math.h>

#define HEADER 128

enum { SEGMENTS = 1, POINTS = 2, THICKNESS = 4, TRANSPARENCY = 8, COLORS = 16, KNOWN = 31 };

struct header {
    uint32_t strands, vertices, arrays, segments;
    uint64_t segments_at, points_at, thickness_at, colors_at; // bytes
};

bool hair_is_hairfile(const unsigned char* bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "HAIR", 4) == 0;
}

uint64_t hair_max_size_of_hairfile(const unsigned char* bytes, size_t size)
{
    if (size < HEADER) return HEADER;
    uint64_t strands = hair_read_u32(bytes + 4), vertices = hair_read_u32(bytes + 8), end = HEADER;
    uint32_t arrays = hair_read_u32(bytes + 12);
    if (!hair_counts_are_allowed(strands, vertices)) return HEADER;
    if (arrays & SEGMENTS) end += 2 * strands;
    if (arrays & POINTS) end += 12 * vertices;
    if (arrays & THICKNESS) end += 4 * vertices;
    if (arrays & TRANSPARENCY) end += 4 * vertices;
    return arrays & COLORS ? end + 12 * vertices : end;
}

static hair_result check_counts(const struct hair_source* source, const struct header* header)
{
    if (header->strands == 0)
        return hair_fail(source->host, HAIR_ERROR_FILE, "the count of strands at byte 4 is 0");
    if (header->vertices == 0)
        return hair_fail(source->host, HAIR_ERROR_FILE, "the count of points at byte 8 is 0");
    HAIR_TRY(hair_check_counts(source, header->strands, header->vertices));
    if (!(header->arrays & POINTS))
        return hair_fail(source->host, HAIR_ERROR_FILE, "the arrays 0x%x at byte 12 lack the points",
                         header->arrays);
    if (header->arrays & ~(uint32_t)KNOWN)
        hair_log(source->host, HAIR_LOG_WARNING, "unknown arrays among those 0x%x at byte 12 are not read",
                 header->arrays);
    return HAIR_OK;
}

// Find the offset of each array and check that it lies in the file. `end` receives the end of the
// last known array.
static hair_result find_arrays(const struct hair_source* source, struct header* header, uint64_t* end)
{
    const struct {
        uint32_t bit, count, size;
        const char* what;
        uint64_t* at;
    } arrays[] = {
        {SEGMENTS, header->strands, 2, "segments", &header->segments_at},
        {POINTS, header->vertices, 12, "points", &header->points_at},
        {THICKNESS, header->vertices, 4, "thicknesses", &header->thickness_at},
        {TRANSPARENCY, header->vertices, 4, "transparencies", NULL},
        {COLORS, header->vertices, 12, "colours", &header->colors_at},
    };
    *end = HEADER;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        if (!(header->arrays & arrays[i].bit)) continue;
        HAIR_TRY(hair_check_section(source, arrays[i].what, *end, arrays[i].count, arrays[i].size));
        if (arrays[i].at) *arrays[i].at = *end;
        *end += (uint64_t)arrays[i].count * arrays[i].size;
    }
    return HAIR_OK;
}

static uint32_t count_vertices(const struct hair_source* source, const struct header* header, uint32_t strand)
{
    HAIR_ASSERT(strand < header->strands);
    if (header->arrays & SEGMENTS)
        return hair_read_u16(source->bytes + header->segments_at + 2 * (size_t)strand) + 1;
    return header->segments + 1;
}

static hair_result check_sum(const struct hair_source* source, const struct header* header)
{
    if (!(header->arrays & SEGMENTS)) {
        if (header->segments && ((uint64_t)header->segments + 1) * header->strands == header->vertices)
            return HAIR_OK;
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the %u segments of each strand at byte 16 do not make %u points of %u strands",
                         header->segments, header->vertices, header->strands);
    }
    uint64_t sum = 0;
    for (uint32_t i = 0; i < header->strands; ++i) sum += count_vertices(source, header, i);
    if (sum == header->vertices) return HAIR_OK;
    return hair_fail(source->host, HAIR_ERROR_FILE,
                     "the segments at byte %llu make %llu points, not the %u that byte 8 says",
                     (unsigned long long)header->segments_at, (unsigned long long)sum, header->vertices);
}

static hair_result read_header(const struct hair_source* source, struct header* header)
{
    HAIR_TRY(hair_check_section(source, "header", 0, HEADER, 1));
    header->strands = hair_read_u32(source->bytes + 4);
    header->vertices = hair_read_u32(source->bytes + 8);
    header->arrays = hair_read_u32(source->bytes + 12);
    header->segments = hair_read_u32(source->bytes + 16);
    uint64_t end = 0;
    HAIR_TRY(check_counts(source, header));
    HAIR_TRY(find_arrays(source, header, &end));
    HAIR_TRY(check_sum(source, header));
    if (source->size > end && header->arrays <= KNOWN)
        hair_log(source->host, HAIR_LOG_WARNING, "what follows the arrays, from byte %llu on, is not read",
                 (unsigned long long)end);
    return HAIR_OK;
}

// Read half the thickness at each root. One bad value discards all radii, because radii of half a
// haircut are of no use.
static hair_result read_radii(const struct hair_source* source, const struct header* header,
                              struct hair_strands* strands)
{
    strands->radii = hair_alloc(source->host, header->strands, sizeof *strands->radii);
    if (!strands->radii) return hair_fail_memory(source->host, "the radii of a file");
    size_t first = 0;
    for (uint32_t i = 0; i < header->strands; ++i) {
        size_t root = source->import->tip_first ? first + strands->vertices[i] - 1 : first;
        HAIR_ASSERT(root < header->vertices);
        size_t at = (size_t)header->thickness_at + 4 * root;
        float radius = 0.5f * hair_read_float(source->bytes + at);
        if (!(radius >= 0 && radius * source->import->scale <= 1e6f)) {
            hair_log(source->host, HAIR_LOG_WARNING, "the thickness at byte %zu is %g: no thickness is used",
                     at, (double)(2 * radius));
            hair_free(source->host, strands->radii);
            strands->radii = NULL;
            break;
        }
        strands->radii[i] = radius;
        first += strands->vertices[i];
    }
    return HAIR_OK;
}

hair_result hair_decode_hairfile(const struct hair_source* source, hair_asset* asset)
{
    struct header header = {0};
    struct hair_strands* strands = &asset->strands;
    HAIR_TRY(read_header(source, &header));
    HAIR_TRY(hair_strands_allocate(source->host, strands, header.strands, header.vertices));

    HAIR_ASSERT(header.points_at >= HEADER);
    asset->strand_set = HAIR_STRAND_SET_FULL;
    for (uint32_t i = 0; i < header.strands; ++i) strands->vertices[i] = count_vertices(source, &header, i);
    const unsigned char* points = source->bytes + header.points_at;
    for (size_t i = 0; i < 3 * (size_t)header.vertices; ++i)
        strands->positions[i] = hair_read_float(points + 4 * i);
    if (header.arrays & THICKNESS) HAIR_TRY(read_radii(source, &header, strands));
    if (header.arrays & COLORS) HAIR_TRY(hair_read_colors(source, (size_t)header.colors_at, 12, strands));
    return HAIR_OK;
}

hair_result hair_size_hairfile(const hair_asset* asset, size_t* size)
{
    const struct hair_strands* strands = &asset->strands;
    *size = HEADER + 2 * (size_t)strands->strand_count +
            (12 + (strands->radii ? 4u : 0) + (strands->colors ? 12u : 0)) * (size_t)strands->vertex_count;
    return HAIR_OK;
}

static unsigned char* write_header(const struct hair_strands* strands, unsigned char* at)
{
    static const char info[88] = "hair: metres, +y up, root first";
    static const float color[3] = {0.1f, 0.04f, 0.02f};

    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the bytes are no string.
    memcpy(at, "HAIR", 4);
    at = hair_write_u32(at + 4, strands->strand_count);
    at = hair_write_u32(at, strands->vertex_count);
    at = hair_write_u32(at, SEGMENTS | POINTS | (strands->radii ? THICKNESS : 0) |
                                (strands->colors ? COLORS : 0));
    at = hair_write_u32(at, 0);
    at = hair_write_float(at, 1e-4f); // Diameter of a real hair, for readers that ignore the array.
    at = hair_write_float(at, 0);
    for (int i = 0; i < 3; ++i) at = hair_write_float(at, color[i]);
    memcpy(at, info, sizeof info);
    return at + sizeof info;
}

void hair_encode_hairfile(const hair_asset* asset, unsigned char* bytes)
{
    const struct hair_strands* strands = &asset->strands;
    unsigned char* at = write_header(strands, bytes);
    for (uint32_t i = 0; i < strands->strand_count; ++i) at = hair_write_u16(at, strands->vertices[i] - 1);
    for (size_t i = 0; i < 3 * (size_t)strands->vertex_count; ++i)
        at = hair_write_float(at, strands->positions[i]);
    for (uint32_t i = 0; strands->radii && i < strands->strand_count; ++i)
        for (uint32_t j = 0; j < strands->vertices[i]; ++j) at = hair_write_float(at, 2 * strands->radii[i]);
    if (strands->colors) hair_write_colors(strands, 3, at);
}
