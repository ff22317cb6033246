// lod_contract.glsl - displacement of strands that are drawn wider to compensate for strands that
// are left out. A strand moves towards the middle of its neighbours by the width that it gains. The
// outline of all strands stays, and inside it their total coverage stays.
#include "strands/follower.glsl"

// Factor of the movement. It exceeds 1 because strands near the middle move less than the outermost
// strands.
#define FARTHER 1.4

// Return the mean point of the three guides between which a follower grows. A single-strand
// follower has only its own guide.
guide_point middle_of(hair_follower follower, float u)
{
    guide_point own = fetch_guide(follower.guide0, u, true);
    if (follower.multi == 0.0) return own;
    guide_point a = fetch_guide(follower.guide1, u, true), b = fetch_guide(follower.guide2, u, true);
    float       fraction = follower.multi / 3.0;
    own.position += fraction * (a.position + b.position - 2.0 * own.position);
    own.tangent =
        direction_or(own.tangent + fraction * (a.tangent + b.tangent - 2.0 * own.tangent), own.tangent);
    return own;
}

// Move a point towards the middle of its guides and return the displacement, m. `wider` is the
// widening to either side, m. A point near the middle comes close to it but does not pass it.
vec3 gather(hair_follower follower, float t, float wider, inout hair_point point)
{
    guide_point middle = middle_of(follower, t * follower.length_ratio);
    vec3        from   = point.position - middle.position;
    float       away   = length(from), left = away / max(away + FARTHER * wider, 1e-12);
    vec3        moved  = (left - 1.0) * from;
    point.position += moved;
    point.tangent = direction_or(mix(middle.tangent, point.tangent, left), point.tangent);
    return moved;
}
