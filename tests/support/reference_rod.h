// reference_rod.h - rods of the reference in a plane, with unit length, density and stiffness.
#ifndef HAIR_TESTS_SUPPORT_REFERENCE_ROD_H
#define HAIR_TESTS_SUPPORT_REFERENCE_ROD_H

#include "tests/reference/rod.h"

#define HAIR_TEST_MAX HAIR_REFERENCE_ROD_MAX_VERTICES

struct hair_test_plane {
    struct hair_reference_rod_desc desc; // It points into the arrays, so the struct must not move.
    double positions[3 * HAIR_TEST_MAX], lengths[HAIR_TEST_MAX];
    double strain[3 * HAIR_TEST_MAX], real[HAIR_TEST_MAX];
};

// Make a straight rod in the plane of x and y, with gravity `gamma` along -y. `angle` is measured
// from straight down, so pi / 2 is along x. Twist over bending is as for hair, whose Poisson's
// ratio is .45. The clamp's k is 2.
void hair_test_plane_make(struct hair_test_plane* plane, uint32_t vertices, double angle, double gamma);
// Curl a rod that hangs straight down, at rest and in its shape, by a total angle of `turn`.
void hair_test_plane_curl(struct hair_test_plane* plane, double turn);

// Create a rod. The test fails if this fails.
struct hair_reference_rod* hair_test_rod(const struct hair_reference_rod_desc* desc);
void hair_test_rod_rest(struct hair_reference_rod* rod);
void hair_test_rod_tip(const struct hair_reference_rod* rod, double tip[3]);

// Return the limit of a value whose error falls to a quarter if the number of segments doubles.
double hair_test_extrapolate(double coarse, double fine);

#endif
