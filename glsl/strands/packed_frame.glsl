// packed_frame.glsl - frames of smoothed guides in 64 bits, as HAIR_BIND_FRAME has them.
//
// A unit quaternion follows from its three smallest components, of 18 bits each. Their error is at
// most 2.7e-6. Two bits tell the largest component. The last 8 bits hold the stretch.
#ifndef HAIR_PACKED_FRAME_GLSL
#define HAIR_PACKED_FRAME_GLSL

#define FRAME_UNIT 5.3948378e-6 // sqrt(1/2) / 131071.

// Return a frame and the stretch of its segment, packed.
uvec2 pack_frame(vec4 q, float stretch)
{
    vec4 size = abs(q);
    bool is_late = max(size.z, size.w) > max(size.x, size.y);
    int  largest = is_late ? (size.w > size.z ? 3 : 2) : (size.y > size.x ? 1 : 0);
    vec3 small   = largest == 0 ? q.yzw : largest == 1 ? q.xzw : largest == 2 ? q.xyw : q.xyz;
    if (q[largest] < 0.0) small = -small;
    uvec3 bits = uvec3(ivec3(round(clamp(small / FRAME_UNIT, -131071.0, 131071.0)))) & 0x3ffffu;
    uint  last = uint(int(round(clamp(stretch / HAIR_FRAME_STRETCH, -127.0, 127.0))));
    return uvec2(bits.x | bits.y << 18, bits.y >> 14 | bits.z << 4 | uint(largest) << 22 | last << 24);
}

// Return a unit quaternion from a packed frame.
vec4 unpack_frame(uvec2 bits)
{
    ivec2 b = ivec2(bits);
    vec3  small = FRAME_UNIT * vec3(b.x << 14 >> 14, (b.y << 28 >> 14) | int(bits.x >> 18), b.y << 10 >> 14);
    float large = sqrt(max(1.0 - dot(small, small), 0.0));
    uint  largest = bits.y >> 22 & 3u;
    if (largest == 0u) return vec4(large, small);
    if (largest == 1u) return vec4(small.x, large, small.yz);
    return largest == 2u ? vec4(small.xy, large, small.z) : vec4(small, large);
}

// Return the stretch from a packed frame.
float unpack_stretch(uvec2 bits) { return HAIR_FRAME_STRETCH * float(int(bits.y) >> 24); }

// Return the y axis of a frame.
vec3 tangent_of(vec4 q)
{
    return vec3(2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
                2.0 * (q.y * q.z + q.w * q.x));
}

#endif
