// reference_rod.h - rods of the reference in a plane, of unit length, density and stiffness.
#ifndef HAIR_TESTS_SUPPORT_REFERENCE_ROD_H
#define HAIR_TESTS_SUPPORT_REFERENCE_ROD_H

#include "lib/reference/rod.h"

#define HAIR_TEST_MOST HAIR_REFERENCE_ROD_MOST_VERTICES

struct hair_test_plane {
    struct hair_reference_rod_desc desc; // Must stay where it is: it points into the arrays.
    double positions[3 * HAIR_TEST_MOST], lengths[HAIR_TEST_MOST];
    double strain[3 * HAIR_TEST_MOST], real[HAIR_TEST_MOST];
};

// Straight, in the plane of x and y, `angle` from straight down (pi / 2: along x), gravity `gamma` along -y.
// Twist over bending as of hair, whose Poisson's ratio is .45. The clamp's k is 2.
void hair_test_plane_make(struct hair_test_plane* plane, uint32_t vertices, double angle, double gamma);
// Straight down, but curled up by `turn` in all when nothing pulls at it, and in that shape.
void hair_test_plane_curl(struct hair_test_plane* plane, double turn);

// Or the test fails.
struct hair_reference_rod* hair_test_rod(const struct hair_reference_rod_desc* desc);
void hair_test_rod_rest(struct hair_reference_rod* rod);
void hair_test_rod_tip(const struct hair_reference_rod* rod, double tip[3]);

// What becomes of a value whose error is a quarter with twice the segments.
double hair_test_extrapolate(double coarse, double fine);

#endif
