// looks.h - straight hair whose followers are read with one look after the other.
#ifndef HAIR_TESTS_SUPPORT_LOOKS_H
#define HAIR_TESTS_SUPPORT_LOOKS_H

#include "tests/support/scene.h"

#define HAIR_TEST_LOOK_FOLLOWERS 4000

// Create straight guides. Offsets by the look are then perpendicular to a line.
struct hair_test_scene hair_test_look_scene(struct hair_test* test, uint32_t guides);
// Return the vertices of all followers with a look, which the instance keeps. Free the result.
float* hair_test_read_look(const struct hair_test_scene* scene, const hair_look* look);
// Return the distance of vertex i of two arrays, m.
double hair_test_distance_at(const float* a, const float* b, size_t i);

#endif
