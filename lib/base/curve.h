// curve.h - curves along strands as cubic polynomials.
#ifndef HAIR_BASE_CURVE_H
#define HAIR_BASE_CURVE_H

#include <hair/hair_look.h>

#include "glsl/shared.h"

// Return the cubic from a to b with these slopes at both ends. The slopes are per interval.
hair_vec4 hair_cubic_between(float a, float b, float slope_a, float slope_b);

// Write the polynomials of the 7 intervals of a curve, by powers of the place in the interval.
void hair_curve_to_cubics(const hair_curve* curve, hair_vec4 out[7]);

#endif
