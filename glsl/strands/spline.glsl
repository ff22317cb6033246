// spline.glsl - uniform cubic B-splines: weights of the four control points around an interval, at
// x in [0, 1], and their derivatives.
#ifndef HAIR_SPLINE_GLSL
#define HAIR_SPLINE_GLSL

vec4 spline(float x)
{
    float s = 1.0 - x;
    return vec4(s * s * s, 4.0 + x * x * (3.0 * x - 6.0), 1.0 + x * (3.0 + x * (3.0 - 3.0 * x)), x * x * x) /
           6.0;
}

vec4 spline_slope(float x)
{
    float s = 1.0 - x;
    return 0.5 * vec4(-s * s, x * (3.0 * x - 4.0), 1.0 + x * (2.0 - 3.0 * x), x * x);
}

#endif
