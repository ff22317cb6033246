// maps.c - density and thickness of hair, read from maps on the scalp.
#include "lib/groom/draft.h"

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

static hair_result check_map(const struct hair_draft* draft, uint32_t set, const char* name,
                             const hair_map* map, float most)
{
    const hair_host* host = draft->host;
    const hair_groom_desc* desc = draft->desc;
    if ((uint32_t)map->source > HAIR_MAP_SOURCE_TRIANGLES)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.map_sets[%u]->%s.source is %d, not in [0, %d]", set, name,
                         (int)map->source, HAIR_MAP_SOURCE_TRIANGLES);
    if (map->source == HAIR_MAP_SOURCE_NONE) return HAIR_OK;
    if (!map->values)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.map_sets[%u]->%s.values is NULL", set,
                         name);
    if (map->source == HAIR_MAP_SOURCE_IMAGE) {
        if (map->width - 1 >= LARGEST || map->height - 1 >= LARGEST)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.map_sets[%u]->%s is an image of %u by %u, not of [1, %u] each",
                             set, name, map->width, map->height, LARGEST);
        if (!desc->scalp_uvs)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_uvs is NULL but map_sets[%u]->%s is an image", set, name);
    }
    uint64_t count = count_values(desc, map);
    for (uint64_t i = 0; i < count; ++i)
        if (!(map->values[i] >= 0 && map->values[i] <= most)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.map_sets[%u]->%s.values[%llu] is %g, not in [0, %g]", set, name,
                             (unsigned long long)i, (double)map->values[i], (double)most);
    return HAIR_OK;
}

static hair_result check_maps(const struct hair_draft* draft, uint32_t sets)
{
    const hair_groom_desc* desc = draft->desc;
    hair_result result = HAIR_OK;
    for (uint32_t i = 0; i < sets && !result; ++i) {
        result = check_map(draft, i, "density", &desc->map_sets[i]->density, 1);
        if (!result) result = check_map(draft, i, "thickness", &desc->map_sets[i]->thickness, THICKEST);
    }
    for (size_t i = 0; desc->scalp_uvs && i < 2 * (size_t)desc->scalp_vertex_count && !result; ++i)
        if (!(fabsf(desc->scalp_uvs[i]) <= 1e6f))
            result = hair_fail(draft->host, HAIR_ERROR_ARGUMENT,
                               "hair_groom_desc.scalp_uvs: vertex %zu has %g, not in [-1e6, 1e6]", i / 2,
                               (double)desc->scalp_uvs[i]);
    return result;
}

// Find the values before and after a coordinate along a side. `share` is the weight of the second
// value.
static void find_between(float uv, uint32_t size, uint32_t at[2], float* share)
{
    // Values are at the texel centres.
    float place = fminf(fmaxf(uv * (float)size - 0.5f, 0), (float)(size - 1));
    at[0] = (uint32_t)place;
    HAIR_ASSERT(at[0] < size);
    at[1] = at[0] + 1 < size ? at[0] + 1 : at[0];
    *share = place - (float)at[0];
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

static float value_at(const struct hair_draft* draft, const hair_map* map, const struct hair_spot* spot)
{
    const hair_groom_desc* desc = draft->desc;
    HAIR_ASSERT(spot->triangle < desc->scalp_triangle_count);
    const uint32_t* corner = desc->scalp_triangles + 3 * (size_t)spot->triangle;
    if (map->source == HAIR_MAP_SOURCE_NONE) return 1;
    if (map->source == HAIR_MAP_SOURCE_TRIANGLES) return map->values[spot->triangle];
    float sum[2] = {0};
    for (int i = 0; i < 3; ++i) {
        const float* values = map->source == HAIR_MAP_SOURCE_IMAGE ? desc->scalp_uvs + 2 * (size_t)corner[i]
                                                                   : map->values + corner[i];
        sum[0] += spot->weight[i] * values[0];
        if (map->source == HAIR_MAP_SOURCE_IMAGE) sum[1] += spot->weight[i] * values[1];
    }
    return map->source == HAIR_MAP_SOURCE_IMAGE ? look_up(map, sum[0], sum[1]) : sum[0];
}

// Read all maps at a candidate. The last set stands for all missing sets.
static void read_maps(struct hair_draft* draft, uint32_t sets, uint32_t sprout)
{
    HAIR_ASSERT(0 < sets && sets <= HAIR_MAP_SETS && sprout < draft->sprout_count);
    const struct hair_spot* spot = &draft->spots[sprout];
    float density[HAIR_MAP_SETS], thickness[HAIR_MAP_SETS], most = 0;
    for (uint32_t i = 0; i < HAIR_MAP_SETS; ++i) {
        const hair_map_set* set = draft->desc->map_sets[i < sets ? i : sets - 1];
        density[i] = fminf(fmaxf(value_at(draft, &set->density, spot), 0), 1); // Correct rounding.
        thickness[i] = fmaxf(value_at(draft, &set->thickness, spot), 0);
        most = fmaxf(most, thickness[i]);
    }
    for (uint32_t i = 0; i < HAIR_MAP_SETS; ++i) thickness[i] = most > 0 ? thickness[i] / most : 1;
    for (int i = 0; i < HAIR_MAP_SETS; ++i) HAIR_ASSERT(thickness[i] >= 0 && thickness[i] <= 1);
    draft->map_density[sprout] = (hair_vec4){density[0], density[1], density[2], density[3]};
    draft->map_share[sprout] = (hair_vec4){thickness[0], thickness[1], thickness[2], thickness[3]};
    draft->map_thickness[sprout] = most;
}

hair_result hair_draft_maps(struct hair_draft* draft)
{
    uint32_t sets = count_sets(draft->desc);
    uint32_t count = draft->sprout_count;
    draft->groom->map_sets = sets;
    if (sets == 0) return HAIR_OK;
    hair_result result = check_maps(draft, sets);
    if (result) return result;
    if (!draft->spots)
        return hair_fail(draft->host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.scalp_triangles: none of %u has three different corners",
                         draft->desc->scalp_triangle_count);
    draft->map_density = hair_alloc(draft->host, count, sizeof *draft->map_density);
    draft->map_thickness = hair_alloc(draft->host, count, sizeof *draft->map_thickness);
    draft->map_share = hair_alloc(draft->host, count, sizeof *draft->map_share);
    if (!draft->map_density || !draft->map_thickness || !draft->map_share)
        return hair_fail_memory(draft->host, "the maps of followers");
    for (uint32_t i = 0; i < count; ++i) read_maps(draft, sets, i);
    return HAIR_OK;
}

void hair_thicken(struct hair_draft* draft)
{
    for (uint32_t i = 0; draft->map_thickness && i < draft->sprout_count; ++i)
        draft->groom->followers[draft->place[i]].offset[0].w *= draft->map_thickness[i];
}
