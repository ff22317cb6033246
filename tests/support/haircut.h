// haircut.h - built-in haircuts, for tests of what is seen of hair.
#ifndef HAIR_TESTS_SUPPORT_HAIRCUT_H
#define HAIR_TESTS_SUPPORT_HAIRCUT_H

#include <hair/hair_asset.h>

#include "tests/support/support.h"

// As the style makes it, with so many followers. hair_groom_destroy undoes it.
hair_groom* hair_test_haircut(struct hair_test* test, const hair_style_desc* style, uint32_t followers);

#endif
