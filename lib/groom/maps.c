// maps.c - density and thickness of hair, read from maps on the scalp.
#include "lib/groom/groom_builder.h"

#include <stdio.h>

// Maximum number of values along a side of an image.
#define LARGEST 16384u
// Maximum value of a thickness map.
#define THICKEST 4.0f

static uint32_t count_sets(const hair_groom_desc* desc)
{
    uint32_t count = 0;
    while (count < HAIR_MAP_SETS && desc->map_sets[count]) ++count;
    return count;
}

static uint64_t count_values(const hair_groom_desc* desc, const hair_map* map)
{
    switch (map->source) {
    case HAIR_MAP_SOURCE_NONE: break;
    case HAIR_MAP_SOURCE_IMAGE: return (uint64_t)map->width * map->height;
    case HAIR_MAP_SOURCE_VERTICES: return desc->scalp_vertex_count;
    case HAIR_MAP_SOURCE_TRIANGLES: return desc->scalp_triangle_count;
    }
    return 0;
}

hair_result hair_check_map(const struct hair_groom_builder* builder, const char* name, const hair_map* map,
                           float min, float max)
{
    const hair_host* host = builder->host;
    const hair_groom_desc* desc = builder->desc;
    HAIR_ASSERT((uint32_t)map->source <= HAIR_MAP_SOURCE_TRIANGLES);
    if (map->source == HAIR_MAP_SOURCE_NONE) return HAIR_OK;
    if (!map->values) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.%s.values is NULL", name);
    if (map->source == HAIR_MAP_SOURCE_IMAGE) {
        if (map->width - 1 >= LARGEST || map->height - 1 >= LARGEST)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.%s is an image of %u by %u, not of [1, %u] each", name,
                             map->width, map->height, LARGEST);
        if (!desc->scalp_uvs)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_uvs is NULL but %s is an image", name);
    }
    uint64_t count = count_values(desc, map);
    for (uint64_t i = 0; i < count; ++i)
        if (!(map->values[i] >= min && map->values[i] <= max)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.%s.values[%llu] is %g, not in [%g, %g]", name,
                             (unsigned long long)i, (double)map->values[i], (double)min, (double)max);
    return HAIR_OK;
}

hair_result hair_check_uvs(const struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    for (size_t i = 0; desc->scalp_uvs && i < 2 * (size_t)desc->scalp_vertex_count; ++i)
        if (!(fabsf(desc->scalp_uvs[i]) <= 1e6f))
            return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_uvs: vertex %zu has %g, not in [-1e6, 1e6]", i / 2,
                             (double)desc->scalp_uvs[i]);
    return HAIR_OK;
}

static hair_result check_maps(const struct hair_groom_builder* builder, uint32_t sets)
{
    const hair_groom_desc* desc = builder->desc;
    for (uint32_t i = 0; i < sets; ++i) {
        char name[48];
        snprintf(name, sizeof name, "map_sets[%u].density", i);
        HAIR_TRY(hair_check_map(builder, name, &desc->map_sets[i]->density, 0, 1));
        snprintf(name, sizeof name, "map_sets[%u].thickness", i);
        HAIR_TRY(hair_check_map(builder, name, &desc->map_sets[i]->thickness, 0, THICKEST));
    }
    return hair_check_uvs(builder);
}

// Find the values before and after a coordinate along a side. `fraction` is the weight of the
// second value.
static void find_between(float uv, uint32_t size, uint32_t at[2], float* fraction)
{
    // Values are at the texel centres.
    float place = fminf(fmaxf(uv * (float)size - 0.5f, 0), (float)(size - 1));
    at[0] = (uint32_t)place;
    HAIR_ASSERT(at[0] < size);
    at[1] = at[0] + 1 < size ? at[0] + 1 : at[0];
    *fraction = place - (float)at[0];
}

static float look_up(const hair_map* map, float u, float v)
{
    uint32_t x[2], y[2];
    float right, down, row[2];
    find_between(u, map->width, x, &right);
    find_between(v, map->height, y, &down);
    for (int i = 0; i < 2; ++i) {
        const float* values = map->values + (size_t)y[i] * map->width;
        row[i] = (1 - right) * values[x[0]] + right * values[x[1]];
    }
    return (1 - down) * row[0] + down * row[1];
}

