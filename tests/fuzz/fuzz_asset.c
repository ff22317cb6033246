// fuzz_asset.c - the properties of every haircut file that is accepted.
#include "tests/fuzz/fuzz_asset.h"
#include "lib/asset/asset.h"
#include "lib/base/bytes.h"

#include <math.h>
#include <string.h>

static void check_strands(const hair_asset* asset)
{
    const struct hair_strands* strands = &asset->strands;
    HAIR_FUZZ_CHECK(strands->strand_count >= 1 && strands->strand_count <= 4194304);
    HAIR_FUZZ_CHECK(asset->file_strands >= strands->strand_count);
    size_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        uint32_t count = strands->vertices[i];
        HAIR_FUZZ_CHECK(count >= 2 && count <= HAIR_STRAND_MAX_VERTICES);
        HAIR_FUZZ_CHECK(hair_strand_is_fit(strands->positions + 3 * first, count));
        if (strands->groups) HAIR_FUZZ_CHECK(strands->groups[i] < HAIR_MAX_STRAND_GROUPS);
        if (strands->radii) HAIR_FUZZ_CHECK(strands->radii[i] >= 0 && strands->radii[i] <= 1e6f);
        first += count;
    }
    HAIR_FUZZ_CHECK(first == strands->vertex_count);
    for (size_t i = 0; i < 3 * first; ++i) HAIR_FUZZ_CHECK(fabsf(strands->positions[i]) <= 1e6f);
    for (size_t i = 0; strands->colors && i < 3 * HAIR_STRAND_COLORS * (size_t)strands->strand_count; ++i)
        HAIR_FUZZ_CHECK(strands->colors[i] >= 0 && strands->colors[i] <= 1);
}

// Check that the colours at even distances are those that the strands have.
static void check_colors(const struct hair_strands* strands)
{
    float even[3 * HAIR_STRAND_COLORS];
    for (uint32_t i = 0; strands->colors && i < strands->strand_count; ++i) {
        const float* colors = strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)i;
        hair_strand_even_colors(colors, HAIR_STRAND_COLORS, even);
        HAIR_FUZZ_CHECK(!memcmp(even, colors, sizeof even));
    }
}

// Decode with a host of its own, and check the rules of success and failure. Return NULL on
// failure.
static hair_asset* decode(struct hair_fuzz_host* host, const hair_import* import, const uint8_t* bytes,
                          size_t size)
{
    hair_fuzz_host_init(host);
    hair_asset* asset = NULL;
    hair_result result = hair_asset_decode(&host->host, import, bytes, size, &asset);
    // The bounds of hair_asset.h.
    size_t asked = (size_t)12 * 256 * (size / 2 + 1),
           factor = size > 4 && !memcmp(bytes, "GROOM", 5) ? 200 : 4;
    HAIR_FUZZ_CHECK(host->peak <= ((size_t)64 << 20) + factor * size + (import->strand_vertices ? asked : 0));
    if (result == HAIR_OK) {
        HAIR_FUZZ_CHECK(host->errors == 0);
        check_strands(asset);
        return asset;
    }
    HAIR_FUZZ_CHECK(host->errors == 1 && host->blocks == 0 && !asset);
    if (result == HAIR_ERROR_MEMORY) {
        HAIR_FUZZ_CHECK(hair_fuzz_was_refused());
        return NULL;
    }
    HAIR_FUZZ_CHECK(result == HAIR_ERROR_FILE);
    const char* byte = strstr(host->sentence, "byte ");
    HAIR_FUZZ_CHECK(byte && byte[5] >= '0' && byte[5] <= '9');
    return NULL;
}

static void destroy(const struct hair_fuzz_host* host, hair_asset* asset)
{
    hair_asset_free(asset);
    HAIR_FUZZ_CHECK(host->blocks == 0);
}

