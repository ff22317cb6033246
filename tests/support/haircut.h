// haircut.h - built-in haircuts, for tests of what is seen of hair.
#ifndef HAIR_TESTS_SUPPORT_HAIRCUT_H
#define HAIR_TESTS_SUPPORT_HAIRCUT_H

#include <hair/hair_asset.h>

#include "tests/support/support.h"

// As the style makes it, with so many followers. hair_groom_destroy undoes it.
hair_groom* hair_test_haircut(struct hair_test* test, const hair_style_desc* style, uint32_t followers);

// Worn in 24 segments, of strands of that radius, m; all else as it comes. hair_destroy undoes it, then hair_groom_destroy.
hair_instance* hair_test_wear(struct hair_test* test, hair_style style, uint32_t followers, float radius,
                              hair_groom** groom);

#endif
