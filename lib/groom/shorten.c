// shorten.c - strands and followers that attributes make shorter when a groom is made.
#include "lib/asset/arrays.h"
#include "lib/groom/surface.h"

#include <string.h>

#define SHORTEST 2e-5 // Minimum length of a strand that has been shortened, m.
#define LAST 1e-3 // Minimum length of its last segment, as a fraction of the strand.

// Shorten a strand to a length. Return the number of vertices that are left.
static uint32_t shorten(float* positions, uint32_t vertices, double kept)
{
    double so_far = 0;
    for (uint32_t k = 0;; ++k) {
        hair_vec3 a = hair_load3(positions + 3 * (size_t)k), b = hair_load3(positions + 3 * (size_t)k + 3);
        double length = (double)hair_distance(a, b), left = kept - so_far;
        HAIR_ASSERT(k + 1 < vertices && length > 0);
        if (left <= length || k + 2 == vertices) {
            if (k > 0 && left < LAST * kept) return k + 1;
            hair_store3(positions + 3 * (size_t)k + 3, hair_lerp(a, b, (float)fmin(left / length, 1)));
            return k + 2;
        }
        so_far += length;
    }
}

// Keep the colours of the part of a strand that is left at their places.
static void shorten_colors(float* colors, float fraction)
{
    float own[3 * HAIR_STRAND_COLORS];
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k)
        hair_strand_color_at(colors, fraction * (float)k / (HAIR_STRAND_COLORS - 1), own + 3 * (size_t)k);
    memcpy(colors, own, sizeof own);
}

// Shorten all strands, and move the vertices that are left together. `surface` is NULL without a
// map.
static void shorten_all(struct hair_groom_builder* builder, struct hair_surface* surface)
{
    struct hair_strands* strands = &builder->strands;
    size_t from = 0, to = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        float* p = strands->positions + 3 * from;
        const uint32_t vertices = strands->vertices[i];
        const struct hair_strand_mix own = {{i, i, i}, {1, 0, 0}};
        struct hair_scalp_point root = {0};
        if (surface) root = hair_surface_find_point(surface, hair_load3(p));
        double length = hair_strand_length(p, vertices);
        float fraction = hair_find_factor(builder, HAIR_STRAND_ATTRIBUTE_LENGTH, &own, &root);
        if (surface)
            builder->map_lengths[i] = hair_find_map_factor(builder, HAIR_STRAND_ATTRIBUTE_LENGTH, &root);
        if (fraction < 1) {
            strands->vertices[i] =
                shorten(p, vertices, fmax((double)fraction * length, fmin(length, SHORTEST)));
            if (strands->colors)
                shorten_colors(strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)i, fraction);
        }
        memmove(strands->positions + 3 * to, p, 3 * (size_t)strands->vertices[i] * sizeof *p);
        from += vertices, to += strands->vertices[i];
    }
    strands->vertex_count = (uint32_t)to;
}

static hair_result shorten_by_map(struct hair_groom_builder* builder)
{
    struct hair_surface surface;
    hair_result result = hair_surface_build(builder, &surface);
    if (!result && surface.triangles.count == 0) result = hair_fail_degenerate(builder);
    if (!result) {
        builder->map_lengths =
            hair_alloc(builder->host, builder->strands.strand_count, sizeof *builder->map_lengths);
        if (!builder->map_lengths) result = hair_fail_memory(builder->host, "the lengths of strands");
    }
    if (!result) shorten_all(builder, &surface);
    hair_surface_free(&surface);
    return result;
}

hair_result hair_shorten_strands(struct hair_groom_builder* builder)
{
    HAIR_TRY(hair_check_attribute_maps(builder->host, builder->desc));
    if (hair_has_attribute(builder, HAIR_STRAND_ATTRIBUTE_LENGTH, true)) return shorten_by_map(builder);
    if (hair_has_attribute(builder, HAIR_STRAND_ATTRIBUTE_LENGTH, false)) shorten_all(builder, NULL);
    return HAIR_OK;
}

void hair_shorten_follower(const struct hair_groom_builder* builder, const struct hair_strand_mix* mix,
                           const struct hair_scalp_point* root, struct hair_follower* follower)
{
    float mean = 0, own = hair_find_map_factor(builder, HAIR_STRAND_ATTRIBUTE_LENGTH, root);
    for (int i = 0; i < 3; ++i) mean += mix->weight[i] * builder->map_lengths[mix->strand[i]];
    if (!(own < mean)) return;
    // The offsets are cut by de Casteljau's algorithm.
    const float fraction = own / mean;
    hair_vec3 p[4];
    for (int i = 0; i < 4; ++i)
        p[i] = hair_v3(follower->offset[i].x, follower->offset[i].y, follower->offset[i].z);
    for (int n = 1; n < 4; ++n)
        for (int i = 3; i >= n; --i) p[i] = hair_lerp(p[i - 1], p[i], fraction);
    for (int i = 0; i < 4; ++i)
        follower->offset[i].x = p[i].x, follower->offset[i].y = p[i].y, follower->offset[i].z = p[i].z;
    follower->length_ratio *= fraction;
}