float hair_map_value(const struct hair_groom_builder* builder, const hair_map* map,
                     const struct hair_scalp_point* scalp_point)
{
    const hair_groom_desc* desc = builder->desc;
    if (map->source == HAIR_MAP_SOURCE_NONE) return 1;
    HAIR_ASSERT(scalp_point->triangle < desc->scalp_triangle_count);
    const uint32_t* corner = desc->scalp_triangles + 3 * (size_t)scalp_point->triangle;
    if (map->source == HAIR_MAP_SOURCE_TRIANGLES) return map->values[scalp_point->triangle];
    float sum[2] = {0};
    for (int i = 0; i < 3; ++i) {
        const float* values = map->source == HAIR_MAP_SOURCE_IMAGE ? desc->scalp_uvs + 2 * (size_t)corner[i]
                                                                   : map->values + corner[i];
        sum[0] += scalp_point->weight[i] * values[0];
        if (map->source == HAIR_MAP_SOURCE_IMAGE) sum[1] += scalp_point->weight[i] * values[1];
    }
    return map->source == HAIR_MAP_SOURCE_IMAGE ? look_up(map, sum[0], sum[1]) : sum[0];
}

// Read all maps at a candidate. The last set stands for all missing sets.
static void read_maps(struct hair_groom_builder* builder, uint32_t sets, uint32_t candidate)
{
    HAIR_ASSERT(0 < sets && sets <= HAIR_MAP_SETS && candidate < builder->candidate_count);
    const struct hair_scalp_point* scalp_point = &builder->scalp_points[candidate];
    float density[HAIR_MAP_SETS], thickness[HAIR_MAP_SETS], max = 0;
    for (uint32_t i = 0; i < HAIR_MAP_SETS; ++i) {
        const hair_map_set* set = builder->desc->map_sets[i < sets ? i : sets - 1];
        // Correct rounding.
        density[i] = fminf(fmaxf(hair_map_value(builder, &set->density, scalp_point), 0), 1);
        thickness[i] = fmaxf(hair_map_value(builder, &set->thickness, scalp_point), 0);
        max = fmaxf(max, thickness[i]);
    }
    for (uint32_t i = 0; i < HAIR_MAP_SETS; ++i) thickness[i] = max > 0 ? thickness[i] / max : 1;
    for (int i = 0; i < HAIR_MAP_SETS; ++i) HAIR_ASSERT(thickness[i] >= 0 && thickness[i] <= 1);
    builder->map_density[candidate] = (hair_vec4){density[0], density[1], density[2], density[3]};
    builder->map_fraction[candidate] = (hair_vec4){thickness[0], thickness[1], thickness[2], thickness[3]};
    builder->map_thickness[candidate] = max;
}

hair_result hair_fail_degenerate(const struct hair_groom_builder* builder)
{
    return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                     "hair_groom_desc.scalp_triangles: none of %u has three different corners",
                     builder->desc->scalp_triangle_count);
}

hair_result hair_build_maps(struct hair_groom_builder* builder)
{
    uint32_t sets = count_sets(builder->desc);
    uint32_t count = builder->candidate_count;
    builder->groom->map_sets = sets;
    if (sets == 0) return HAIR_OK;
    HAIR_TRY(check_maps(builder, sets));
    if (!builder->scalp_points) return hair_fail_degenerate(builder);
    builder->map_density = hair_alloc(builder->host, count, sizeof *builder->map_density);
    builder->map_thickness = hair_alloc(builder->host, count, sizeof *builder->map_thickness);
    builder->map_fraction = hair_alloc(builder->host, count, sizeof *builder->map_fraction);
    if (!builder->map_density || !builder->map_thickness || !builder->map_fraction)
        return hair_fail_memory(builder->host, "the maps of followers");
    for (uint32_t i = 0; i < count; ++i) read_maps(builder, sets, i);
    return HAIR_OK;
}

void hair_apply_thickness(struct hair_groom_builder* builder)
{
    for (uint32_t i = 0; builder->map_thickness && i < builder->candidate_count; ++i)
        builder->groom->followers[builder->place[i]].offset[0].w *= builder->map_thickness[i];
}
