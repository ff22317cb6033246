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
    // The bound of hair_asset.h.
    size_t asked = (size_t)12 * 256 * (size / 2 + 1);
    HAIR_FUZZ_CHECK(host->peak <= ((size_t)64 << 20) + 4 * size + (import->strand_vertices ? asked : 0));
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
