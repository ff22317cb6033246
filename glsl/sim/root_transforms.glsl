// root_transforms.glsl - the scalp motion of a guide's root, relative to the place that the head
// alone gives the root. hair_root_transform stores it.
#include "rotation.glsl"

struct root_transform {
    vec3 shift;
    vec4 turn;
};

// Return whether v is finite and plausible. The comparison is by bits, because compilers may remove
// comparisons with NaN.
bool is_sound(vec4 v) { return (floatBitsToUint(dot(v, v)) & 0x7fffffffu) < floatBitsToUint(1e8); }

root_transform root_transform_between(root_transform a, root_transform b, float fraction)
{
    vec4  turn = mix(a.turn, dot(a.turn, b.turn) < 0.0 ? -b.turn : b.turn, fraction);
    float l    = length(turn);
    return root_transform(mix(a.shift, b.shift, fraction), l > 1e-6 ? turn / l : vec4(0.0, 0.0, 0.0, 1.0));
}

#ifdef HAIR_SKINNED
layout(binding = HAIR_UNIT_ROOT_TRANSFORM) uniform samplerBuffer root_transform_texture;

root_transform root_transform_of(uint guide_number, int which)
{
    int at = int(guide_number) * 2 * HAIR_ROOT_TRANSFORMS + which;
    return root_transform(texelFetch(root_transform_texture, at).xyz,
                          texelFetch(root_transform_texture, at + HAIR_ROOT_TRANSFORMS));
}

// Return the scalp motion at a fraction of the step. A negative fraction, which only the start of a
// dispatch may have, selects the end of the substep before the step.
root_transform root_transform_at(uint guide_number, float fraction)
{
    if (fraction < 0.0) return root_transform_of(guide_number, HAIR_ROOT_TRANSFORM_THEN);
    return root_transform_between(root_transform_of(guide_number, HAIR_ROOT_TRANSFORM_START),
                                  root_transform_of(guide_number, HAIR_ROOT_TRANSFORM_END), fraction);
}

// Return the place that scalp motion gives to a place in the head at rest.
vec3 carry(root_transform r, vec3 root, vec3 place) { return root + r.shift + rotate(r.turn, place - root); }
// Return the place in the head at rest that scalp motion brings to `place`.
vec3 carry_back(root_transform r, vec3 root, vec3 place)
{
    return root + rotate(quat_conjugate(r.turn), place - root - r.shift);
}
#endif