static bool are_equal(const struct hair_strands* a, const struct hair_strands* b)
{
    return a->strand_count == b->strand_count && a->vertex_count == b->vertex_count &&
           !memcmp(a->vertices, b->vertices, a->strand_count * sizeof *a->vertices) &&
           !memcmp(a->positions, b->positions, 3 * (size_t)a->vertex_count * sizeof *a->positions);
}

// Write the asset in a format that can hold it. Check that the bytes are read as the same strands,
// with the same radii, and with colours if the asset has them.
static void check_round_trip(const hair_asset* asset, hair_format format)
{
    const hair_import import = {.scale = 1, .keep_fraction = 1, .seed = 1};
    size_t needed = 0, size = 0;
    HAIR_FUZZ_CHECK(hair_asset_encode(asset, HAIR_FORMAT_TFX3, NULL, 0, &needed) == HAIR_ERROR_ARGUMENT);
    if (hair_asset_encode(asset, format, NULL, 0, &needed)) return;
    unsigned char* bytes = malloc(needed);
    HAIR_FUZZ_CHECK(bytes && !hair_asset_encode(asset, format, bytes, needed, &size) && size == needed);
    HAIR_FUZZ_CHECK(hair_asset_find_max_size(bytes, size) == size);
    struct hair_fuzz_host host;
    hair_asset* again = decode(&host, &import, bytes, size);
    HAIR_FUZZ_CHECK(again && are_equal(&again->strands, &asset->strands));
    HAIR_FUZZ_CHECK(!again->strands.colors == !asset->strands.colors);
    const float *radii = asset->strands.radii, *read = again->strands.radii;
    if (format == HAIR_FORMAT_HAIR) HAIR_FUZZ_CHECK(!radii == !read);
    for (uint32_t i = 0; read && i < asset->strands.strand_count; ++i) HAIR_FUZZ_CHECK(radii[i] == read[i]);
    destroy(&host, again);
    free(bytes);
}

// Check that two positions of each vertex differ by at most 1e-5 of the length of their strand, and
// that roots are equal.
static void check_near(const struct hair_strands* a, const struct hair_strands* b)
{
    const float *p = a->positions, *q = b->positions;
    for (uint32_t i = 0; i < a->strand_count; ++i) {
        double max = 1.0000001e-5 * hair_strand_length(p, a->vertices[i]);
        HAIR_FUZZ_CHECK(!memcmp(p, q, 12));
        for (uint32_t k = 0; k < a->vertices[i]; ++k, p += 3, q += 3) {
            double x = (double)p[0] - q[0], y = (double)p[1] - q[1], z = (double)p[2] - q[2];
            HAIR_FUZZ_CHECK(x * x + y * y + z * z <= max * max);
        }
    }
}

static bool are_equal_bytes(const void* a, const void* b, size_t size)
{
    return !a == !b && (!a || !memcmp(a, b, size));
}

static void check_equal_maps(const hair_asset* asset, const hair_map* a, const hair_map* b)
{
    const size_t counts[] = {0, (size_t)a->width * a->height, asset->scalp_vertex_count,
                             asset->scalp_triangle_count};
    HAIR_FUZZ_CHECK(a->source == b->source && a->source <= HAIR_MAP_SOURCE_TRIANGLES);
    HAIR_FUZZ_CHECK(a->width == b->width && a->height == b->height && !a->values == !a->source);
    HAIR_FUZZ_CHECK(are_equal_bytes(a->values, b->values, counts[a->source] * sizeof(float)));
    for (size_t i = 0; i < counts[a->source]; ++i) HAIR_FUZZ_CHECK(a->values[i] >= 0 && a->values[i] <= 100);
}

