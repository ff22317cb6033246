// gather.glsl - where a strand goes that is drawn wider, for those that are left out: as far as it reaches out farther to
// either side, it moves inwards among its neighbours. So they cover as much as before: the outline of them all stays, and
// inside it they are as much wider as they are fewer.
#include "follower.glsl"

// Strands near the middle move less than those that reach out farthest, and what the latter lack of `wider` is made up for.
#define FARTHER 1.4

// Of the three guides between which a follower grows; of its one guide where it has only that.
guide_point middle_of(hair_follower follower, float u)
{
    guide_point own = fetch_guide(follower.guide0, u, true);
    if (follower.multi == 0.0) return own;
    guide_point a = fetch_guide(follower.guide1, u, true), b = fetch_guide(follower.guide2, u, true);
    float       share = follower.multi / 3.0;
    own.position += share * (a.position + b.position - 2.0 * own.position);
    own.tangent = direction_or(own.tangent + share * (a.tangent + b.tangent - 2.0 * own.tangent), own.tangent);
    return own;
}

// `wider`: m, to either side. Returns by how much it moves, m. What is near the middle comes near to it, but not past it.
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
