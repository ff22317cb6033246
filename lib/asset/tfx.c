// tfx.c - the binary .tfx formats of AMD's TressFX, versions 3 and 4: guides with equal numbers of
// vertices.
//
//   version 4                                    version 3
//   byte  0  f32 version, 4.0                    byte   0  f32 version, 3.0
//         4  u32 strands                                4  u32 strands
//         8  u32 vertices of each                       8  u32 vertices of each
//        12  u32 offset of f32[4] positions            12  u32 followers of each guide (not read)
//        16  of f32[2] texture coordinates             16  i32 1 if both ends are fixed (not read)
//        20  of f32[2] coordinates per vertex          20  31 reserved u32
//        24  of f32 thickness                         144  u32 offset of f32[3] positions
//        28  of f32[4] colours per vertex             148  of f32 thickness
//        32  32 reserved u32                          152  of f32[2] texture coordinates
//       160  data                                     156  of f32[4] colours per vertex
//                                                     160  of u32 guide of each strand
//                                                     164  of f32[2] texture coordinates per vertex
//                                                     168  32 reserved u32
//                                                     296  data
//
// Offsets come in any order. An offset of 0 means that the section is missing. Positions and
// colours are read, with colours as sRGB. The other sections must lie in the file. The fourth
// number of a position is its inverse mass. It is 0 at the two vertices next to the root, which are
// fixed. Thickness is a factor, not a length, so it gives no radius. Overlapping sections are not
// detected. Each is read at its offset.
#include "lib/asset/formats.h"

#define SECTIONS 6
#define MAX_GAP 65536 // Maximum number of bytes before a section that belong to no section.

struct section {
    uint32_t at; // byte of the offset
    uint32_t size, per_vertex;
    const char* what;
};

struct tfx_layout {
    uint32_t header, floats; // bytes of the header, floats of a position
    uint32_t colors_at; // byte of the offset of colours
    struct section sections[SECTIONS]; // positions first
};

static const struct tfx_layout version3 = {296,
                                           3,
                                           156,
                                           {{144, 12, 1, "positions"},
                                            {148, 4, 0, "thicknesses"},
                                            {152, 8, 0, "texture coordinates of strands"},
                                            {156, 16, 1, "colours"},
                                            {160, 4, 0, "guides of strands"},
                                            {164, 8, 1, "texture coordinates of vertices"}}};

static const struct tfx_layout version4 = {160,
                                           4,
                                           28,
                                           {{12, 16, 1, "positions"},
                                            {16, 8, 0, "texture coordinates of strands"},
                                            {20, 8, 1, "texture coordinates of vertices"},
                                            {24, 4, 0, "thicknesses"},
                                            {28, 16, 1, "colours"}}};

bool hair_is_tfx3(const unsigned char* bytes, size_t size)
{
    return size >= 4 && hair_read_float(bytes) >= 3 && hair_read_float(bytes) < 4;
}

bool hair_is_tfx4(const unsigned char* bytes, size_t size)
{
    return size >= 4 && hair_read_float(bytes) >= 4 && hair_read_float(bytes) < 5;
}

// Return the bytes of the section at an offset that is not 0.
static uint64_t size_of_section(const struct section* section, uint64_t strands, uint64_t vertices)
{
    return (section->per_vertex ? vertices : strands) * section->size;
}

// Return the maximum offset of a section: the header, all sections and a gap lie before it.
static uint64_t find_max_offset(const unsigned char* bytes, const struct tfx_layout* layout, uint64_t strands,
                                uint64_t vertices)
{
    uint64_t max = layout->header + MAX_GAP;
    for (uint32_t i = 0; i < SECTIONS && layout->sections[i].size; ++i)
        if (hair_read_u32(bytes + layout->sections[i].at))
            max += size_of_section(&layout->sections[i], strands, vertices);
    return max;
}

static uint64_t max_size(const unsigned char* bytes, size_t size, const struct tfx_layout* layout)
{
    uint64_t max = layout->header;
    if (size < layout->header) return max;
    uint64_t strands = hair_read_u32(bytes + 4), vertices = strands * hair_read_u32(bytes + 8);
    if (!hair_counts_are_allowed(strands, vertices)) return layout->header;
    uint64_t max_offset = find_max_offset(bytes, layout, strands, vertices);
    for (uint32_t i = 0; i < SECTIONS && layout->sections[i].size; ++i) {
        const struct section* section = &layout->sections[i];
        uint64_t offset = hair_read_u32(bytes + section->at),
                 end = offset + size_of_section(section, strands, vertices);
        if (offset > max_offset) return layout->header;
        if (offset && end > max) max = end;
    }
    return max;
}

uint64_t hair_max_size_of_tfx3(const unsigned char* bytes, size_t size)
{
    return max_size(bytes, size, &version3);
}

uint64_t hair_max_size_of_tfx4(const unsigned char* bytes, size_t size)
{
    return max_size(bytes, size, &version4);
}

