// curve.c - curves along strands.
#include <hair/hair.h>

hair_curve hair_curve_line(float root, float tip)
{
    hair_curve curve;
    for (int i = 0; i < 8; ++i) curve.at[i] = root + (tip - root) * (float)i / 7;
    return curve;
}
