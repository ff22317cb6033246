// attributes.c - factors of guides, from values of their strands and from maps on the scalp.
#include "lib/groom/surface.h"

#define GUIDE_KINDS 4 // Kinds of attributes that belong to guides. They are the first.

bool hair_has_attribute(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind,
                        bool is_map)
{
    const hair_groom_desc* desc = builder->desc;
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i) {
        const hair_strand_attribute* attribute = &desc->strand_attributes[i];
        bool is_there =
            is_map ? attribute->map.source != HAIR_MAP_SOURCE_NONE : attribute->strand_values != NULL;
        if (attribute->kind == kind && is_there) return true;
    }
    return false;
}

float hair_find_map_factor(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind,
                           const struct hair_scalp_point* scalp_point)
{
    const hair_groom_desc* desc = builder->desc;
    float factor = 1;
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i)
        if (desc->strand_attributes[i].kind == kind)
            factor *= hair_map_value(builder, &desc->strand_attributes[i].map, scalp_point);
    return factor;
}

float hair_find_factor(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind,
                       const struct hair_strand_mix* mix, const struct hair_scalp_point* scalp_point)
{
    const struct hair_attribute_range range = hair_attribute_range_of(kind);
    const float* of_strands = builder->strands.factors[kind];
    float factor = of_strands ? 0 : 1;
    for (int i = 0; of_strands && i < 3; ++i) factor += mix->weight[i] * of_strands[mix->strand[i]];
    factor *= hair_find_map_factor(builder, kind, scalp_point);
    return fminf(fmaxf(factor, range.min), range.max);
}

// Return a factor of a guide. `scalp_point` is its root, which only maps need.
static float find_guide_factor(const struct hair_groom_builder* builder, uint32_t guide,
                               hair_strand_attribute_kind kind, const struct hair_scalp_point* scalp_point)
{
    const struct hair_strand_mix mix = {{builder->chosen[guide], 0, 0}, {1, 0, 0}};
    return hair_find_factor(builder, kind, &mix, scalp_point);
}

// Return whether attributes of guides have values, or maps if `is_map`.
static bool has_guide_values(const struct hair_groom_builder* builder, bool is_map)
{
    for (int kind = 0; kind < GUIDE_KINDS; ++kind)
        if (hair_has_attribute(builder, (hair_strand_attribute_kind)kind, is_map)) return true;
    return false;
}

static void add_bounds(struct hair_groom* groom, const struct hair_guide_factors* factors)
{
    struct hair_guide_factors *min = &groom->min_factors, *max = &groom->max_factors;
    min->stiffness = fminf(min->stiffness, factors->stiffness);
    min->damping = fminf(min->damping, factors->damping);
    min->shape_frequency = fminf(min->shape_frequency, factors->shape_frequency);
    min->gravity_preload = fminf(min->gravity_preload, factors->gravity_preload);
    max->stiffness = fmaxf(max->stiffness, factors->stiffness);
    max->damping = fmaxf(max->damping, factors->damping);
    max->shape_frequency = fmaxf(max->shape_frequency, factors->shape_frequency);
    max->gravity_preload = fmaxf(max->gravity_preload, factors->gravity_preload);
}

// Compute the factors of all guides. `surface` is the scalp, or NULL if no guide has a map.
static void fill_guide_factors(struct hair_groom_builder* builder, struct hair_surface* surface)
{
    struct hair_groom* groom = builder->groom;
    for (uint32_t i = 0; i < groom->info.guide_count; ++i) {
        struct hair_scalp_point root = {0};
        if (surface) root = hair_surface_find_point(surface, hair_guide_root(groom, i));
        struct hair_guide_factors* factors = &groom->guide_factors[i];
        factors->stiffness = find_guide_factor(builder, i, HAIR_STRAND_ATTRIBUTE_STIFFNESS, &root);
        factors->damping = find_guide_factor(builder, i, HAIR_STRAND_ATTRIBUTE_DAMPING, &root);
        factors->shape_frequency =
            find_guide_factor(builder, i, HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY, &root);
        factors->gravity_preload =
            find_guide_factor(builder, i, HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD, &root);
        if (i == 0) groom->min_factors = groom->max_factors = *factors;
        add_bounds(groom, factors);
    }
}

static hair_result fill_with_maps(struct hair_groom_builder* builder)
{
    struct hair_surface surface;
    hair_result result = hair_surface_build(builder, &surface);
    if (!result && surface.triangles.count == 0) result = hair_fail_degenerate(builder);
    if (!result) fill_guide_factors(builder, &surface);
    hair_surface_free(&surface);
    return result;
}

hair_result hair_build_guide_factors(struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    bool has_maps = has_guide_values(builder, true);
    if (!has_maps && !has_guide_values(builder, false)) return HAIR_OK;
    groom->guide_factors = hair_alloc(builder->host, groom->info.guide_count, sizeof *groom->guide_factors);
    if (!groom->guide_factors) return hair_fail_memory(builder->host, "the factors of guides");
    if (has_maps) return fill_with_maps(builder);
    fill_guide_factors(builder, NULL);
    return HAIR_OK;
}
