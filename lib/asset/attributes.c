// attributes.c - names and ranges of the attributes of strands, and factors of strands from the
// attributes of an application.
#include "lib/asset/arrays.h"

#include <math.h>

// Names are those of the values of hair_strand_attribute_kind. Files have them, too.
static const struct attribute_kind {
    const char* name;
    struct hair_attribute_range range;
} attribute_kinds[] = {
    [HAIR_STRAND_ATTRIBUTE_STIFFNESS] = {"stiffness", {0, 100}},
    [HAIR_STRAND_ATTRIBUTE_DAMPING] = {"damping", {0, 100}},
    [HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY] = {"shape_frequency", {0, 100}},
    [HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD] = {"gravity_preload", {0, 100}},
    [HAIR_STRAND_ATTRIBUTE_CLUMP] = {"clump", {0, 1}},
    [HAIR_STRAND_ATTRIBUTE_CURL_RADIUS] = {"curl_radius", {0, 4}},
    [HAIR_STRAND_ATTRIBUTE_CURL_FREQUENCY] = {"curl_frequency", {0, 4}},
    [HAIR_STRAND_ATTRIBUTE_FRIZZ] = {"frizz", {0, 4}},
    [HAIR_STRAND_ATTRIBUTE_ROUGHNESS] = {"roughness", {0.2f, 4}},
    [HAIR_STRAND_ATTRIBUTE_RADIUS] = {"radius", {0, 4}},
    [HAIR_STRAND_ATTRIBUTE_LENGTH] = {"length", {0.01f, 1}},
    [HAIR_STRAND_ATTRIBUTE_DENSITY] = {"density", {0, 1}},
};
_Static_assert(sizeof attribute_kinds / sizeof *attribute_kinds == HAIR_ATTRIBUTE_KINDS,
               "each kind has a range");

struct hair_attribute_range hair_attribute_range_of(hair_strand_attribute_kind kind)
{
    HAIR_ASSERT((size_t)kind < HAIR_ATTRIBUTE_KINDS);
    return attribute_kinds[kind].range;
}

const char* hair_attribute_name_of(hair_strand_attribute_kind kind)
{
    HAIR_ASSERT((size_t)kind < HAIR_ATTRIBUTE_KINDS);
    return attribute_kinds[kind].name;
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

// Assets ------------------------------------------------------------------------------------------

hair_strand_attribute* hair_asset_add_attribute(hair_asset* asset, hair_strand_attribute_kind kind)
{
    HAIR_ASSERT(asset->attribute_count < HAIR_MAX_ATTRIBUTES);
    hair_strand_attribute* attribute = &asset->attributes[asset->attribute_count++];
    *attribute = hair_strand_attribute_default();
    attribute->kind = kind;
    return attribute;
}

static hair_strand_attribute* find_attribute(hair_asset* asset, hair_strand_attribute_kind kind)
{
    for (uint32_t i = 0; i < asset->attribute_count; ++i)
        if (asset->attributes[i].kind == kind) return &asset->attributes[i];
    return NULL;
}

uint32_t hair_asset_count_attributes(hair_asset* asset)
{
    uint32_t count = asset->attribute_count;
    for (int kind = 0; kind < HAIR_ATTRIBUTE_KINDS; ++kind)
        count += asset->strands.factors[kind] && !find_attribute(asset, (hair_strand_attribute_kind)kind);
    return count;
}

void hair_asset_link_factors(hair_asset* asset)
{
    for (int i = 0; i < HAIR_ATTRIBUTE_KINDS; ++i) {
        hair_strand_attribute_kind kind = (hair_strand_attribute_kind)i;
        if (!asset->strands.factors[i]) continue;
        hair_strand_attribute* attribute = find_attribute(asset, kind);
        if (!attribute) attribute = hair_asset_add_attribute(asset, kind);
        attribute->strand_values = asset->strands.factors[i];
    }
}
