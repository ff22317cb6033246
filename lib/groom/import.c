// import.c - import of the caller's strands and scalp: copied, checked, and converted to metres and
// +y up.
#include "lib/groom/groom_builder.h"

#include <string.h>

#define FARTHEST 1e6f // Maximum distance from the origin, m, as for strands.

static hair_result count_strand_vertices(const struct hair_groom_builder* builder, uint32_t* out)
{
    const hair_groom_desc* desc = builder->desc;
    uint64_t sum = 0; // fits 2^22 strands of 2^32 vertices
    for (uint32_t i = 0; i < desc->strand_count; ++i) sum += desc->strand_vertices[i];
    if (sum > UINT32_MAX)
        return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.strand_vertices add up to %llu, not in [0, %u]",
                         (unsigned long long)sum, UINT32_MAX);
    *out = (uint32_t)sum;
    return HAIR_OK;
}

static hair_result check_numbers(const struct hair_groom_builder* builder, const char* what,
                                 const float* numbers, size_t count, float max)
{
    for (size_t i = 0; i < count; ++i)
        if (!(numbers[i] >= 0 && numbers[i] <= max)) // NaN fails too.
            return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.%s[%zu] is %g, not in [0, %g]", what, i, (double)numbers[i],
                             (double)max);
    return HAIR_OK;
}

// Copy the radii and colours of strands.
static hair_result copy_rest(struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    struct hair_strands* strands = &builder->strands;
    uint32_t each = desc->color_count, count = strands->strand_count;
    if (desc->strand_radii) {
        HAIR_TRY(check_numbers(builder, "strand_radii", desc->strand_radii, count, FARTHEST));
        strands->radii = hair_alloc(builder->host, count, sizeof *strands->radii);
        if (!strands->radii) return hair_fail_memory(builder->host, "strands");
        memcpy(strands->radii, desc->strand_radii, count * sizeof *strands->radii);
    }
    if (!desc->colors) return HAIR_OK;
    HAIR_TRY(check_numbers(builder, "colors", desc->colors,
                           3 * (each ? (size_t)each * count : (size_t)strands->vertex_count), 1));
    strands->colors = hair_alloc(builder->host, count, 3 * HAIR_STRAND_COLORS * sizeof *strands->colors);
    if (!strands->colors) return hair_fail_memory(builder->host, "the colours of strands");
    size_t first = 0;
    for (uint32_t i = 0; i < count; ++i) {
        float* out = strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)i;
        if (each)
            hair_strand_even_colors(desc->colors + 3 * (size_t)each * i, each, out);
        else if (strands->vertices[i])
            hair_strand_colors(desc->positions + 3 * first, strands->vertices[i], desc->colors + 3 * first,
                               out);
        first += strands->vertices[i];
    }
    return HAIR_OK;
}

static hair_result copy_strands(struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    struct hair_strands* strands = &builder->strands;
    HAIR_TRY(count_strand_vertices(builder, &strands->vertex_count));
    strands->strand_count = desc->strand_count;
    strands->positions = hair_alloc(builder->host, strands->vertex_count, 3 * sizeof(float));
    strands->vertices = hair_alloc(builder->host, strands->strand_count, sizeof(uint32_t));
    if (!strands->positions || !strands->vertices) return hair_fail_memory(builder->host, "strands");
    memcpy(strands->positions, desc->positions, 3 * (size_t)strands->vertex_count * sizeof(float));
    memcpy(strands->vertices, desc->strand_vertices, strands->strand_count * sizeof(uint32_t));
    return copy_rest(builder);
}

static hair_result clean(struct hair_groom_builder* builder)
{
    hair_import_stats* repairs = &builder->groom->info.import_stats;
    HAIR_TRY(hair_strands_clean(builder->host, builder->import, &builder->strands, repairs));
    if (builder->strands.strand_count == 0)
        return hair_fail(
            builder->host, HAIR_ERROR_ARGUMENT,
            "hair_groom_desc.positions: none of %u strands can be used: %u have fewer than two vertices "
            "left, %u are too short; %u vertices were not finite, %u repeated",
            builder->desc->strand_count, repairs->dropped_single, repairs->dropped_short,
            repairs->removed_nonfinite, repairs->removed_repeated);
    if (builder->desc->strand_set == HAIR_STRAND_SET_GUIDES &&
        builder->strands.strand_count > HAIR_MAX_GUIDES)
        return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.strand_count: %u guides, not in [1, %u]",
                         builder->strands.strand_count, HAIR_MAX_GUIDES);
    return HAIR_OK;
}