static hair_result check_section(const struct hair_source* source, const struct tfx_layout* layout,
                                 const struct section* section, uint64_t strands, uint64_t vertices)
{
    uint32_t offset = hair_read_u32(source->bytes + section->at);
    if (offset == 0 && section != layout->sections) return HAIR_OK;
    if (offset < layout->header || offset % 4)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the offset of the %s at byte %u is %u, which is not a multiple of 4 from %u on",
                         section->what, section->at, offset, layout->header);
    uint64_t max = find_max_offset(source->bytes, layout, strands, vertices);
    if (offset > max)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the offset of the %s at byte %u is %u, but all sections fit before byte %llu",
                         section->what, section->at, offset, (unsigned long long)max);
    return hair_check_section(source, section->what, offset, section->per_vertex ? vertices : strands,
                              section->size);
}

// Read the header. On success all sections lie in the file.
static hair_result read_tfx_header(const struct hair_source* source, const struct tfx_layout* layout,
                                   uint32_t* strands, uint32_t* each)
{
    HAIR_TRY(hair_check_section(source, "header", 0, layout->header, 1));
    *strands = hair_read_u32(source->bytes + 4);
    *each = hair_read_u32(source->bytes + 8);
    if (*strands == 0) return hair_fail(source->host, HAIR_ERROR_FILE, "the count of strands at byte 4 is 0");
    if (*each < 2)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the vertices of each strand at byte 8 are %u, fewer than 2", *each);
    uint64_t vertices = (uint64_t)*strands * *each;
    HAIR_TRY(hair_check_counts(source, *strands, vertices));
    for (uint32_t i = 0; i < SECTIONS && layout->sections[i].size; ++i)
        HAIR_TRY(check_section(source, layout, &layout->sections[i], *strands, vertices));
    return HAIR_OK;
}

static hair_result decode_tfx(const struct hair_source* source, const struct tfx_layout* layout,
                              hair_asset* asset)
{
    uint32_t count = 0, each = 0;
    struct hair_strands* strands = &asset->strands;
    HAIR_TRY(read_tfx_header(source, layout, &count, &each));
    HAIR_TRY(hair_strands_allocate(source->host, strands, count, count * each));

    HAIR_ASSERT((uint64_t)count * each == strands->vertex_count);
    asset->strand_set = HAIR_STRAND_SET_GUIDES;
    for (uint32_t i = 0; i < count; ++i) strands->vertices[i] = each;
    const unsigned char* at = source->bytes + hair_read_u32(source->bytes + layout->sections[0].at);
    for (size_t i = 0; i < strands->vertex_count; ++i, at += 4 * (size_t)layout->floats)
        for (size_t j = 0; j < 3; ++j) strands->positions[3 * i + j] = hair_read_float(at + 4 * j);
    uint32_t colors = hair_read_u32(source->bytes + layout->colors_at);
    return colors ? hair_read_colors(source, colors, 16, strands) : HAIR_OK;
}

hair_result hair_decode_tfx3(const struct hair_source* source, hair_asset* asset)
{
    return decode_tfx(source, &version3, asset);
}

hair_result hair_decode_tfx4(const struct hair_source* source, hair_asset* asset)
{
    return decode_tfx(source, &version4, asset);
}

hair_result hair_size_tfx4(const hair_asset* asset, size_t* size)
{
    const struct hair_strands* strands = &asset->strands;
    uint32_t each = strands->vertices[0];
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        uint32_t vertices = strands->vertices[i];
        if (vertices == each && vertices >= 4 && vertices <= 64 && (vertices & (vertices - 1)) == 0) continue;
        return hair_fail(
            &asset->host, HAIR_ERROR_ARGUMENT,
            "strand %u has %u vertices, strand 0 has %u, but .tfx needs 4, 8, 16, 32 or 64 in all: "
            "read with hair_import.strand_vertices set",
            i, vertices, each);
    }
    uint64_t needed = version4.header + (strands->colors ? 32u : 16u) * (uint64_t)strands->vertex_count +
                      8 * (uint64_t)strands->strand_count;
    if (needed > UINT32_MAX)
        return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "a .tfx of %llu bytes is longer than %u",
                         (unsigned long long)needed, UINT32_MAX);
    *size = (size_t)needed;
    return HAIR_OK;
}

void hair_encode_tfx4(const hair_asset* asset, unsigned char* bytes)
{
    const struct hair_strands* strands = &asset->strands;
    uint32_t each = strands->vertices[0];

    HAIR_ASSERT((uint64_t)strands->strand_count * each == strands->vertex_count);
    memset(bytes, 0, version4.header);
    unsigned char* at = hair_write_float(bytes, 4);
    at = hair_write_u32(at, strands->strand_count);
    at = hair_write_u32(at, each);
    at = hair_write_u32(at, version4.header);
    hair_write_u32(at, version4.header + 16 * strands->vertex_count);
    if (strands->colors)
        hair_write_u32(bytes + version4.colors_at,
                       version4.header + 16 * strands->vertex_count + 8 * strands->strand_count);

    at = bytes + version4.header;
    for (size_t i = 0; i < strands->vertex_count; ++i) {
        for (size_t j = 0; j < 3; ++j) at = hair_write_float(at, strands->positions[3 * i + j]);
        at = hair_write_float(at, i % each < 2 ? 0.0f : 1.0f);
    }
    // Readers expect texture coordinates, but none are known.
    memset(at, 0, 8 * (size_t)strands->strand_count);
    if (strands->colors) hair_write_colors(strands, 4, at + 8 * (size_t)strands->strand_count);
}
