// cut.c - built-in haircuts, for tests of their strands and scalps.
#include "tests/support/cut.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

struct hair_test_cut hair_test_cut_with(const struct hair_test_host* host, hair_style style, uint32_t guides,
                                        float length, uint32_t seed)
{
    hair_style_desc desc = hair_style_desc_default();
    desc.host = &host->host;
    desc.style = style;
    desc.guide_count = guides;
    desc.length = length;
    desc.seed = seed;
    struct hair_test_cut cut = {NULL, hair_asset_info_default(), 0};
    assert_int_equal(hair_asset_generate(&desc, &cut.asset), HAIR_OK);
    assert_int_equal(hair_asset_describe(cut.asset, &cut.info), HAIR_OK);
    cut.each = cut.info.strand_vertices[0];
    return cut;
}

struct hair_test_cut hair_test_cut_style(const struct hair_test_host* host, hair_style style)
{
    return hair_test_cut_with(host, style, 166, 1, 1);
}

hair_vec3 hair_test_cut_scalp(const struct hair_test_cut* cut, uint32_t i)
{
    return hair_load3(cut->info.scalp_positions + 3 * (size_t)i);
}
