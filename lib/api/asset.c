// asset.c - public calls on haircuts as plain arrays.
#include "lib/api/api.h"
#include "lib/asset/arrays.h"
#include "lib/groom/style.h"

hair_result hair_asset_read(const hair_asset_desc* desc, const void* bytes, size_t size, hair_asset** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    hair_asset_desc own;
    hair_import import;
    HAIR_TRY(HAIR_COPY_IN(&host, hair_asset_desc, desc, &own));
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(&host, hair_import, own.import, &import));
    if (!bytes) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "bytes is NULL");
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    return hair_asset_decode(&host, &import, bytes, size, out);
}

static hair_result check_skin_pointers(const hair_host* host, const hair_groom_desc* desc,
                                       const struct hair_skin_arrays* skin)
{
    if (!skin->joints) {
        if (!skin->weights && !skin->joint_count && !skin->joint_names) return HAIR_OK;
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "scalp_joints is NULL but %s is not",
                         skin->joint_names ? "scalp_joint_names" : "scalp_weights or scalp_joint_count");
    }
    if (!skin->weights) return hair_fail(host, HAIR_ERROR_ARGUMENT, "scalp_weights is NULL");
    if (!desc->scalp_positions)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.scalp_positions is NULL but scalp_joints is not");
    if (skin->joint_count - 1 < 65536) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "scalp_joint_count is %u, not in [1, 65536]",
                     skin->joint_count);
}

hair_result hair_asset_create(const hair_groom_desc* desc, const uint16_t* scalp_joints,
                              const float* scalp_weights, uint32_t scalp_joint_count,
                              const char* scalp_joint_names, hair_asset** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    const struct hair_skin_arrays skin = {scalp_joints, scalp_weights, scalp_joint_count, scalp_joint_names};
    hair_groom_desc own;
    hair_import import;
    hair_map_set maps[HAIR_MAP_SETS];
    hair_strand_attribute attributes[HAIR_MAX_ATTRIBUTES];
    HAIR_TRY(HAIR_COPY_IN(&host, hair_groom_desc, desc, &own));
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(&host, hair_import, own.import, &import));
    HAIR_TRY(hair_check_groom_arrays(&host, &own));
    HAIR_TRY(hair_copy_map_sets(&host, &own, maps));
    HAIR_TRY(hair_copy_attributes(&host, &own, attributes));
    HAIR_TRY(check_skin_pointers(&host, &own, &skin));
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    return hair_asset_from_arrays(&host, &own, &import, &skin, out);
}

uint64_t hair_asset_max_size(const void* bytes, size_t size)
{
    return bytes ? hair_asset_find_max_size(bytes, size) : 0;
}

void hair_asset_destroy(hair_asset* asset)
{
    if (asset) hair_asset_free(asset);
}

hair_result hair_asset_write(const hair_asset* asset, hair_format format, void* bytes, size_t capacity,
                             size_t* size)
{
    if (!asset) return HAIR_ERROR_ARGUMENT;
    if (!size) return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "size is NULL");
    if (!bytes && capacity)
        return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "bytes is NULL but capacity is %zu", capacity);
    return hair_asset_encode(asset, format, bytes, capacity, size);
}

hair_result hair_asset_generate(const hair_style_desc* desc, hair_asset** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    hair_style_desc own;
    HAIR_TRY(HAIR_COPY_IN(&host, hair_style_desc, desc, &own));
    if (own.strand_vertices == 1)
        return hair_fail(&host, HAIR_ERROR_ARGUMENT,
                         "hair_style_desc.strand_vertices is 1, not 0 or in [2, 256]");
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    return hair_style_build(&host, &own, out);
}

const char* hair_style_name(hair_style style)
{
    switch (style) {
    case HAIR_STYLE_LONG: return "long";
    case HAIR_STYLE_BOB: return "bob";
    case HAIR_STYLE_SHORT: return "short";
    case HAIR_STYLE_PONYTAIL: return "ponytail";
    case HAIR_STYLE_CURLY: return "curly";
    case HAIR_STYLE_AFRO: return "afro";
    case HAIR_STYLE_FRINGE: return "fringe";
    case HAIR_STYLE_FADE: return "fade";
    case HAIR_STYLE_BUN: return "bun";
    case HAIR_STYLE_BRAID: return "braid";
    case HAIR_STYLE_COUNT: break;
    }
    return NULL;
}

const char* hair_format_name(hair_format format)
{
    switch (format) {
    case HAIR_FORMAT_NONE: return "none";
    case HAIR_FORMAT_HAIR: return "hair";
    case HAIR_FORMAT_TFX4: return "tfx4";
    case HAIR_FORMAT_TFX3: return "tfx3";
    case HAIR_FORMAT_TFX2: return "tfx2";
    case HAIR_FORMAT_GROOM: return "groom";
    }
    return NULL;
}

