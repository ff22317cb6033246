// maps.c - maps on the scalp from the arrays of an application: checked, and copied into assets.
#include "lib/asset/arrays.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

uint64_t hair_map_count_values(const hair_map* map, uint32_t vertices, uint32_t triangles)
{
    switch (map->source) {
    case HAIR_MAP_SOURCE_NONE: break;
    case HAIR_MAP_SOURCE_IMAGE: return (uint64_t)map->width * map->height;
    case HAIR_MAP_SOURCE_VERTICES: return vertices;
    case HAIR_MAP_SOURCE_TRIANGLES: return triangles;
    }
    return 0;
}

static uint64_t count_values(const hair_groom_desc* desc, const hair_map* map)
{
    return hair_map_count_values(map, desc->scalp_vertex_count, desc->scalp_triangle_count);
}

// Checks ------------------------------------------------------------------------------------------

// Check a map, whose name in hair_groom_desc is `name`.
static hair_result check_map(const hair_host* host, const hair_groom_desc* desc, const char* name,
                             const hair_map* map, struct hair_attribute_range range)
{
    HAIR_ASSERT((uint32_t)map->source <= HAIR_MAP_SOURCE_TRIANGLES);
    if (map->source == HAIR_MAP_SOURCE_NONE) return HAIR_OK;
    if (!map->values) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.%s.values is NULL", name);
    if (map->source == HAIR_MAP_SOURCE_IMAGE) {
        if (map->width - 1 >= HAIR_MAX_MAP_SIDE || map->height - 1 >= HAIR_MAX_MAP_SIDE)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.%s is an image of %u by %u, not of [1, %u] each", name,
                             map->width, map->height, HAIR_MAX_MAP_SIDE);
        if (!desc->scalp_uvs)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_uvs is NULL but %s is an image", name);
    }
    uint64_t count = count_values(desc, map);
    for (uint64_t i = 0; i < count; ++i)
        if (!(map->values[i] >= range.min && map->values[i] <= range.max)) // NaN fails too.
            return hair_fail(
                host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.%s.values[%llu] is %g, not in [%g, %g]", name,
                (unsigned long long)i, (double)map->values[i], (double)range.min, (double)range.max);
    return HAIR_OK;
}

hair_result hair_check_uvs(const hair_host* host, const hair_groom_desc* desc)
{
    for (size_t i = 0; desc->scalp_uvs && i < 2 * (size_t)desc->scalp_vertex_count; ++i)
        if (!(fabsf(desc->scalp_uvs[i]) <= 1e6f))
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_uvs: vertex %zu has %g, not in [-1e6, 1e6]", i / 2,
                             (double)desc->scalp_uvs[i]);
    return HAIR_OK;
}

struct hair_attribute_range hair_map_range_of(int thickness)
{
    return (struct hair_attribute_range){0, thickness ? HAIR_MAX_MAP_THICKNESS : 1};
}

uint32_t hair_count_map_sets(const hair_groom_desc* desc)
{
    uint32_t count = 0;
    while (count < HAIR_MAP_SETS && desc->map_sets[count]) ++count;
    return count;
}

hair_result hair_check_map_sets(const hair_host* host, const hair_groom_desc* desc)
{
    for (uint32_t i = 0; i < hair_count_map_sets(desc); ++i) {
        char name[48];
        snprintf(name, sizeof name, "map_sets[%u].density", i);
        HAIR_TRY(check_map(host, desc, name, &desc->map_sets[i]->density, hair_map_range_of(0)));
        snprintf(name, sizeof name, "map_sets[%u].thickness", i);
        HAIR_TRY(check_map(host, desc, name, &desc->map_sets[i]->thickness, hair_map_range_of(1)));
    }
    return hair_check_uvs(host, desc);
}

hair_result hair_check_attribute_maps(const hair_host* host, const hair_groom_desc* desc)
{
    bool has_maps = false;
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i) {
        const hair_strand_attribute* attribute = &desc->strand_attributes[i];
        char name[48];
        snprintf(name, sizeof name, "strand_attributes[%u].map", i);
        has_maps |= attribute->map.source != HAIR_MAP_SOURCE_NONE;
        HAIR_TRY(check_map(host, desc, name, &attribute->map, hair_attribute_range_of(attribute->kind)));
    }
    return has_maps ? hair_check_uvs(host, desc) : HAIR_OK;
}

// Assets ------------------------------------------------------------------------------------------

static hair_result copy_map(const hair_groom_desc* desc, const hair_map* map, hair_asset* asset,
                            hair_map* out)
{
    size_t count = (size_t)count_values(desc, map);
    if (!count) return HAIR_OK;
    float* values = hair_alloc(&asset->host, count, sizeof *values);
    if (!values) return hair_fail_memory(&asset->host, "the maps of the scalp");
    memcpy(values, map->values, count * sizeof *values);
    *out = (hair_map){map->source, values, map->width, map->height};
    return HAIR_OK;
}

hair_result hair_asset_copy_maps(const hair_groom_desc* desc, hair_asset* asset)
{
    HAIR_TRY(hair_check_map_sets(&asset->host, desc));
    HAIR_TRY(hair_check_attribute_maps(&asset->host, desc));
    for (uint32_t i = 0; i < hair_count_map_sets(desc); ++i) {
        hair_map_set* set = &asset->map_sets[asset->map_set_count++];
        *set = hair_map_set_default();
        HAIR_TRY(copy_map(desc, &desc->map_sets[i]->density, asset, &set->density));
        HAIR_TRY(copy_map(desc, &desc->map_sets[i]->thickness, asset, &set->thickness));
    }
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i) {
        const hair_strand_attribute* attribute = &desc->strand_attributes[i];
        if (attribute->map.source == HAIR_MAP_SOURCE_NONE) continue;
        hair_strand_attribute* own = hair_asset_add_attribute(asset, attribute->kind);
        HAIR_TRY(copy_map(desc, &attribute->map, asset, &own->map));
    }
    return HAIR_OK;
}
