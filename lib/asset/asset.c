// asset.c - conversion from bytes of any format to a clean haircut, and back.
#include "lib/asset/formats.h"

#define MAX_STRANDS 4194304 // Maximum, as of hair_groom_desc.strand_count.

// Formats, in the order in which the first bytes are tried. Those without `encode` are read only.
static const struct format {
    hair_format format;
    bool (*is)(const unsigned char* bytes, size_t size);
    uint64_t (*max_size)(const unsigned char* bytes, size_t size);
    hair_result (*decode)(const struct hair_source* source, hair_asset* asset);
    hair_result (*measure)(const hair_asset* asset, size_t* size);
    void (*encode)(const hair_asset* asset, unsigned char* bytes);
} formats[] = {
    {HAIR_FORMAT_HAIR, hair_is_hairfile, hair_max_size_of_hairfile, hair_decode_hairfile, hair_size_hairfile,
     hair_encode_hairfile},
    {HAIR_FORMAT_GROOM, hair_is_groomfile, hair_max_size_of_groomfile, hair_decode_groomfile,
     hair_size_groomfile, hair_encode_groomfile},
    {HAIR_FORMAT_TFX4, hair_is_tfx4, hair_max_size_of_tfx4, hair_decode_tfx4, hair_size_tfx4,
     hair_encode_tfx4},
    {HAIR_FORMAT_TFX3, hair_is_tfx3, hair_max_size_of_tfx3, hair_decode_tfx3, NULL, NULL},
    {HAIR_FORMAT_TFX2, hair_is_tfx_text, hair_max_size_of_tfx_text, hair_decode_tfx_text, NULL, NULL},
};
#define FORMATS (sizeof formats / sizeof *formats)

static hair_result refuse(const struct hair_source* source)
{
    if (source->size == 0)
        return hair_fail(source->host, HAIR_ERROR_FILE, "the file ends at byte 0: it is empty");
    return hair_fail(
        source->host, HAIR_ERROR_FILE,
        "at byte 0 stands none of \"HAIR\", \"GROOM\" and a version of .tfx that can be read (3, 4, or 2 as "
        "text)");
}

uint64_t hair_asset_find_max_size(const void* bytes, size_t size)
{
    for (size_t i = 0; i < FORMATS; ++i) {
        if (formats[i].is(bytes, size)) return formats[i].max_size(bytes, size);
    }
    return 0;
}

static hair_result decode_raw(const struct hair_source* source, hair_asset* asset)
{
    for (size_t i = 0; i < FORMATS; ++i) {
        if (!formats[i].is(source->bytes, source->size)) continue;
        asset->format = formats[i].format;
        return formats[i].decode(source, asset);
    }
    return refuse(source);
}

static hair_result check_cleaned(const struct hair_source* source, const hair_asset* asset)
{
    const hair_import_stats* repairs = &asset->repairs;
    if (asset->strands.strand_count == 0)
        return hair_fail(
            source->host, HAIR_ERROR_FILE,
            "none of the %u strands between byte 0 and byte %zu can be used: %u have fewer than two "
            "good vertices, %u are shorter than 10 micrometres",
            asset->file_strands, source->size, repairs->dropped_single, repairs->dropped_short);
    if (asset->strands.strand_count > MAX_STRANDS)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "%u strands are left between byte 0 and byte %zu, more than %u: keep fewer by "
                         "hair_import.keep_fraction",
                         asset->strands.strand_count, source->size, MAX_STRANDS);
    return HAIR_OK;
}

static hair_result decode(const struct hair_source* source, hair_asset* asset)
{
    HAIR_TRY(decode_raw(source, asset));
    asset->file_strands = asset->strands.strand_count;
    asset->file_vertices = asset->strands.vertex_count;
    const hair_tasks tasks = {0};
    HAIR_TRY(hair_strands_clean(source->host, &tasks, source->import, &asset->strands, &asset->repairs));
    hair_asset_link_factors(asset);
    return check_cleaned(source, asset);
}

hair_result hair_asset_decode(const hair_host* host, const hair_import* import, const void* bytes,
                              size_t size, hair_asset** out)
{
    hair_asset* asset = hair_alloc(host, 1, sizeof *asset);
    if (!asset) return hair_fail_memory(host, "hair_asset");
    asset->host = *host;

    struct hair_source source = {host, import, bytes, size};
    hair_result result = decode(&source, asset);
    if (result)
        hair_asset_free(asset);
    else
        *out = asset;
    return result;
}

hair_result hair_asset_encode(const hair_asset* asset, hair_format format, void* bytes, size_t capacity,
                              size_t* size)
{
    const struct format* found = NULL;
    for (size_t i = 0; i < FORMATS; ++i)
        if (formats[i].format == format && formats[i].encode) found = &formats[i];
    if (!found)
        return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "format is %u, which cannot be written",
                         (unsigned)format);
    size_t needed;
    HAIR_TRY(found->measure(asset, &needed));
    *size = needed;
    if (bytes && capacity >= needed) found->encode(asset, bytes);
    return HAIR_OK;
}

// Free the values of a map, which belong to the asset.
static void free_map(const hair_host* host, const hair_map* map)
{
    hair_free(host, (void*)(uintptr_t)map->values);
}

void hair_asset_free(hair_asset* asset)
{
    if (!asset) return;
    hair_host host = asset->host;
    hair_strands_free(&host, &asset->strands);
    hair_free(&host, asset->scalp_positions);
    hair_free(&host, asset->scalp_triangles);
    hair_free(&host, asset->scalp_density);
    hair_free(&host, asset->scalp_uvs);
    hair_free(&host, asset->scalp_joints);
    hair_free(&host, asset->scalp_weights);
    hair_free(&host, asset->joint_names);
    for (uint32_t i = 0; i < asset->map_set_count; ++i) {
        free_map(&host, &asset->map_sets[i].density);
        free_map(&host, &asset->map_sets[i].thickness);
    }
    for (uint32_t i = 0; i < asset->attribute_count; ++i) free_map(&host, &asset->attributes[i].map);
    hair_free(&host, asset);
}
