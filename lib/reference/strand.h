// strand.h - what a look makes of a strand's way, in double precision.
#ifndef HAIR_REFERENCE_STRAND_H
#define HAIR_REFERENCE_STRAND_H

#include "lib/reference/convert.h"

struct along {
    double value, slope; // by t
};

struct astray {
    Vector3d at, slope; // in the guide's frame; m, by t
};

// A curve of a look at t in [0, 1].
along hair_reference_curve(const hair_curve& curve, double t);
// How far a strand follows its own guide alone.
along hair_reference_singleness(const hair_look& look, double t);
// The share of a strand that is drawn.
double hair_reference_share(const hair_look& look, uint32_t seed);
// What strays, kinks and curls together.
astray hair_reference_astray(const hair_look& look, uint32_t guide, uint32_t seed, double t, double length);

#endif
