// root_bins.c - root bins, which followers grow on. They are guides or scalp triangles.
#include "lib/groom/groom_builder.h"

#include <string.h>

static hair_result reserve_bins(struct hair_groom_builder* builder, uint32_t count)
{
    builder->bin_count = count;
    builder->bin_candidates = hair_alloc(builder->host, count, sizeof *builder->bin_candidates);
    builder->bin_first = hair_alloc_undefined(builder->host, count, sizeof *builder->bin_first);
    builder->bin_centres = hair_alloc_undefined(builder->host, count, 3 * sizeof *builder->bin_centres);
    if (!builder->bin_candidates || !builder->bin_first || !builder->bin_centres)
        return hair_fail_memory(builder->host, "followers");
    return HAIR_OK;
}

hair_result hair_guide_bins(struct hair_groom_builder* builder)
{
    uint32_t guides = builder->groom->info.guide_count;
    HAIR_TRY(reserve_bins(builder, guides));
    memcpy(builder->bin_centres, builder->groom->roots, 3 * (size_t)guides * sizeof(float));
    return HAIR_OK;
}

hair_result hair_scalp_bins(struct hair_groom_builder* builder)
{
    uint32_t triangles = builder->desc->scalp_triangle_count;
    HAIR_TRY(reserve_bins(builder, triangles));
    builder->bin_density = builder->density;
    for (uint32_t i = 0; i < triangles; ++i) {
        hair_vec3 a = hair_scalp_corner(builder, i, 0), b = hair_scalp_corner(builder, i, 1);
        hair_vec3 sum = hair_add(hair_scalp_corner(builder, i, 2), hair_add(a, b));
        hair_store3(builder->bin_centres + 3 * (size_t)i, hair_scale(sum, 1.0f / 3));
    }
    return HAIR_OK;
}

void hair_number_candidates(struct hair_groom_builder* builder)
{
    HAIR_ASSERT(builder->candidate_count == 0);
    for (uint32_t i = 0; i < builder->bin_count; ++i) {
        builder->bin_first[i] = builder->candidate_count;
        builder->candidate_count += builder->bin_candidates[i];
    }
}

hair_vec3 hair_scalp_corner(const struct hair_groom_builder* builder, uint32_t triangle, uint32_t corner)
{
    HAIR_ASSERT(triangle < builder->desc->scalp_triangle_count && corner < 3);
    uint32_t vertex = builder->desc->scalp_triangles[3 * (size_t)triangle + corner];
    return hair_load3(builder->scalp + 3 * (size_t)vertex);
}
