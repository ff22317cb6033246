// groomfile.c - .groom files: strands with radii, groups and colours, and their scalp, in chunks
// with checksums. groomfile.h has the layout.
#include "lib/asset/groomfile.h"
#include "lib/base/crc.h"

// Content -----------------------------------------------------------------------------------------

#define STRANDS_HEADER 12 // bytes before the numbers of vertices

static hair_result check_strands_chunk(const struct hair_groom_chunk* chunk)
{
    if (chunk->size < STRANDS_HEADER) return hair_check_chunk_size(chunk, STRANDS_HEADER);
    uint32_t strands = hair_read_u32(chunk->content), vertices = hair_read_u32(chunk->content + 4),
             set = hair_read_u32(chunk->content + 8);
    uint64_t sum = 0;
    if (strands == 0 || !hair_counts_are_allowed(strands, vertices))
        return HAIR_FAIL_CHUNK(chunk, "has %u strands and %u vertices, not in [1, %u] and [2, %u]", strands,
                               vertices, HAIR_FILE_MAX_STRANDS, HAIR_FILE_MAX_VERTICES);
    if (set > HAIR_STRAND_SET_GUIDES)
        return HAIR_FAIL_CHUNK(chunk, "has the set %u of strands, not in [0, 1]", set);
    HAIR_TRY(hair_check_chunk_size(chunk, STRANDS_HEADER + (uint64_t)strands));
    for (size_t i = 0; i < strands; ++i) {
        uint32_t more = chunk->content[STRANDS_HEADER + i];
        if (more == 0) return HAIR_FAIL_CHUNK(chunk, "has 1 vertex of strand %zu, not 2 to 256", i);
        sum += more + 1;
    }
    if (sum == vertices) return HAIR_OK;
    return HAIR_FAIL_CHUNK(chunk, "has strands of %llu vertices, not the %u that it says",
                           (unsigned long long)sum, vertices);
}

static hair_result read_groom_radii(const struct hair_groom_chunk* chunk, struct hair_strands* strands)
{
    float scale = chunk->source->import->scale;
    HAIR_TRY(hair_check_chunk_size(chunk, 4 * (uint64_t)strands->strand_count));
    strands->radii = hair_alloc(chunk->source->host, strands->strand_count, sizeof *strands->radii);
    if (!strands->radii) return hair_fail_memory(chunk->source->host, "the radii of a file");
    for (size_t i = 0; i < strands->strand_count; ++i) {
        float radius = strands->radii[i] = hair_read_float(chunk->content + 4 * i);
        if (!(radius >= 0 && radius * scale <= 1e6f))
            return HAIR_FAIL_CHUNK(chunk, "has the radius %g of strand %zu, not in [0, %g]", (double)radius,
                                   i, 1e6 / (double)scale);
    }
    return HAIR_OK;
}

static hair_result read_groom_groups(const struct hair_groom_chunk* chunk, struct hair_strands* strands)
{
    HAIR_TRY(hair_check_chunk_size(chunk, strands->strand_count));
    strands->groups = hair_alloc(chunk->source->host, strands->strand_count, sizeof *strands->groups);
    if (!strands->groups) return hair_fail_memory(chunk->source->host, "the groups of a file");
    for (size_t i = 0; i < strands->strand_count; ++i) {
        strands->groups[i] = chunk->content[i];
        if (chunk->content[i] >= HAIR_MAX_STRAND_GROUPS)
            return HAIR_FAIL_CHUNK(chunk, "has the group %u of strand %zu, not in [0, %d]", chunk->content[i],
                                   i, HAIR_MAX_STRAND_GROUPS - 1);
    }
    return HAIR_OK;
}

static hair_result read_groom_guides(const struct hair_groom_chunk* chunk, struct hair_strands* strands)
{
    HAIR_TRY(hair_check_chunk_size(chunk, strands->strand_count));
    for (size_t i = 0; i < strands->strand_count; ++i)
        if (chunk->content[i] > 1)
            return HAIR_FAIL_CHUNK(chunk, "has the number %u of strand %zu, not in [0, 1]", chunk->content[i],
                                   i);
    strands->guides = hair_alloc(chunk->source->host, strands->strand_count, sizeof *strands->guides);
    if (!strands->guides) return hair_fail_memory(chunk->source->host, "the guides of a file");
    memcpy(strands->guides, chunk->content, strands->strand_count);
    return HAIR_OK;
}

