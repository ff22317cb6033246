// reference_guide.h - a guide of the reference, and checks of its points.
#ifndef HAIR_TESTS_SUPPORT_REFERENCE_GUIDE_H
#define HAIR_TESTS_SUPPORT_REFERENCE_GUIDE_H

#include "tests/support/support.h" // before what includes OpenGL's own header

#include "tests/reference/reference.h"

// Guide with the parameters and the state of a step.
struct hair_test_guide {
    struct hair_guide guide;
    struct hair_rest rest[HAIR_MAX_GUIDE_VERTICES];
    struct hair_step_params params;
    struct hair_reference_vertex state[HAIR_MAX_GUIDE_VERTICES];
};

// Return the guide for the functions of the reference.
struct hair_reference_guide hair_test_guide_whole(const struct hair_test_guide* f);
// Make a guide of `count` vertices with links of length `link`, straight down from the origin.
struct hair_test_guide hair_test_guide_straight_down(uint32_t count, float link);
// Return the distance of two points.
double hair_test_distance3(const double* a, const double* b);
// Check the three coordinates of a point.
void hair_test_near3(const char* what, const double* a, double x, double y, double z, double tolerance);

#endif
