// cut.h - built-in haircuts, for tests of their strands and scalps.
#ifndef HAIR_TESTS_SUPPORT_CUT_H
#define HAIR_TESTS_SUPPORT_CUT_H

#include <hair/hair_asset.h>

#include "lib/base/math.h"
#include "tests/support/host.h"

// A built-in haircut and its description.
struct hair_test_cut {
    hair_asset* asset;
    hair_asset_info info;
    uint32_t each; // Vertices of a guide.
};

// Generate a haircut. Free its asset.
struct hair_test_cut hair_test_cut_with(const struct hair_test_host* host, hair_style style, uint32_t guides,
                                        float length, uint32_t seed);
// Generate the haircut of a style with few guides.
struct hair_test_cut hair_test_cut_style(const struct hair_test_host* host, hair_style style);
// Return the position of a vertex of the scalp.
hair_vec3 hair_test_cut_scalp(const struct hair_test_cut* cut, uint32_t i);

#endif
