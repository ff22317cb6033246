// groomfile_named.c - chunks of .groom files that have names: factors of strands, and maps on the
// scalp.
#include "lib/asset/arrays.h"
#include "lib/asset/groomfile.h"

#define NAME 32 // bytes of a name
#define MAP_HEADER (NAME + 16) // bytes before the values of a map

// Names of the maps of a set, in the order of hair_map_range_of().
static const char* const set_names[2] = {"set_density", "set_thickness"};

// Names -------------------------------------------------------------------------------------------

// Read the name of a chunk. Other bytes than those of names are shown as '?'.
static hair_result read_name(const struct hair_groom_chunk* chunk, size_t header, char name[NAME])
{
    if (chunk->size < header)
        return HAIR_FAIL_CHUNK(chunk, "has %zu bytes, not %zu or more", chunk->size, header);
    if (!memchr(chunk->content, 0, NAME))
        return HAIR_FAIL_CHUNK(chunk, "has a name that does not end within %d bytes", NAME);
    memset(name, 0, NAME);
    for (int i = 0; chunk->content[i]; ++i) {
        char c = (char)chunk->content[i];
        bool is_shown = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        name[i] = is_shown ? c : '?';
    }
    return HAIR_OK;
}

// Find the kind of a name. Return false if the name is none.
static bool find_kind_named(const char* name, hair_strand_attribute_kind* out)
{
    for (int i = 0; i < HAIR_ATTRIBUTE_KINDS; ++i) {
        *out = (hair_strand_attribute_kind)i;
        if (!strcmp(name, hair_attribute_name_of(*out))) return true;
    }
    return false;
}

static void skip_named(const struct hair_groom_chunk* chunk, const char* name, uint32_t* unknown)
{
    if (!(*unknown)++)
        hair_log(chunk->source->host, HAIR_LOG_WARNING,
                 "the chunk \"%s\" at byte %zu has the name \"%s\", which is unknown and not read",
                 chunk->letters, chunk->at, name);
}

static unsigned char* write_name(unsigned char* at, const char* name)
{
    HAIR_ASSERT(strlen(name) < NAME);
    memset(at, 0, NAME);
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the bytes are no string.
    memcpy(at, name, strlen(name));
    return at + NAME;
}

// Reading -----------------------------------------------------------------------------------------

static hair_result read_factors(const struct hair_groom_chunk* chunk, hair_asset* asset, uint32_t* unknown)
{
    struct hair_strands* strands = &asset->strands;
    hair_strand_attribute_kind kind;
    char name[NAME];
    HAIR_TRY(read_name(chunk, NAME, name));
    if (!find_kind_named(name, &kind)) return skip_named(chunk, name, unknown), HAIR_OK;
    if (strands->factors[kind]) return HAIR_FAIL_CHUNK(chunk, "has the name \"%s\" again", name);
    HAIR_TRY(hair_check_chunk_size(chunk, NAME + 4 * (uint64_t)strands->strand_count));
    return hair_read_groom_floats(chunk, NAME, strands->strand_count, hair_attribute_range_of(kind),
                                  &strands->factors[kind]);
}

// Read a map from the end of its name on. Values are allocated.
static hair_result read_map(const struct hair_groom_chunk* chunk, const hair_asset* asset,
                            struct hair_attribute_range range, hair_map* out)
{
    const unsigned char* at = chunk->content + NAME + 4;
    uint32_t source = hair_read_u32(at), width = hair_read_u32(at + 4), height = hair_read_u32(at + 8);
    if (source > HAIR_MAP_SOURCE_TRIANGLES)
        return HAIR_FAIL_CHUNK(chunk, "has the source %u, not in [0, %d]", source, HAIR_MAP_SOURCE_TRIANGLES);
    if (width > HAIR_MAX_MAP_SIDE || height > HAIR_MAX_MAP_SIDE)
        return HAIR_FAIL_CHUNK(chunk, "is of %u by %u values, not of [0, %u] each", width, height,
                               HAIR_MAX_MAP_SIDE);
    if (source == HAIR_MAP_SOURCE_IMAGE && !(width && height))
        return HAIR_FAIL_CHUNK(chunk, "is an image of %u by %u values", width, height);
    if (source == HAIR_MAP_SOURCE_IMAGE && !asset->scalp_uvs)
        return HAIR_FAIL_CHUNK(chunk, "needs a chunk \"%s\"", hair_groom_letters[HAIR_CHUNK_UVS]);
    *out = (hair_map){(hair_map_source)source, NULL, width, height};
    uint64_t count = hair_map_count_values(out, asset->scalp_vertex_count, asset->scalp_triangle_count);
    HAIR_TRY(hair_check_chunk_size(chunk, MAP_HEADER + 4 * count));
    if (!count) return HAIR_OK;
    float* values = NULL;
    hair_result result = hair_read_groom_floats(chunk, MAP_HEADER, (size_t)count, range, &values);
    out->values = values;
    return result;
}

static hair_result read_set_map(const struct hair_groom_chunk* chunk, uint32_t index, int is_thickness,
                                hair_asset* asset)
{
    if (index >= HAIR_MAP_SETS)
        return HAIR_FAIL_CHUNK(chunk, "has the index %u, not in [0, %d]", index, HAIR_MAP_SETS - 1);
    while (asset->map_set_count <= index) asset->map_sets[asset->map_set_count++] = hair_map_set_default();
    hair_map_set* set = &asset->map_sets[index];
    hair_map* map = is_thickness ? &set->thickness : &set->density;
    if (map->source)
        return HAIR_FAIL_CHUNK(chunk, "is the map \"%s\" of set %u again", set_names[is_thickness], index);
    return read_map(chunk, asset, hair_map_range_of(is_thickness), map);
}

