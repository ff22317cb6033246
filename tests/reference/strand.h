// strand.h - Effects of a look on the shape of a strand, in double precision.
#ifndef HAIR_TESTS_REFERENCE_STRAND_H
#define HAIR_TESTS_REFERENCE_STRAND_H

#include "tests/reference/convert.h"

struct along {
    double value, slope; // `slope` is the derivative by t
};

struct astray {
    Vector3d at, slope; // in the guide's frame, m, `slope` is the derivative by t
};

// Evaluate a curve of a look at t in [0, 1].
along hair_reference_curve(const hair_curve& curve, double t);
// Return the weight of a strand's own guide alone.
along hair_reference_singleness(const hair_look& look, double t);
// Return the fraction of a strand that is drawn.
double hair_reference_fraction(const hair_look& look, uint32_t seed);
// Return the sum of strays, frizz and curls. `ratio` is the length of the strand in lengths of its
// guide.
astray hair_reference_astray(const hair_look& look, uint32_t guide, uint32_t seed, double t, double length,
                             double ratio);

#endif
