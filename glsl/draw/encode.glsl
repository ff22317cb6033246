// encode.glsl - encoding of a colour for framebuffers that store sRGB values (IEC 61966-2-1).
#include "shared.h"

#define ENCODING_SRGB 1u // Value of hair_encoding.

vec3 encode_color(vec3 color, uint encoding)
{
    if (encoding != ENCODING_SRGB) return color;
    vec3 curve = 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055;
    return mix(12.92 * color, curve, greaterThan(color, vec3(0.0031308)));
}
