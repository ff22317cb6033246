// packed.glsl - packing of strand vertices for storage. See HAIR_BIND_CACHED_TANGENT and
// HAIR_BIND_SHADED.
#ifndef HAIR_PACKED_GLSL
#define HAIR_PACKED_GLSL

#include "shared.h"

uvec2 pack_tangent(vec3 tangent)
{
    vec3 fraction = tangent * 0.5 + 0.5;
    return uvec2(packUnorm2x16(fraction.xy), packUnorm2x16(vec2(fraction.z, 0.0)));
}

vec3 unpack_tangent(uvec2 numbers)
{
    return vec3(unpackUnorm2x16(numbers.x), unpackUnorm2x16(numbers.y).x) * 2.0 - 1.0;
}

uvec2 pack_color(vec3 color)
{
    color = min(color, HAIR_MAX_LIGHT);
    return uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 1.0)));
}

#endif
