// ride.glsl - the scalp motion of a guide's root, relative to the place that the head alone gives
// the root. hair_ride stores it.
#include "rotation.glsl"

struct ride {
    vec3 shift;
    vec4 turn;
};

// Return whether v is finite and plausible. The comparison is by bits, because compilers may remove
// comparisons with NaN.
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

// Return the scalp motion at a fraction of the step. A negative fraction, which only the start of a
// dispatch may have, selects the end of the substep before the step.
ride ride_at(uint guide_number, float share)
{
    if (share < 0.0) return ride_of(guide_number, HAIR_RIDE_THEN);
    return ride_between(ride_of(guide_number, HAIR_RIDE_START), ride_of(guide_number, HAIR_RIDE_END), share);
}

// Return the place that scalp motion gives to a place in the head at rest.
vec3 carry(ride r, vec3 root, vec3 place) { return root + r.shift + rotate(r.turn, place - root); }
// Return the place in the head at rest that scalp motion brings to `place`.
vec3 carry_back(ride r, vec3 root, vec3 place) { return root + rotate(quat_conjugate(r.turn), place - root - r.shift); }
#endif
