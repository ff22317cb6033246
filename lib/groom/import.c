// import.c - import of the caller's strands and scalp: copied, checked, and converted to metres and
// +y up.
#include "lib/groom/groom_builder.h"

#include <string.h>

#define FARTHEST 1e6f // Maximum distance from the origin, m, as for strands.
// Points of a strand that are features, at 0, 1/3, 2/3 and 1 of its length.
#define SHAPE_SAMPLES 4
// Weights of features relative to the points' of the shape, in lengths of a strand. They gave the
// smallest error of followers in hair-bench.
#define ROOT_WEIGHT 0.45f // of roots, in units of their root mean square distance
#define LENGTH_WEIGHT 0.5f // of the logarithm of the length
_Static_assert(3 * SHAPE_SAMPLES + 1 == HAIR_FEATURES, "features are points and the length");

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

static hair_result copy_groups(struct hair_groom_builder* builder)
{
    const uint8_t* groups = builder->desc->strand_groups;
    struct hair_strands* strands = &builder->strands;
    if (!groups) return HAIR_OK;
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        if (groups[i] >= HAIR_MAX_STRAND_GROUPS)
            return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.strand_groups[%u] is %u, not in [0, %d]", i, groups[i],
                             HAIR_MAX_STRAND_GROUPS - 1);
    strands->groups = hair_alloc(builder->host, strands->strand_count, sizeof *groups);
    if (!strands->groups) return hair_fail_memory(builder->host, "strands");
    memcpy(strands->groups, groups, strands->strand_count * sizeof *groups);
    return HAIR_OK;
}

// Copy the groups, radii and colours of strands.
static hair_result copy_rest(struct hair_groom_builder* builder)
{
    const hair_groom_desc* desc = builder->desc;
    struct hair_strands* strands = &builder->strands;
    uint32_t each = desc->color_count, count = strands->strand_count;
    HAIR_TRY(copy_groups(builder));
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

// Return the root mean square distance of the roots from their centroid, m.
static float measure_roots(const struct hair_groom_builder* builder)
{
    const struct hair_strands* strands = &builder->strands;
    double sum[3] = {0}, squares = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        for (size_t k = 0; k < 3; ++k) {
            double x = (double)strands->positions[3 * (size_t)builder->first[i] + k];
            sum[k] += x;
            squares += x * x;
        }
    for (size_t k = 0; k < 3; ++k) squares -= sum[k] * sum[k] / strands->strand_count;
    return (float)sqrt(fmax(squares, 0) / strands->strand_count);
}

// Write the features of a strand, whose distances tell how differently two strands move. Strands of
// similar direction, shape and length move alike on neighbouring roots.
static void write_features(const float* p, uint32_t vertices, float length, float spread, float* out)
{
    float sample[3 * SHAPE_SAMPLES];
    hair_strand_resample(p, vertices, sample, SHAPE_SAMPLES);
    for (int k = 0; k < 3; ++k) out[k] = spread > 0 ? ROOT_WEIGHT * sample[k] / spread : 0;
    for (int k = 3; k < 3 * SHAPE_SAMPLES; ++k) out[k] = (sample[k] - sample[k % 3]) / length;
    out[3 * SHAPE_SAMPLES] = LENGTH_WEIGHT * logf(length);
}

// Compute the first vertex, the length and the features of each strand.
static void measure_import(struct hair_groom_builder* builder)
{
    const struct hair_strands* strands = &builder->strands;
    uint32_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        const float* p = strands->positions + 3 * (size_t)first;
        builder->first[i] = first;
        builder->length[i] = (float)hair_strand_length(p, strands->vertices[i]);
        HAIR_ASSERT(strands->vertices[i] >= 2 && builder->length[i] > 0);
        first += strands->vertices[i];
    }
    float spread = measure_roots(builder);
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        write_features(strands->positions + 3 * (size_t)builder->first[i], strands->vertices[i],
                       builder->length[i], spread, builder->features + HAIR_FEATURES * (size_t)i);
}

hair_result hair_build_strands(struct hair_groom_builder* builder)
{
    HAIR_TRY(copy_strands(builder));
    HAIR_TRY(clean(builder));
    uint32_t count = builder->strands.strand_count;
    builder->first = hair_alloc(builder->host, count, sizeof *builder->first);
    builder->length = hair_alloc(builder->host, count, sizeof *builder->length);
    builder->features = hair_alloc(builder->host, count, HAIR_FEATURES * sizeof *builder->features);
    if (!builder->first || !builder->length || !builder->features)
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