// Check that guides, names of joints, attributes and maps are equal.
static void check_equal_named(const hair_asset* a, const hair_asset* b)
{
    size_t count = a->strands.strand_count;
    HAIR_FUZZ_CHECK(are_equal_bytes(a->strands.guides, b->strands.guides, count));
    HAIR_FUZZ_CHECK(a->joint_names_size == b->joint_names_size);
    HAIR_FUZZ_CHECK(are_equal_bytes(a->joint_names, b->joint_names, a->joint_names_size));
    HAIR_FUZZ_CHECK(a->map_set_count == b->map_set_count && a->attribute_count == b->attribute_count);
    HAIR_FUZZ_CHECK(a->map_set_count <= HAIR_MAP_SETS && a->attribute_count <= HAIR_MAX_ATTRIBUTES);
    for (uint32_t i = 0; i < a->map_set_count; ++i) {
        check_equal_maps(a, &a->map_sets[i].density, &b->map_sets[i].density);
        check_equal_maps(a, &a->map_sets[i].thickness, &b->map_sets[i].thickness);
    }
    for (uint32_t i = 0; i < a->attribute_count; ++i) {
        const hair_strand_attribute *p = &a->attributes[i], *q = &b->attributes[i];
        struct hair_attribute_range range = hair_attribute_range_of(p->kind);
        HAIR_FUZZ_CHECK(p->kind == q->kind && (p->strand_values || p->map.source));
        HAIR_FUZZ_CHECK(are_equal_bytes(p->strand_values, q->strand_values, count * sizeof(float)));
        for (size_t k = 0; p->strand_values && k < count; ++k)
            HAIR_FUZZ_CHECK(p->strand_values[k] >= range.min && p->strand_values[k] <= range.max);
        check_equal_maps(a, &p->map, &q->map);
    }
}

// Write a .groom file. Check that the file is read as the same haircut, but for its errors.
static void check_groom(const hair_asset* asset)
{
    const hair_import import = {.scale = 1, .keep_fraction = 1, .seed = 1};
    const struct hair_strands* strands = &asset->strands;
    size_t needed = 0, size = 0, count = strands->strand_count, vertices = asset->scalp_vertex_count;
    HAIR_FUZZ_CHECK(!hair_asset_encode(asset, HAIR_FORMAT_GROOM, NULL, 0, &needed));
    unsigned char* bytes = malloc(needed);
    HAIR_FUZZ_CHECK(bytes && !hair_asset_encode(asset, HAIR_FORMAT_GROOM, bytes, needed, &size));
    HAIR_FUZZ_CHECK(size == needed && hair_asset_find_max_size(bytes, size) == size);
    struct hair_fuzz_host host;
    hair_asset* again = decode(&host, &import, bytes, size);
    HAIR_FUZZ_CHECK(again && again->strands.strand_count == count && again->strand_set == asset->strand_set);
    HAIR_FUZZ_CHECK(!memcmp(again->strands.vertices, strands->vertices, 4 * count));
    check_near(strands, &again->strands);
    HAIR_FUZZ_CHECK(are_equal_bytes(strands->radii, again->strands.radii, 4 * count));
    HAIR_FUZZ_CHECK(are_equal_bytes(strands->groups, again->strands.groups, count));
    for (size_t i = 0; strands->colors && i < 3 * HAIR_STRAND_COLORS * count; ++i)
        HAIR_FUZZ_CHECK(fabsf(again->strands.colors[i] - strands->colors[i]) <= 1.6e-5f);
    HAIR_FUZZ_CHECK(again->scalp_vertex_count == vertices);
    HAIR_FUZZ_CHECK(are_equal_bytes(asset->scalp_positions, again->scalp_positions, 12 * vertices));
    HAIR_FUZZ_CHECK(are_equal_bytes(asset->scalp_triangles, again->scalp_triangles,
                                    12 * (size_t)asset->scalp_triangle_count));
    HAIR_FUZZ_CHECK(are_equal_bytes(asset->scalp_density, again->scalp_density, 4 * vertices));
    HAIR_FUZZ_CHECK(are_equal_bytes(asset->scalp_uvs, again->scalp_uvs, 8 * vertices));
    HAIR_FUZZ_CHECK(are_equal_bytes(asset->scalp_joints, again->scalp_joints, 8 * vertices));
    HAIR_FUZZ_CHECK(are_equal_bytes(asset->scalp_weights, again->scalp_weights, 16 * vertices));
    check_equal_named(asset, again);
    destroy(&host, again);
    free(bytes);
}

