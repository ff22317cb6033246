// import.c - import of the caller's strands and scalp, and the features by which strands are
// compared.
#include "lib/asset/arrays.h"
#include "lib/groom/groom_builder.h"

#include <string.h>

// Points of a strand that are features, at 0, 1/3, 2/3 and 1 of its length.
#define SHAPE_SAMPLES 4
// Weights of features relative to the points' of the shape, in lengths of a strand. They gave the
// smallest error of followers in hair-bench.
#define ROOT_WEIGHT 0.45f // of roots, in units of their root mean square distance
#define LENGTH_WEIGHT 0.5f // of the logarithm of the length
_Static_assert(3 * SHAPE_SAMPLES + 1 == HAIR_FEATURES, "features are points and the length");

static hair_result import_strands(struct hair_groom_builder* builder)
{
    HAIR_TRY(hair_strands_import(builder->host, &builder->groom->tasks, builder->desc, builder->import,
                                 &builder->strands, &builder->groom->info.import_stats));
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

struct measuring {
    struct hair_groom_builder* builder;
    struct hair_division division; // of the strands
    float spread; // root mean square distance of the roots, m
};

// Compute the length and the features of strands.
static void measure_some_strands(uint32_t index, void* data)
{
    const struct measuring* measuring = data;
    struct hair_groom_builder* builder = measuring->builder;
    uint32_t end = hair_division_end(&measuring->division, index);
    for (uint32_t i = index * measuring->division.each; i < end; ++i) {
        const float* p = builder->strands.positions + 3 * (size_t)builder->first[i];
        const uint32_t vertices = builder->strands.vertices[i];
        builder->length[i] = (float)hair_strand_length(p, vertices);
        HAIR_ASSERT(vertices >= 2 && builder->length[i] > 0);
        if (builder->features)
            write_features(p, vertices, builder->length[i], measuring->spread,
                           builder->features + HAIR_FEATURES * (size_t)i);
    }
}

// Compute the first vertex, the length and the features of each strand.
static void measure_import(struct hair_groom_builder* builder)
{
    const struct hair_strands* strands = &builder->strands;
    struct measuring measuring = {.builder = builder,
                                  .division = hair_divide(strands->strand_count, HAIR_MIN_TASK_STRANDS)};
    uint32_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; first += strands->vertices[i++])
        builder->first[i] = first;
    if (builder->features) measuring.spread = measure_roots(builder);
    hair_run_tasks(&builder->groom->tasks, measure_some_strands, &measuring, measuring.division.tasks);
}

hair_result hair_build_strands(struct hair_groom_builder* builder)
{
    return import_strands(builder);
}

hair_result hair_measure_strands(struct hair_groom_builder* builder)
{
    uint32_t count = builder->strands.strand_count;
    bool has_features = builder->desc->strand_set == HAIR_STRAND_SET_FULL;
    builder->first = hair_alloc_undefined(builder->host, count, sizeof *builder->first);
    builder->length = hair_alloc_undefined(builder->host, count, sizeof *builder->length);
    if (has_features)
        builder->features =
            hair_alloc_undefined(builder->host, count, HAIR_FEATURES * sizeof *builder->features);
    if (!builder->first || !builder->length || (has_features && !builder->features))
        return hair_fail_memory(builder->host, "strands");
    measure_import(builder);
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
    HAIR_TRY(hair_scalp_check(builder->host, desc));
    builder->scalp = hair_alloc(builder->host, desc->scalp_vertex_count, 3 * sizeof *builder->scalp);
    builder->density = hair_alloc(builder->host, desc->scalp_triangle_count, sizeof *builder->density);
    if (!builder->scalp || !builder->density) return hair_fail_memory(builder->host, "the scalp");
    HAIR_TRY(hair_scalp_place(builder->host, desc, builder->import, builder->scalp));
    average_density(builder);
    return HAIR_OK;
}
