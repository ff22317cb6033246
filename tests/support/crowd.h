// crowd.h - hair close together, to be set in motion by hand.
#ifndef HAIR_TESTS_SUPPORT_CROWD_H
#define HAIR_TESTS_SUPPORT_CROWD_H

#include "tests/support/living.h"

#include "lib/api/api.h"

#define HAIR_TEST_CROWD_VERTICES 12 // of each guide

// 36 straight guides of 10 cm that hang from a square, each even one and the next in the same place.
void hair_test_crowd(struct hair_test* test, const hair_desc* desc, float width,
                     struct hair_test_living* out);

// Nothing acts but the crowd: no gravity, air, pull or bending.
hair_physics hair_test_only_crowd(float cohesion, float volume);

// The state, and the velocity that a solver keeps beside it.
void hair_test_set_state(struct hair_test_living* living, const struct hair_state* state);
void* hair_test_buffer(GLuint buffer, size_t size); // what it holds, to be freed

#endif
