// golden.h - Comparison of pictures with those of an earlier run.
#ifndef HAIR_TESTS_SUPPORT_GOLDEN_H
#define HAIR_TESTS_SUPPORT_GOLDEN_H

#include <stddef.h>
#include <stdint.h>

// Read a PNG of exactly this size as RGB, 3 bytes a pixel. The test fails if this fails.
void hair_test_read_png(const char* path, uint8_t* pixels, uint32_t width, uint32_t height);

// Return the root mean square of the differences of the three channels, in [0, 1].
double hair_test_color_distance(const uint8_t* a, const uint8_t* b);

// Return the number of different colours, at five bits a channel.
size_t hair_test_distinct_colors(const uint8_t* pixels, uint32_t width, uint32_t height);

// Check that a picture equals tests/golden/llvmpipe/<name>.png within a tolerance, which is wider
// on zink. Other renderers check nothing. HAIR_BLESS in the environment writes the file first.
void hair_test_golden(const char* name, const uint8_t* pixels, uint32_t width, uint32_t height);

#endif
