// maps.c - density and thickness of hair, read from maps on the scalp.
#include "lib/asset/arrays.h"
#include "lib/groom/groom_builder.h"

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
    uint32_t sets = hair_count_map_sets(builder->desc);
    uint32_t count = builder->candidate_count;
    builder->groom->map_sets = sets;
    if (sets == 0) return HAIR_OK;
    HAIR_TRY(hair_check_map_sets(builder->host, builder->desc));
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
