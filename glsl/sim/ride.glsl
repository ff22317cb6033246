// ride.glsl - where a skinned scalp has a guide's root, against where the head alone would have it. See hair_ride.
#include "rotation.glsl"

struct ride {
    vec3 shift;
    vec4 turn;
};

// By the bits, for comparisons with NaN may be compiled away. Too far, too, is where no hair is.
bool is_sound(vec4 v) { return (floatBitsToUint(dot(v, v)) & 0x7fffffffu) < floatBitsToUint(1e8); }

ride ride_between(ride a, ride b, float share)
{
    vec4  turn = mix(a.turn, dot(a.turn, b.turn) < 0.0 ? -b.turn : b.turn, share);
    float l    = length(turn);
    return ride(mix(a.shift, b.shift, share), l > 1e-6 ? turn / l : vec4(0.0, 0.0, 0.0, 1.0));
}

#ifdef HAIR_SKINNED
layout(binding = HAIR_UNIT_RIDE) uniform samplerBuffer ride_texture;

ride ride_of(uint guide_number, int which)
{
    int at = int(guide_number) * 2 * HAIR_RIDES + which;
    return ride(texelFetch(ride_texture, at).xyz, texelFetch(ride_texture, at + HAIR_RIDES));
}

// At a share of the step; below 0, as only a dispatch's start may be, where the substep before it ended.
ride ride_at(uint guide_number, float share)
{
    if (share < 0.0) return ride_of(guide_number, HAIR_RIDE_THEN);
    return ride_between(ride_of(guide_number, HAIR_RIDE_START), ride_of(guide_number, HAIR_RIDE_END), share);
}

// A place in the head at rest, carried along; and back.
vec3 carry(ride r, vec3 root, vec3 place) { return root + r.shift + rotate(r.turn, place - root); }
vec3 carry_back(ride r, vec3 root, vec3 place) { return root + rotate(quat_conjugate(r.turn), place - root - r.shift); }
#endif