hair_result hair_decode_groomfile(const struct hair_source* source, hair_asset* asset)
{
    struct hair_groom_chunk chunks[HAIR_CHUNK_COUNT] = {0};
    HAIR_TRY(hair_find_groom_chunks(source, chunks));
    const struct hair_groom_chunk *list = &chunks[HAIR_CHUNK_STRANDS], *curves = &chunks[HAIR_CHUNK_CURVES];
    struct hair_strands* strands = &asset->strands;
    HAIR_TRY(check_strands_chunk(list));
    uint32_t count = hair_read_u32(list->content);
    const unsigned char* more = list->content + STRANDS_HEADER;
    HAIR_TRY(hair_check_curves(curves, count, more));
    HAIR_TRY(hair_strands_allocate(source->host, strands, count, hair_read_u32(list->content + 4)));
    asset->strand_set = (hair_strand_set)hair_read_u32(list->content + 8);
    for (size_t i = 0; i < count; ++i) strands->vertices[i] = more[i] + 1u;
    hair_read_curves(curves, strands);
    if (chunks[HAIR_CHUNK_RADII].letters) HAIR_TRY(read_groom_radii(&chunks[HAIR_CHUNK_RADII], strands));
    if (chunks[HAIR_CHUNK_GROUPS].letters) HAIR_TRY(read_groom_groups(&chunks[HAIR_CHUNK_GROUPS], strands));
    if (chunks[HAIR_CHUNK_COLORS].letters)
        HAIR_TRY(hair_read_groom_colors(&chunks[HAIR_CHUNK_COLORS], strands));
    if (chunks[HAIR_CHUNK_GUIDES].letters) HAIR_TRY(read_groom_guides(&chunks[HAIR_CHUNK_GUIDES], strands));
    HAIR_TRY(hair_read_groom_scalp(chunks, asset));
    return hair_read_named_chunks(source, asset);
}

// Writing -----------------------------------------------------------------------------------------

static uint64_t write_strands_chunk(const hair_asset* asset, unsigned char* at)
{
    const struct hair_strands* strands = &asset->strands;
    if (at) {
        at = hair_write_u32(at, strands->strand_count);
        at = hair_write_u32(at, strands->vertex_count);
        at = hair_write_u32(at, (uint32_t)asset->strand_set);
        for (size_t i = 0; i < strands->strand_count; ++i) at[i] = (unsigned char)(strands->vertices[i] - 1);
    }
    return STRANDS_HEADER + (uint64_t)strands->strand_count;
}

static uint64_t write_mesh(const hair_asset* asset, unsigned char* at)
{
    size_t vertices = asset->scalp_vertex_count, triangles = asset->scalp_triangle_count;
    if (at) {
        at = hair_write_u32(at, asset->scalp_vertex_count);
        at = hair_write_u32(at, asset->scalp_triangle_count);
        at = hair_write_floats(at, asset->scalp_positions, 3 * vertices);
        for (size_t i = 0; i < 3 * triangles; ++i) at = hair_write_u32(at, asset->scalp_triangles[i]);
    }
    return 8 + 12 * (uint64_t)(vertices + triangles);
}

static uint64_t write_joints(const hair_asset* asset, unsigned char* at)
{
    size_t vertices = asset->scalp_vertex_count;
    if (at) {
        at = hair_write_u32(at, asset->scalp_joint_count);
        for (size_t i = 0; i < 4 * vertices; ++i) at = hair_write_u16(at, asset->scalp_joints[i]);
        hair_write_floats(at, asset->scalp_weights, 4 * vertices);
    }
    return 4 + 24 * (uint64_t)vertices;
}

// Write an array of bytes if there is one.
static uint64_t write_bytes(const void* bytes, size_t size, unsigned char* at)
{
    if (at && bytes) memcpy(at, bytes, size);
    return bytes ? size : 0;
}

