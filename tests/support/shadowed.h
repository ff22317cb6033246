// shadowed.h - hair under one light that has a shadow map of any range and direction of depth.
#ifndef HAIR_TESTS_SUPPORT_SHADOWED_H
#define HAIR_TESTS_SUPPORT_SHADOWED_H

#include "tests/support/scene.h"

#define HAIR_TEST_SHADOWED_SIZE 96 // Side of the pictures, pixels.
#define HAIR_TEST_SHADOW_TEXELS 128 // Side of the shadow map.

// Range and direction of depth.
struct hair_test_depth {
    bool is_zero_to_one, is_reversed;
};

// All four ranges and directions. The first is the default of OpenGL.
extern const struct hair_test_depth hair_test_depths[4];

struct hair_test_shadowed {
    struct hair_test_scene scene;
    hair_light light;
    float ours[16]; // Transform to the light's clip space, -1 near the light and 1 far from it.
    float pixels[4 * HAIR_TEST_SHADOWED_SIZE * HAIR_TEST_SHADOWED_SIZE];
    float expected[4 * HAIR_TEST_SHADOWED_SIZE * HAIR_TEST_SHADOWED_SIZE];
};

// Convert a matrix of clip space from -1 near to 1 far.
void hair_test_depth_convert(const float from[16], struct hair_test_depth as, float to[16]);

// Make hair under a sun or a spot light on +x.
void hair_test_shadowed_start(struct hair_test_shadowed* f, struct hair_test* test, hair_self_shadow method,
                              bool is_lamp);
// Draw the map as the application would, and give it to the light.
void hair_test_shadowed_draw_map(struct hair_test_shadowed* f, struct hair_test_depth as);
// Draw the hair in a view of that depth, and read the pixels.
void hair_test_shadowed_draw(struct hair_test_shadowed* f, struct hair_test_depth as, float* pixels);
// Restore the default depth, and free what hair_test_shadowed_start() made, and `f` itself.
void hair_test_shadowed_finish(struct hair_test_shadowed* f);

// Return the sum of the colours of a picture.
double hair_test_shadowed_sum(const float* pixels);
// Return the absolute difference of two pictures as a fraction of the second.
double hair_test_shadowed_difference(const float* a, const float* b);

#endif