// Check that bytes beyond the bound that the beginning gives do not matter.
static void check_max_size(const hair_asset* asset, const hair_import* import, const uint8_t* bytes,
                           size_t size)
{
    uint64_t max = hair_asset_find_max_size(bytes, size);
    if (max >= size) return;
    struct hair_fuzz_host host;
    hair_asset* again = decode(&host, import, bytes, (size_t)max);
    HAIR_FUZZ_CHECK(again && are_equal(&again->strands, &asset->strands));
    destroy(&host, again);
}

// Add an asset to the hash. Colours are rounded, because powf() differs between C libraries.
static void add(uint64_t* hash, const hair_asset* asset)
{
    const struct hair_strands* strands = &asset->strands;
    for (uint32_t i = 0; i < strands->strand_count; ++i) hair_fuzz_add(hash, strands->vertices[i]);
    hair_fuzz_add_floats(hash, strands->positions, 3 * (size_t)strands->vertex_count);
    if (strands->radii) hair_fuzz_add_floats(hash, strands->radii, strands->strand_count);
    for (uint32_t i = 0; strands->groups && i < strands->strand_count; ++i)
        hair_fuzz_add(hash, strands->groups[i]);
    if (asset->scalp_positions)
        hair_fuzz_add_floats(hash, asset->scalp_positions, 3 * (size_t)asset->scalp_vertex_count);
    for (uint32_t i = 0; i < asset->attribute_count; ++i) {
        const hair_strand_attribute* attribute = &asset->attributes[i];
        hair_fuzz_add(hash, (uint32_t)attribute->kind);
        if (attribute->strand_values)
            hair_fuzz_add_floats(hash, attribute->strand_values, strands->strand_count);
        if (attribute->map.values) hair_fuzz_add_floats(hash, attribute->map.values, 1);
    }
    for (size_t i = 0; strands->colors && i < 3 * HAIR_STRAND_COLORS * (size_t)strands->strand_count; ++i)
        hair_fuzz_add(hash, (uint32_t)lrintf(strands->colors[i] * 1000));
}

static bool run(const hair_import* import, const uint8_t* bytes, size_t size, uint64_t* hash)
{
    struct hair_fuzz_host host;
    uint64_t max = hair_asset_find_max_size(bytes, size);
    hair_asset* asset = decode(&host, import, bytes, size);
    HAIR_FUZZ_CHECK(!asset || max);
    if (!asset) return false;
    hair_fuzz_end_refusals();
    check_colors(&asset->strands);
    check_max_size(asset, import, bytes, size);
    check_round_trip(asset, HAIR_FORMAT_HAIR);
    check_round_trip(asset, HAIR_FORMAT_TFX4);
    if (import->scale == 1) check_groom(asset);
    add(hash, asset);
    destroy(&host, asset);
    return true;
}

bool hair_fuzz_asset(const uint8_t* bytes, size_t size, uint64_t* hash)
{
    static const float scales[] = {1, 0.01f, 1e6f, 1e-6f}, fractions[] = {1, 0.5f, 1e-6f, 0.9f};
    static const uint32_t vertices[] = {0, 1, 2, 4, 8, 16, 64, 256};
    const hair_import usual = {.scale = 1, .keep_fraction = 1, .seed = 1};
    uint32_t bits = (uint32_t)(hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size) >> 20);
    const hair_import other = {.scale = scales[bits & 3],
                               .up = (hair_up)(bits >> 2 & 3) == 3 ? HAIR_UP_Y : (hair_up)(bits >> 2 & 3),
                               .tip_first = bits >> 4 & 1,
                               .keep_fraction = fractions[bits >> 5 & 3],
                               .strand_vertices = vertices[bits >> 7 & 7],
                               .seed = bits};
    bool accepted = run(&usual, bytes, size, hash);
    return run(&other, bytes, size, hash) || accepted;
}
