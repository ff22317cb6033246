// curve.c - curves along strands.
#include "lib/base/curve.h"

hair_curve hair_curve_line(float root, float tip)
{
    hair_curve curve;
    for (int i = 0; i < 8; ++i) curve.at[i] = root + (tip - root) * (float)i / 7;
    return curve;
}

// Return the slope between two intervals as the harmonic mean of their rises, which prevents
// overshoot (Fritsch and Butland 1984).
static float inner_slope(float before, float after)
{
    return before * after > 0 ? 2 * before * after / (before + after) : 0;
}

// Return the slope at an end, from the parabola that meets the slope next to it. A slope against
// the rise becomes 0.
static float end_slope(float rise, float next)
{
    float slope = 1.5f * rise - 0.5f * next;
    return slope * rise > 0 ? slope : 0;
}

hair_vec4 hair_cubic_between(float a, float b, float slope_a, float slope_b)
{
    float rise = b - a;
    return (hair_vec4){a, slope_a, 3 * rise - 2 * slope_a - slope_b, slope_a + slope_b - 2 * rise};
}

void hair_curve_to_cubics(const hair_curve* curve, hair_vec4 out[7])
{
    float slope[8], rise[7];
    for (int i = 0; i < 7; ++i) rise[i] = curve->at[i + 1] - curve->at[i];
    for (int i = 1; i < 7; ++i) slope[i] = inner_slope(rise[i - 1], rise[i]);
    slope[0] = end_slope(rise[0], slope[1]);
    slope[7] = end_slope(rise[6], slope[6]);
    for (int i = 0; i < 7; ++i)
        out[i] = hair_cubic_between(curve->at[i], curve->at[i + 1], slope[i], slope[i + 1]);
}
