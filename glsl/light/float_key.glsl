// float_key.glsl - an encoding of floats as bits in the order of the floats, for atomic minima and
// maxima.
#ifndef HAIR_FLOAT_KEY_GLSL
#define HAIR_FLOAT_KEY_GLSL

uvec3 to_float_key(vec3 x)
{
    uvec3 b = floatBitsToUint(x);
    return mix(b | 0x80000000u, ~b, notEqual(b & 0x80000000u, uvec3(0u)));
}

vec3 from_float_key(uvec3 u)
{
    return uintBitsToFloat(mix(~u, u & 0x7fffffffu, notEqual(u & 0x80000000u, uvec3(0u))));
}

#endif
