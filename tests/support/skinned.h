// skinned.h - hair on a scalp that an application skins.
#ifndef HAIR_TESTS_SUPPORT_SKINNED_H
#define HAIR_TESTS_SUPPORT_SKINNED_H

#include "tests/support/grooms.h"
#include "tests/support/scene.h"

#define HAIR_TEST_SCALP_CELLS 4
#define HAIR_TEST_SCALP_VERTICES ((HAIR_TEST_SCALP_CELLS + 1) * (HAIR_TEST_SCALP_CELLS + 1))
#define HAIR_TEST_SCALP_SIDE 0.2f // m
#define HAIR_TEST_SCALP_GUIDES 37 // at the scalp's vertices and between some of them
#define HAIR_TEST_SCALP_FOLLOWERS 300
#define HAIR_TEST_SCALP_SEGMENTS 8

// Hair on a scalp that the application skins. The groom has been destroyed.
struct hair_test_skinned {
    hair_instance* hair;
    float rest[3 * HAIR_TEST_SCALP_VERTICES]; // Vertices of the scalp.
    float positions[3 * HAIR_TEST_SCALP_VERTICES]; // Vertices as they move.
};

// Make hair on the level scalp at rest. Free it with hair_destroy().
struct hair_test_skinned hair_test_skinned_make(struct hair_test* test, hair_solver solver,
                                                hair_thread_mapping mapping);
// Pass the positions of the scalp from memory.
void hair_test_skinned_set(struct hair_test* test, struct hair_test_skinned* s);
// Move the positions by waves over the scalp.
void hair_test_skinned_bulge(struct hair_test_skinned* s, float time);

#endif