// Compute the first vertex, the length and the shape samples of each strand.
static void measure_import(struct hair_groom_builder* builder)
{
    const struct hair_strands* strands = &builder->strands;
    uint32_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        const float* p = strands->positions + 3 * (size_t)first;
        builder->first[i] = first;
        builder->length[i] = (float)hair_strand_length(p, strands->vertices[i]);
        HAIR_ASSERT(strands->vertices[i] >= 2 && builder->length[i] > 0);
        hair_strand_resample(p, strands->vertices[i],
                             builder->shape_samples + 3 * HAIR_SHAPE_SAMPLES * (size_t)i, HAIR_SHAPE_SAMPLES);
        first += strands->vertices[i];
    }
}

hair_result hair_build_strands(struct hair_groom_builder* builder)
{
    HAIR_TRY(copy_strands(builder));
    HAIR_TRY(clean(builder));
    uint32_t count = builder->strands.strand_count;
    builder->first = hair_alloc(builder->host, count, sizeof *builder->first);
    builder->length = hair_alloc(builder->host, count, sizeof *builder->length);
    builder->shape_samples =
        hair_alloc(builder->host, count, 3 * HAIR_SHAPE_SAMPLES * sizeof *builder->shape_samples);
    if (!builder->first || !builder->length || !builder->shape_samples)
        return hair_fail_memory(builder->host, "strands");
    measure_import(builder);
    return HAIR_OK;
}

static hair_result check_triangles(const struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    for (size_t i = 0; i < 3 * (size_t)desc->scalp_triangle_count; ++i)
        if (desc->scalp_triangles[i] >= desc->scalp_vertex_count)
            return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_triangles[%zu] is %u, not in [0, %u]", i,
                             desc->scalp_triangles[i], desc->scalp_vertex_count - 1);
    return HAIR_OK;
}

static hair_result check_density(const struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    for (uint32_t i = 0; desc->scalp_density && i < desc->scalp_vertex_count; ++i)
        if (!(desc->scalp_density[i] >= 0 && desc->scalp_density[i] <= 1))
            return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_density[%u] is %g, not in [0, 1]", i,
                             (double)desc->scalp_density[i]);
    return HAIR_OK;
}

static hair_result place_scalp(struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    for (size_t i = 0; i < desc->scalp_vertex_count; ++i) {
        const float* p = desc->scalp_positions + 3 * i;
        hair_vec3 at = hair_import_point(builder->import, hair_load3(p));
        if (!(hair_length(at) <= FARTHEST)) // NaN fails too.
            return hair_fail(
                builder->host, HAIR_ERROR_ARGUMENT,
                "hair_groom_desc.scalp_positions: vertex %zu is (%g, %g, %g), not within %g m of the origin",
                i, (double)p[0], (double)p[1], (double)p[2], (double)FARTHEST);
        hair_store3(builder->scalp + 3 * i, at);
    }
    return HAIR_OK;
}

static void average_density(struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    for (size_t i = 0; i < desc->scalp_triangle_count; ++i) {
        const uint32_t* corner = desc->scalp_triangles + 3 * i;
        const float* fraction = desc->scalp_density;
        builder->density[i] =
            fraction ? (fraction[corner[0]] + fraction[corner[1]] + fraction[corner[2]]) / 3 : 1;
    }
}

hair_result hair_build_scalp(struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    if (!desc->scalp_positions) return HAIR_OK;
    HAIR_TRY(check_triangles(builder));
    HAIR_TRY(check_density(builder));
    builder->scalp = hair_alloc(builder->host, desc->scalp_vertex_count, 3 * sizeof *builder->scalp);
    builder->density = hair_alloc(builder->host, desc->scalp_triangle_count, sizeof *builder->density);
    if (!builder->scalp || !builder->density) return hair_fail_memory(builder->host, "the scalp");
    HAIR_TRY(place_scalp(builder));
    average_density(builder);
    return HAIR_OK;
}
