// attributes.c - factors of strands from the attributes of an application.
#include "lib/asset/arrays.h"

#include <math.h>

struct hair_attribute_range hair_attribute_range_of(hair_strand_attribute_kind kind)
{
    static const struct hair_attribute_range ranges[] = {
        [HAIR_STRAND_ATTRIBUTE_STIFFNESS] = {0, 100},
        [HAIR_STRAND_ATTRIBUTE_DAMPING] = {0, 100},
        [HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY] = {0, 100},
        [HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD] = {0, 100},
        [HAIR_STRAND_ATTRIBUTE_CLUMP] = {0, 1},
        [HAIR_STRAND_ATTRIBUTE_CURL_RADIUS] = {0, 4},
        [HAIR_STRAND_ATTRIBUTE_CURL_FREQUENCY] = {0, 4},
        [HAIR_STRAND_ATTRIBUTE_FRIZZ] = {0, 4},
        [HAIR_STRAND_ATTRIBUTE_ROUGHNESS] = {0.2f, 4},
        [HAIR_STRAND_ATTRIBUTE_RADIUS] = {0, 4},
        [HAIR_STRAND_ATTRIBUTE_LENGTH] = {0.01f, 1},
        [HAIR_STRAND_ATTRIBUTE_DENSITY] = {0, 1},
    };
    _Static_assert(sizeof ranges / sizeof *ranges == HAIR_ATTRIBUTE_KINDS, "each kind has a range");
    HAIR_ASSERT((size_t)kind < HAIR_ATTRIBUTE_KINDS);
    return ranges[kind];
}

static hair_result check_values(const hair_host* host, const hair_groom_desc* desc, uint32_t index)
{
    const hair_strand_attribute* attribute = &desc->strand_attributes[index];
    struct hair_attribute_range range = hair_attribute_range_of(attribute->kind);
    for (uint32_t i = 0; i < desc->strand_count; ++i) {
        float value = attribute->strand_values[i];
        if (!(value >= range.min && value <= range.max)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.strand_attributes[%u].strand_values[%u] is %g, not in [%g, %g]",
                             index, i, (double)value, (double)range.min, (double)range.max);
    }
    return HAIR_OK;
}

// Multiply the factors of strands by those of an attribute.
static hair_result multiply_factors(const hair_host* host, const hair_strand_attribute* attribute,
                                    struct hair_strands* strands)
{
    float max = hair_attribute_range_of(attribute->kind).max;
    float** factors = &strands->factors[attribute->kind];
    bool is_new = !*factors;
    if (is_new) *factors = hair_alloc(host, strands->strand_count, sizeof **factors);
    if (!*factors) return hair_fail_memory(host, "the attributes of strands");
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        (*factors)[i] = fminf((is_new ? 1 : (*factors)[i]) * attribute->strand_values[i], max);
    return HAIR_OK;
}

hair_result hair_strands_copy_factors(const hair_host* host, const hair_groom_desc* desc,
                                      struct hair_strands* strands)
{
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i) {
        if (!desc->strand_attributes[i].strand_values) continue;
        HAIR_TRY(check_values(host, desc, i));
        HAIR_TRY(multiply_factors(host, &desc->strand_attributes[i], strands));
    }
    return HAIR_OK;
}