static hair_result read_map_chunk(const struct hair_groom_chunk* chunk, hair_asset* asset, uint32_t* unknown)
{
    hair_strand_attribute_kind kind;
    char name[NAME];
    HAIR_TRY(read_name(chunk, MAP_HEADER, name));
    uint32_t index = hair_read_u32(chunk->content + NAME);
    if (!asset->scalp_vertex_count)
        return HAIR_FAIL_CHUNK(chunk, "needs a chunk \"%s\"", hair_groom_letters[HAIR_CHUNK_SCALP]);
    for (int i = 0; i < 2; ++i)
        if (!strcmp(name, set_names[i])) return read_set_map(chunk, index, i, asset);
    if (!find_kind_named(name, &kind)) return skip_named(chunk, name, unknown), HAIR_OK;
    if (index) return HAIR_FAIL_CHUNK(chunk, "has the index %u, not 0", index);
    if (hair_read_u32(chunk->content + NAME + 4) == HAIR_MAP_SOURCE_NONE)
        return HAIR_FAIL_CHUNK(chunk, "is a map of \"%s\" without a source", name);
    if (asset->attribute_count == HAIR_MAX_ATTRIBUTES)
        return HAIR_FAIL_CHUNK(chunk, "is one of more than %d maps of attributes", HAIR_MAX_ATTRIBUTES);
    return read_map(chunk, asset, hair_attribute_range_of(kind), &hair_asset_add_attribute(asset, kind)->map);
}

hair_result hair_read_named_chunks(const struct hair_source* source, hair_asset* asset)
{
    uint32_t unknown = 0, chunks = hair_read_u32(source->bytes + 12);
    size_t at = HAIR_GROOMFILE_HEADER;
    for (uint32_t i = 0; i < chunks; ++i) {
        size_t size = (size_t)hair_read_u64(source->bytes + at + 4);
        struct hair_groom_chunk chunk = {source, HAIR_GROOM_FACTORS, at, size,
                                         source->bytes + at + HAIR_GROOMFILE_CHUNK};
        if (!memcmp(source->bytes + at, HAIR_GROOM_FACTORS, 4)) {
            HAIR_TRY(read_factors(&chunk, asset, &unknown));
        } else if (!memcmp(source->bytes + at, HAIR_GROOM_MAP, 4)) {
            chunk.letters = HAIR_GROOM_MAP;
            HAIR_TRY(read_map_chunk(&chunk, asset, &unknown));
        }
        at += HAIR_GROOMFILE_CHUNK + size;
    }
    uint32_t count = hair_asset_count_attributes(asset);
    if (count <= HAIR_MAX_ATTRIBUTES) return HAIR_OK;
    return hair_fail(source->host, HAIR_ERROR_FILE,
                     "the chunks up to byte %zu make %u attributes, more than %d", at, count,
                     HAIR_MAX_ATTRIBUTES);
}

// Writing -----------------------------------------------------------------------------------------

const char* hair_named_letters(uint32_t index)
{
    HAIR_ASSERT(index < HAIR_NAMED_CHUNKS);
    return index < HAIR_ATTRIBUTE_KINDS ? HAIR_GROOM_FACTORS : HAIR_GROOM_MAP;
}

static uint64_t write_factors_chunk(const struct hair_strands* strands, uint32_t kind, unsigned char* at)
{
    if (!strands->factors[kind]) return 0;
    if (at)
        hair_write_floats(write_name(at, hair_attribute_name_of((hair_strand_attribute_kind)kind)),
                          strands->factors[kind], strands->strand_count);
    return NAME + 4 * (uint64_t)strands->strand_count;
}

static uint64_t write_map_chunk(const hair_asset* asset, const char* name, uint32_t index,
                                const hair_map* map, unsigned char* at)
{
    uint64_t count = hair_map_count_values(map, asset->scalp_vertex_count, asset->scalp_triangle_count);
    if (at) {
        at = hair_write_u32(write_name(at, name), index);
        at = hair_write_u32(at, (uint32_t)map->source);
        at = hair_write_u32(at, map->width);
        at = hair_write_u32(at, map->height);
        hair_write_floats(at, map->values, (size_t)count);
    }
    return MAP_HEADER + 4 * count;
}

static uint64_t write_set_map(const hair_asset* asset, uint32_t index, int is_thickness, unsigned char* at)
{
    if (index >= asset->map_set_count) return 0;
    const hair_map_set* set = &asset->map_sets[index];
    const hair_map* map = is_thickness ? &set->thickness : &set->density;
    bool is_written = map->source || (!is_thickness && !set->thickness.source);
    return is_written ? write_map_chunk(asset, set_names[is_thickness], index, map, at) : 0;
}

uint64_t hair_write_named_chunk(const hair_asset* asset, uint32_t index, unsigned char* at)
{
    HAIR_ASSERT(index < HAIR_NAMED_CHUNKS);
    if (index < HAIR_ATTRIBUTE_KINDS) return write_factors_chunk(&asset->strands, index, at);
    index -= HAIR_ATTRIBUTE_KINDS;
    if (index < 2 * HAIR_MAP_SETS) return write_set_map(asset, index / 2, index % 2, at);
    index -= 2 * HAIR_MAP_SETS;
    if (index >= asset->attribute_count) return 0;
    const hair_strand_attribute* attribute = &asset->attributes[index];
    if (!attribute->map.source) return 0;
    return write_map_chunk(asset, hair_attribute_name_of(attribute->kind), 0, &attribute->map, at);
}
