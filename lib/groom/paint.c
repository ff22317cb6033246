// paint.c - radii and colours of followers, taken from strands. A follower of one strand has the
// values of that strand. A follower between guides has their weighted mean.
#include "lib/groom/draft.h"

_Static_assert(HAIR_STRAND_COLORS == HAIR_CURVE_INTERVALS + 1,
               "shaders look for colours at the places of a curve");

#define THICKEST 4.0f // Maximum radius as a multiple of the mean.

// Strands that a follower is made of, with their weights.
struct mix {
    uint32_t strand[3];
    float weight[3];
};

static struct mix mix_of(const struct hair_draft* draft, uint32_t sprout,
                         const struct hair_follower* follower)
{
    struct mix mix = {{0}, {1, 0, 0}};
    if (draft->strand_of) {
        mix.strand[0] = draft->strand_of[sprout];
        return mix;
    }
    HAIR_ASSERT(follower->guide0 < draft->groom->info.guide_count);
    HAIR_ASSERT(follower->guide1 < draft->groom->info.guide_count);
    HAIR_ASSERT(follower->guide2 < draft->groom->info.guide_count);
    mix.strand[0] = draft->chosen[follower->guide0];
    mix.strand[1] = draft->chosen[follower->guide1];
    mix.strand[2] = draft->chosen[follower->guide2];
    mix.weight[1] = follower->weight1, mix.weight[2] = follower->weight2;
    mix.weight[0] = 1 - mix.weight[1] - mix.weight[2];
    return mix;
}

static float mean_radius(const struct hair_draft* draft)
{
    double sum = 0;
    for (uint32_t i = 0; i < draft->strands.strand_count; ++i) sum += (double)draft->strands.radii[i];
    return (float)(sum / draft->strands.strand_count);
}

// Scale the radius of a follower by the radii of its strands. Random variation is kept unless the
// follower is itself a strand of the groom.
static void widen(const struct hair_draft* draft, const struct mix* mix, float mean,
                  struct hair_follower* follower)
{
    float radius = 0;
    for (int i = 0; i < 3; ++i) radius += mix->weight[i] * draft->strands.radii[mix->strand[i]];
    float share = mean > 0 ? fminf(fmaxf(radius / mean, 0), THICKEST) : 1;
    follower->offset[0].w = draft->strand_of ? share : share * follower->offset[0].w;
}

static void paint(const struct hair_draft* draft, const struct mix* mix, uint16_t* out)
{
    for (uint32_t k = 0; k < HAIR_STRAND_COLORS; ++k)
        for (uint32_t c = 0; c < 3; ++c) {
            float value = 0;
            for (int i = 0; i < 3; ++i)
                value += mix->weight[i] *
                         draft->strands.colors[3 * (HAIR_STRAND_COLORS * (size_t)mix->strand[i] + k) + c];
            out[4 * k + c] = (uint16_t)(65535 * fminf(fmaxf(value, 0), 1) + 0.5f);
        }
}

hair_result hair_draft_paint(struct hair_draft* draft)
{
    struct hair_groom* groom = draft->groom;
    const struct hair_strands* strands = &draft->strands;
    float mean = strands->radii ? mean_radius(draft) : 0;
    if (strands->colors) {
        groom->paint =
            hair_alloc(draft->host, draft->sprout_count, 4 * HAIR_STRAND_COLORS * sizeof *groom->paint);
        if (!groom->paint) return hair_fail_memory(draft->host, "the colours of followers");
    }
    for (uint32_t i = 0; i < draft->sprout_count; ++i) {
        HAIR_ASSERT(draft->place[i] < draft->sprout_count);
        struct hair_follower* follower = &groom->followers[draft->place[i]];
        struct mix mix = mix_of(draft, i, follower);
        if (strands->radii) widen(draft, &mix, mean, follower);
        if (strands->colors)
            paint(draft, &mix, groom->paint + 4 * HAIR_STRAND_COLORS * (size_t)draft->place[i]);
    }
    return HAIR_OK;
}