// Write an array of floats if there is one.
static uint64_t write_array(const float* values, size_t count, unsigned char* at)
{
    if (at && values) hair_write_floats(at, values, count);
    return values ? 4 * (uint64_t)count : 0;
}

#define CHUNKS (HAIR_CHUNK_COUNT + HAIR_NAMED_CHUNKS) // Maximum number of chunks of a file.

// Write the content of a chunk. Return its size, or 0 if the asset has no such content. `at` of
// NULL only measures.
static uint64_t write_content(const hair_asset* asset, int chunk, unsigned char* at)
{
    const struct hair_strands* strands = &asset->strands;
    switch (chunk) {
    case HAIR_CHUNK_STRANDS: return write_strands_chunk(asset, at);
    case HAIR_CHUNK_CURVES: return hair_write_curves(strands, at);
    case HAIR_CHUNK_RADII: return write_array(strands->radii, strands->strand_count, at);
    case HAIR_CHUNK_GROUPS: return write_bytes(strands->groups, strands->strand_count, at);
    case HAIR_CHUNK_GUIDES: return write_bytes(strands->guides, strands->strand_count, at);
    case HAIR_CHUNK_JOINT_NAMES: return write_bytes(asset->joint_names, asset->joint_names_size, at);
    case HAIR_CHUNK_COLORS: return strands->colors ? hair_write_groom_colors(strands, at) : 0;
    case HAIR_CHUNK_SCALP: return asset->scalp_positions ? write_mesh(asset, at) : 0;
    case HAIR_CHUNK_DENSITY: return write_array(asset->scalp_density, asset->scalp_vertex_count, at);
    case HAIR_CHUNK_UVS: return write_array(asset->scalp_uvs, 2 * (size_t)asset->scalp_vertex_count, at);
    case HAIR_CHUNK_SKIN: return asset->scalp_joints ? write_joints(asset, at) : 0;
    default: return hair_write_named_chunk(asset, (uint32_t)chunk - HAIR_CHUNK_COUNT, at);
    }
}

static const char* letters_of(int chunk)
{
    return chunk < HAIR_CHUNK_COUNT ? hair_groom_letters[chunk]
                                    : hair_named_letters((uint32_t)chunk - HAIR_CHUNK_COUNT);
}

hair_result hair_size_groomfile(const hair_asset* asset, size_t* size)
{
    uint64_t sum = HAIR_GROOMFILE_HEADER;
    for (int i = 0; i < CHUNKS; ++i) {
        uint64_t content = write_content(asset, i, NULL);
        if (content) sum += HAIR_GROOMFILE_CHUNK + content;
    }
    if (sum > HAIR_GROOMFILE_MAX_BYTES || sum > SIZE_MAX)
        return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "a .groom of %llu bytes is longer than %llu",
                         (unsigned long long)sum, (unsigned long long)HAIR_GROOMFILE_MAX_BYTES);
    *size = (size_t)sum;
    return HAIR_OK;
}

void hair_encode_groomfile(const hair_asset* asset, unsigned char* bytes)
{
    unsigned char* at = bytes + HAIR_GROOMFILE_HEADER;
    uint32_t chunks = 0;
    for (int i = 0; i < CHUNKS; ++i) {
        uint64_t size = write_content(asset, i, at + HAIR_GROOMFILE_CHUNK);
        if (!size) continue;
        memcpy(at, letters_of(i), 4);
        hair_write_u64(at + 4, size);
        uint32_t sum = hair_crc_add(0, at, 12);
        hair_write_u32(at + 12, hair_crc_add(sum, at + HAIR_GROOMFILE_CHUNK, (size_t)size));
        at += HAIR_GROOMFILE_CHUNK + size;
        ++chunks;
    }
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the bytes are no string.
    memcpy(bytes, HAIR_GROOMFILE_MAGIC, 8);
    hair_write_u32(bytes + 8, HAIR_GROOMFILE_VERSION);
    hair_write_u32(bytes + 12, chunks);
    hair_write_u64(bytes + 16, (uint64_t)(at - bytes));
    hair_write_u32(bytes + 24, hair_crc_add(0, bytes, 24));
    hair_write_u32(bytes + 28, 0);
}
