// follower_factors.c - factors of followers from attributes of strands. Radii change the followers.
// The other factors are half floats for shaders, of which only those in use are kept.
#include "lib/groom/groom_builder.h"

#include <string.h>

// Kinds of attributes that shaders read, in the order of the factors.
static const hair_strand_attribute_kind factor_kinds[] = {
    [HAIR_FACTOR_CLUMP] = HAIR_STRAND_ATTRIBUTE_CLUMP,
    [HAIR_FACTOR_CURL_RADIUS] = HAIR_STRAND_ATTRIBUTE_CURL_RADIUS,
    [HAIR_FACTOR_CURL_TURNS] = HAIR_STRAND_ATTRIBUTE_CURL_FREQUENCY,
    [HAIR_FACTOR_FRIZZ] = HAIR_STRAND_ATTRIBUTE_FRIZZ,
    [HAIR_FACTOR_VARIANCE] = HAIR_STRAND_ATTRIBUTE_ROUGHNESS,
};
_Static_assert(sizeof factor_kinds / sizeof *factor_kinds == HAIR_FACTORS, "each factor has a kind");

static bool is_used(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind)
{
    return hair_has_attribute(builder, kind, false) || hair_has_attribute(builder, kind, true);
}

// Return the nearest half float of a number in [0, 1024]. Numbers below 6e-5 become 0.
static uint16_t to_half(float value)
{
    uint32_t bits;
    HAIR_ASSERT(value >= 0 && value <= 1024);
    if (value < 6.2e-5f) return 0;
    memcpy(&bits, &value, sizeof bits);
    // The exponents have the biases 127 and 15. The mantissa loses 13 bits.
    return (uint16_t)((bits + 0xfffu + (bits >> 13 & 1u) - (112u << 23)) >> 13);
}

// Find the slots of the factors in use, and their number.
static void find_slots(const struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    for (int i = 0; i < HAIR_FACTORS; ++i) {
        groom->max_follower_factors[i] = 1;
        if (!is_used(builder, factor_kinds[i])) continue;
        groom->max_follower_factors[i] = 0;
        groom->factor_slots |= ++groom->factor_count << 4 * i;
    }
}

static void write_factors(const struct hair_groom_builder* builder, const struct hair_strand_mix* mix,
                          const struct hair_scalp_point* root, uint16_t* out)
{
    struct hair_groom* groom = builder->groom;
    for (int i = 0; i < HAIR_FACTORS; ++i) {
        uint32_t slot = groom->factor_slots >> 4 * i & 15;
        if (!slot) continue;
        float factor = hair_find_factor(builder, factor_kinds[i], mix, root);
        if (i == HAIR_FACTOR_VARIANCE) factor *= factor;
        groom->max_follower_factors[i] = fmaxf(groom->max_follower_factors[i], factor);
        out[slot - 1] = to_half(factor);
    }
}

static bool has_map(const struct hair_groom_builder* builder)
{
    bool found = hair_has_attribute(builder, HAIR_STRAND_ATTRIBUTE_RADIUS, true);
    for (int i = 0; i < HAIR_FACTORS; ++i) found |= hair_has_attribute(builder, factor_kinds[i], true);
    return found;
}

hair_result hair_build_follower_factors(struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    const struct hair_scalp_point nowhere = {0};
    bool has_radii = is_used(builder, HAIR_STRAND_ATTRIBUTE_RADIUS);
    if (has_map(builder) && !builder->scalp_points) return hair_fail_degenerate(builder);
    find_slots(builder);
    if (!groom->factor_count && !has_radii && !builder->map_lengths) return HAIR_OK;
    if (groom->factor_count) {
        groom->factors =
            hair_alloc(builder->host, builder->candidate_count, groom->factor_count * sizeof *groom->factors);
        if (!groom->factors) return hair_fail_memory(builder->host, "the factors of followers");
    }
    for (uint32_t i = 0; i < builder->candidate_count; ++i) {
        uint32_t place = builder->place[i];
        struct hair_follower* follower = &groom->followers[place];
        const struct hair_strand_mix mix = hair_mix_of(builder, i, follower);
        const struct hair_scalp_point* root = builder->scalp_points ? &builder->scalp_points[i] : &nowhere;
        if (has_radii)
            follower->offset[0].w *= hair_find_factor(builder, HAIR_STRAND_ATTRIBUTE_RADIUS, &mix, root);
        if (builder->map_lengths && !builder->strand_of) hair_shorten_follower(builder, &mix, root, follower);
        if (groom->factors)
            write_factors(builder, &mix, root, groom->factors + (size_t)groom->factor_count * place);
    }
    return HAIR_OK;
}

float hair_groom_follower_factor(const struct hair_groom* groom, uint32_t follower, int factor)
{
    uint32_t slot = groom->factor_slots >> 4 * factor & 15;
    if (!slot) return 1;
    uint32_t half = groom->factors[(size_t)groom->factor_count * follower + slot - 1];
    return half ? ldexpf((float)(1024 + (half & 1023)), (int)(half >> 10) - 25) : 0;
}