// Compute lengths and bounds of the strands.
static void measure_strands(const struct hair_strands* strands, hair_asset_info* info)
{
    double sum = 0;
    const float* at = strands->positions;
    for (uint32_t s = 0; s < strands->strand_count; ++s) {
        uint32_t count = strands->vertices[s];
        double length = 0;
        for (uint32_t v = 0; v < count; ++v, at += 3) {
            if (v) length += (double)hair_distance(hair_load3(at), hair_load3(at - 3));
            for (int k = 0; k < 3; ++k) {
                int first = s == 0 && v == 0;
                info->lower[k] = first ? at[k] : fminf(info->lower[k], at[k]);
                info->upper[k] = first ? at[k] : fmaxf(info->upper[k], at[k]);
            }
        }
        sum += length;
        info->length[0] = s ? fminf(info->length[0], (float)length) : (float)length;
        info->length[2] = fmaxf(info->length[2], (float)length);
        info->min_vertices = s && info->min_vertices < count ? info->min_vertices : count;
        info->max_vertices = info->max_vertices > count ? info->max_vertices : count;
    }
    HAIR_ASSERT(at == strands->positions + 3 * (size_t)strands->vertex_count);
    if (strands->strand_count) info->length[1] = (float)(sum / strands->strand_count);
}

hair_result hair_asset_describe(const hair_asset* asset, hair_asset_info* out)
{
    if (!asset) return HAIR_ERROR_ARGUMENT;
    hair_asset_info info = {
        .format = asset->format,
        .strand_set = asset->strand_set,
        .strand_count = asset->strands.strand_count,
        .vertex_count = asset->strands.vertex_count,
        .file_strands = asset->file_strands,
        .file_vertices = asset->file_vertices,
        .import_stats = asset->repairs,
        .positions = asset->strands.positions,
        .strand_vertices = asset->strands.vertices,
        .strand_radii = asset->strands.radii,
        .scalp_positions = asset->scalp_positions,
        .scalp_triangles = asset->scalp_triangles,
        .scalp_vertex_count = asset->scalp_vertex_count,
        .scalp_triangle_count = asset->scalp_triangle_count,
        .strand_colors = asset->strands.colors,
        .strand_groups = asset->strands.groups,
        .scalp_density = asset->scalp_density,
        .scalp_uvs = asset->scalp_uvs,
        .scalp_joints = asset->scalp_joints,
        .scalp_weights = asset->scalp_weights,
        .scalp_joint_count = asset->scalp_joint_count,
        .strand_attributes = asset->attribute_count ? asset->attributes : NULL,
        .strand_attribute_count = asset->attribute_count,
        .strand_guides = asset->strands.guides,
        .scalp_joint_names = asset->joint_names,
    };
    for (uint32_t i = 0; i < asset->map_set_count; ++i) info.map_sets[i] = &asset->map_sets[i];
    measure_strands(&asset->strands, &info);
    return HAIR_COPY_OUT(&asset->host, hair_asset_info, &info, out);
}

// True if a desc, which may be that of an older caller, has a member.
#define HAS(desc, member) ((desc)->header.size >= offsetof(hair_groom_desc, member) + sizeof(desc)->member)

hair_result hair_asset_to_groom_desc(const hair_asset* asset, hair_groom_desc* desc)
{
    if (!asset) return HAIR_ERROR_ARGUMENT;
    if (!desc) return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "hair_groom_desc is NULL");
    HAIR_TRY(hair_check_header(&asset->host, "hair_groom_desc", desc->header));
    desc->positions = asset->strands.positions;
    desc->strand_vertices = asset->strands.vertices;
    desc->strand_count = asset->strands.strand_count;
    desc->strand_set = asset->strand_set;
    desc->scalp_positions = asset->scalp_positions;
    desc->scalp_triangles = asset->scalp_triangles;
    desc->scalp_vertex_count = asset->scalp_vertex_count;
    desc->scalp_triangle_count = asset->scalp_triangle_count;
    desc->strand_radii = asset->strands.radii;
    desc->colors = asset->strands.colors;
    desc->color_count = HAIR_STRAND_COLORS;
    if (HAS(desc, strand_groups)) desc->strand_groups = asset->strands.groups;
    if (HAS(desc, strand_guides) && asset->strands.guides) desc->strand_guides = asset->strands.guides;
    if (asset->scalp_density) desc->scalp_density = asset->scalp_density;
    if (asset->scalp_uvs) desc->scalp_uvs = asset->scalp_uvs;
    for (uint32_t i = 0; asset->map_set_count && i < HAIR_MAP_SETS; ++i)
        desc->map_sets[i] = i < asset->map_set_count ? &asset->map_sets[i] : NULL;
    if (asset->attribute_count && HAS(desc, strand_attribute_count)) {
        desc->strand_attributes = asset->attributes;
        desc->strand_attribute_count = asset->attribute_count;
    }
    return HAIR_OK;
}
