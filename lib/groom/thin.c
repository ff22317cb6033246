// thin.c - removal of candidates by attributes of density, before they become followers.
#include "lib/groom/groom_builder.h"

#define OTHER 0x9e3779b9u // Keeps the choice apart from the random values of the follower.

// Return whether a candidate of a mix of strands remains.
static bool is_kept(const struct hair_groom_builder* builder, uint32_t candidate,
                    const struct hair_strand_mix* mix)
{
    const struct hair_scalp_point nowhere = {0};
    const struct hair_scalp_point* root =
        builder->scalp_points ? &builder->scalp_points[candidate] : &nowhere;
    uint32_t of = builder->strand_of ? builder->strand_of[candidate] : candidate;
    uint32_t random = hair_hash(hair_candidate_random(builder, of) + OTHER);
    return hair_random(&random) < hair_find_factor(builder, HAIR_STRAND_ATTRIBUTE_DENSITY, mix, root);
}

// Move the candidates that remain together. `mixes` has the strands of each, or is NULL where bins
// are guides.
static void remove_candidates(struct hair_groom_builder* builder, const struct hair_strand_mix* mixes)
{
    uint32_t kept = 0;
    for (uint32_t bin = 0; bin < builder->bin_count; ++bin) {
        uint32_t first = builder->bin_first[bin], count = builder->bin_candidates[bin];
        builder->bin_first[bin] = kept;
        for (uint32_t i = first; i < first + count; ++i) {
            struct hair_strand_mix mix = {.weight = {1, 0, 0}};
            if (mixes)
                mix = mixes[i];
            else
                mix.strand[0] = builder->strand_of ? builder->strand_of[i] : builder->chosen[bin];
            if (!is_kept(builder, i, &mix)) continue;
            builder->number[kept] = i;
            if (builder->scalp_points) builder->scalp_points[kept] = builder->scalp_points[i];
            if (builder->strand_of) builder->strand_of[kept] = builder->strand_of[i];
            ++kept;
        }
        builder->bin_candidates[bin] = kept - builder->bin_first[bin];
    }
    builder->candidate_count = kept;
}

// Find the strands of each candidate that grows between guides.
static hair_result find_mixes(struct hair_groom_builder* builder, struct hair_strand_mix** out)
{
    *out = hair_alloc(builder->host, builder->candidate_count, sizeof **out);
    if (!*out) return hair_fail_memory(builder->host, "the guides of followers");
    return hair_scalp_mixes(builder, *out);
}

hair_result hair_thin_candidates(struct hair_groom_builder* builder)
{
    const uint32_t count = builder->candidate_count;
    bool has_map = hair_has_attribute(builder, HAIR_STRAND_ATTRIBUTE_DENSITY, true);
    bool has_values = hair_has_attribute(builder, HAIR_STRAND_ATTRIBUTE_DENSITY, false);
    struct hair_strand_mix* mixes = NULL;
    if (!has_map && !has_values) return HAIR_OK;
    if (has_map && !builder->scalp_points) return hair_fail_degenerate(builder);
    uint32_t* number = hair_alloc(builder->host, count, sizeof *number);
    if (!number) return hair_fail_memory(builder->host, "the density of followers");
    hair_result result = builder->is_scattered && has_values ? find_mixes(builder, &mixes) : HAIR_OK;
    builder->number = number;
    if (!result) remove_candidates(builder, mixes);
    hair_free(builder->host, mixes);
    if (result || builder->candidate_count) return result;
    return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                     "hair_groom_desc.strand_attributes: densities leave none of %u followers", count);
}
