// skinned.h - hair on a scalp that an application skins.
#ifndef HAIR_TESTS_SUPPORT_SKINNED_H
#define HAIR_TESTS_SUPPORT_SKINNED_H

#include "tests/support/grooms.h"
#include "tests/support/support.h"

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
    float positions[3 * HAIR_TEST_SCALP_VERTICES]; // The same vertices as they move.
};

// Make hair on the level scalp at rest. Free it with hair_destroy().
struct hair_test_skinned hair_test_skinned_make(struct hair_test* test, hair_solver solver,
                                                hair_thread_mapping mapping);
// Pass the positions of the scalp from memory.
void hair_test_skinned_set(struct hair_test* test, struct hair_test_skinned* s);
// Move the positions by waves over the scalp.
void hair_test_skinned_bulge(struct hair_test_skinned* s, float time);

#define HAIR_TEST_POINTS 8192

// Vertices that were read.
struct hair_test_points {
    float at[3 * HAIR_TEST_POINTS];
    uint32_t count;
};

// Read vertices, which must be finite.
void hair_test_skinned_read(struct hair_test* test, const struct hair_test_skinned* s, hair_read_source what,
                            struct hair_test_points* seen);
// Return the maximum distance of two vertices of the same index, m.
double hair_test_points_distance(const struct hair_test_points* a, const struct hair_test_points* b);

#endif
