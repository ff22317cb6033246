// density_order.c - patches and density order of followers where there are maps.
//
// Let L be the requested fraction of the hair. Let a patch have n followers in a random order, and
// let d be the density at the root of follower k. The follower is drawn as soon as L d n > k, which
// holds from L = k / (n d) on. Followers are therefore sorted by k / d. Cutting off the end then
// leaves every place the density that it should have, at every L. The density d is the mean of all
// sets, so blending sets does not change the order of strands.
#include "lib/groom/groom_builder.h"

#include <float.h>

// Maximum range of densities in a patch.
#define DENSITIES 0.25f
// Maximum range of relative thicknesses in a patch.
#define SHARES 0.125f

#define VALUES (2 * HAIR_MAP_SETS)

static float value_of(const struct hair_groom_builder* builder, uint32_t candidate, uint32_t which)
{
    HAIR_ASSERT(candidate < builder->candidate_count && which < VALUES);
    const hair_vec4* v =
        which < HAIR_MAP_SETS ? &builder->map_density[candidate] : &builder->map_fraction[candidate];
    switch (which % HAIR_MAP_SETS) {
    case 0: return v->x;
    case 1: return v->y;
    case 2: return v->z;
    }
    return v->w;
}

// Return the value of map component `which` at which to split. `excess` receives the range relative
// to its limit. Candidates without hair get patches of their own.
static float find_cut(const struct hair_groom_builder* builder, const uint32_t* queue, uint32_t count,
                      uint32_t which, float* excess)
{
    float min = FLT_MAX, max = 0, limit = which < HAIR_MAP_SETS ? DENSITIES : SHARES;
    for (uint32_t i = 0; i < count; ++i) {
        float value = value_of(builder, queue[i], which);
        min = fminf(min, value);
        max = fmaxf(max, value);
    }
    *excess = (max - min) / limit;
    if (which < HAIR_MAP_SETS && min == 0 && max > 0) {
        *excess = FLT_MAX;
        return 0;
    }
    return 0.5f * (min + max);
}

uint32_t hair_map_split(const struct hair_groom_builder* builder, uint32_t* queue, uint32_t count)
{
    if (!builder->map_density) return 0;
    float max = 1, cut = 0;
    uint32_t by = VALUES, front = 0;
    for (uint32_t which = 0; which < VALUES; ++which) {
        float excess, at = find_cut(builder, queue, count, which, &excess);
        if (excess > max) max = excess, cut = at, by = which;
    }
    if (by == VALUES) return 0;
    for (uint32_t i = 0; i < count; ++i)
        if (value_of(builder, queue[i], by) <= cut) {
            uint32_t was = queue[front];
            queue[front++] = queue[i];
            queue[i] = was;
        }
    HAIR_ASSERT(0 < front && front < count);
    return front;
}

void hair_sort_by_density(uint32_t* queue, float* from, uint32_t count)
{
    for (uint32_t i = 1; i < count; ++i) {
        uint32_t own = queue[i], k = i;
        float at = from[i];
        for (; k > 0 && from[k - 1] > at; --k) queue[k] = queue[k - 1], from[k] = from[k - 1];
        queue[k] = own;
        from[k] = at;
    }
}

void hair_map_patch(const struct hair_groom_builder* builder, uint32_t* queue, struct hair_patch* patch)
{
    HAIR_ASSERT(0 < patch->count && patch->count <= HAIR_MAX_ISOLINES);
    patch->map_density = patch->map_thickness = (hair_vec4){1, 1, 1, 1};
    if (!builder->map_density) return;
    float from[HAIR_MAX_ISOLINES];
    double sum[VALUES] = {0};
    for (uint32_t i = 0; i < patch->count; ++i) {
        double density = 0;
        for (uint32_t k = 0; k < VALUES; ++k) {
            double value = (double)value_of(builder, queue[i], k);
            sum[k] += value;
            if (k < builder->groom->map_sets) density += value;
        }
        from[i] = density > 0 ? (float)((i + 0.5) / density) : FLT_MAX;
    }
    hair_sort_by_density(queue, from, patch->count);
    for (uint32_t k = 0; k < VALUES; ++k) sum[k] /= patch->count;
    patch->map_density = (hair_vec4){(float)sum[0], (float)sum[1], (float)sum[2], (float)sum[3]};
    patch->map_thickness = (hair_vec4){(float)sum[4], (float)sum[5], (float)sum[6], (float)sum[7]};
}
