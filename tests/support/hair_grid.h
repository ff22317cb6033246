// hair_grid.h - hair close together that tests set in motion.
#ifndef HAIR_TESTS_SUPPORT_HAIR_GRID_H
#define HAIR_TESTS_SUPPORT_HAIR_GRID_H

#include "tests/support/live_hair.h"

#include "lib/api/api.h"

#define HAIR_TEST_HAIR_GRID_VERTICES 12 // per guide

// Create 36 straight guides of 10 cm that hang from a square. Guides 2 i and 2 i + 1 are in the
// same place.
void hair_test_hair_grid(struct hair_test* test, const hair_desc* desc, float width,
                         struct hair_test_living* out);

// Return physics in which only the hair-hair grid acts, without gravity, air, pull or bending.
hair_physics hair_test_only_hair_grid(float cohesion, float volume);

// Set the state, and the velocity that a solver keeps beside it.
void hair_test_set_state(struct hair_test_living* living, const struct hair_state* state);
void* hair_test_buffer(GLuint buffer, size_t size); // Return its contents, to be freed.

#endif
