// haircut.h - built-in haircuts, for tests of how hair looks.
#ifndef HAIR_TESTS_SUPPORT_HAIRCUT_H
#define HAIR_TESTS_SUPPORT_HAIRCUT_H

#include <hair/hair_asset.h>

#include "tests/support/support.h"

// Make the groom of a style with `followers` followers. Free it with hair_groom_destroy().
hair_groom* hair_test_haircut(struct hair_test* test, const hair_style_desc* style, uint32_t followers);

// Make an instance of a style, in 24 segments and with strands of `radius`, m. The rest is at its
// default. Free it with hair_destroy(), then hair_groom_destroy().
hair_instance* hair_test_wear(struct hair_test* test, hair_style style, uint32_t followers, float radius,
                              hair_groom** groom);

#endif
