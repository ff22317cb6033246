// strand_attributes.c - radii and colours of followers, taken from strands. A follower of one
// strand has the values of that strand. A follower between guides has their weighted mean.
#include "lib/groom/groom_builder.h"

_Static_assert(HAIR_STRAND_COLORS == HAIR_CURVE_INTERVALS + 1,
               "shaders look for colours at the places of a curve");

#define THICKEST 4.0f // Maximum radius as a multiple of the mean.

struct hair_strand_mix hair_mix_guides(const struct hair_groom_builder* builder, const uint32_t guide[3],
                                       float weight1, float weight2)
{
    struct hair_strand_mix mix = {.weight = {1 - weight1 - weight2, weight1, weight2}};
    for (int i = 0; i < 3; ++i) {
        HAIR_ASSERT(guide[i] < builder->groom->info.guide_count);
        mix.strand[i] = builder->chosen[guide[i]];
    }
    return mix;
}

struct hair_strand_mix hair_mix_of(const struct hair_groom_builder* builder, uint32_t candidate,
                                   const struct hair_follower* follower)
{
    const uint32_t guide[3] = {follower->guide0, follower->guide1, follower->guide2};
    if (builder->strand_of) return (struct hair_strand_mix){{builder->strand_of[candidate]}, {1}};
    return hair_mix_guides(builder, guide, follower->weight1, follower->weight2);
}

static float mean_radius(const struct hair_groom_builder* builder)
{
    double sum = 0;
    for (uint32_t i = 0; i < builder->strands.strand_count; ++i) sum += (double)builder->strands.radii[i];
    return (float)(sum / builder->strands.strand_count);
}

// Scale the radius of a follower by the radii of its strands. Random variation is kept unless the
// follower is itself a strand of the groom.
static void widen_strand(const struct hair_groom_builder* builder, const struct hair_strand_mix* mix,
                         float mean, struct hair_follower* follower)
{
    float radius = 0;
    for (int i = 0; i < 3; ++i) radius += mix->weight[i] * builder->strands.radii[mix->strand[i]];
    float fraction = mean > 0 ? fminf(fmaxf(radius / mean, 0), THICKEST) : 1;
    follower->offset[0].w = builder->strand_of ? fraction : fraction * follower->offset[0].w;
}

static void paint(const struct hair_groom_builder* builder, const struct hair_strand_mix* mix, uint16_t* out)
{
    for (uint32_t k = 0; k < HAIR_STRAND_COLORS; ++k)
        for (uint32_t c = 0; c < 3; ++c) {
            float value = 0;
            for (int i = 0; i < 3; ++i)
                value += mix->weight[i] *
                         builder->strands.colors[3 * (HAIR_STRAND_COLORS * (size_t)mix->strand[i] + k) + c];
            out[4 * k + c] = (uint16_t)(65535 * fminf(fmaxf(value, 0), 1) + 0.5f);
        }
}

hair_result hair_build_strand_attributes(struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    const struct hair_strands* strands = &builder->strands;
    if (!strands->radii && !strands->colors) return HAIR_OK;
    float mean = strands->radii ? mean_radius(builder) : 0;
    if (strands->colors) {
        groom->colors = hair_alloc(builder->host, builder->candidate_count,
                                   4 * HAIR_STRAND_COLORS * sizeof *groom->colors);
        if (!groom->colors) return hair_fail_memory(builder->host, "the colours of followers");
    }
    for (uint32_t i = 0; i < builder->candidate_count; ++i) {
        HAIR_ASSERT(builder->place[i] < builder->candidate_count);
        struct hair_follower* follower = &groom->followers[builder->place[i]];
        struct hair_strand_mix mix = hair_mix_of(builder, i, follower);
        if (strands->radii) widen_strand(builder, &mix, mean, follower);
        if (strands->colors)
            paint(builder, &mix, groom->colors + 4 * HAIR_STRAND_COLORS * (size_t)builder->place[i]);
    }
    return HAIR_OK;
}
