// drag.glsl - air that carries strands along, as cylinders. What it does across and along a strand are rates at which a relative
// velocity decays. They are taken at the velocity before the substep, and the decay implicitly (BDF2, Euler) or exactly
// (SHAKE): so no air carries a strand past itself. What is done so, each direction by itself, comes before what bending does
// with it.
#ifndef HAIR_DRAG_GLSL
#define HAIR_DRAG_GLSL

#include "wind/air.glsl"
#include "wind/cylinder.glsl"

vec3 along; // unit
uint substep_number; // of the dispatch
vec2 drags; // h times the rates across and along
vec3 drifts; // what damping does by the air's velocity, and what drag does: h^2 times an acceleration

// Across and along, each its share.
vec3 by_parts(vec2 share, vec3 v)
{
    float a = dot(v, along);
    return share.x * (v - a * along) + share.y * a * along;
}

// At a vertex whose velocity is about hv / h. No drag is more than what takes a strand its length in a substep. `share`: of
// what its inertia would weigh.
void feel_air(uint i, vec3 before, float share, vec3 hv)
{
    float h     = SUBSTEP;
    vec3  after = GET(edge);
    vec3  sum   = (i > 0u ? before : after) + (i + 1u < guide_count ? after : before);
    float size  = length(sum), beside = i > 0u ? rod[guide_first + i - 1u].segment.x : 0.0;
    along       = size > 1e-3 ? sum / size : vec3(0.0, 1.0, 0.0);
    vec3  air   = h * air_at(root_then + GET(place), substep_number), past = air - hv;
    float faces = dot(past, along), across = length(past - faces * along);
    float light = min(0.5 * (beside + own(rest_length)) * own(slack), 1.0); // Not of what hangs on a tip.
    vec2  most  = guide_length / max(vec2(across, abs(faces)), vec2(1e-9));
    drags       = light * min(h * (wind.viscous * drag_of(across / h * wind.per_speed)), most);
    drifts      = share * params.damping * h * air + by_parts(drags, air);
}

// SHAKE: what a substep adds to d, by an acceleration and the air.
vec3 dragged_on(vec3 d, vec3 push)
{
    float h     = SUBSTEP, c = params.damping * h;
    vec2  x     = vec2(c) + drags;
    // (1 - exp(-x)) / x, without what rounding would leave of the difference where x is small.
    vec2  small = 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0)));
    vec2  share = mix((1.0 - exp(-x)) / max(x, 0.1), small, lessThan(x, vec2(0.1)));
    return by_parts(share, h * h * push + drifts - by_parts(x, d));
}

// BDF2 and Euler: what of all that acts on a strand its own velocity against the air leaves.
vec3 dragged_back(uint i, float b, vec3 sum)
{
    float h       = SUBSTEP;
    float massive = 1.0 + b * params.damping * h + b * b * h * h * own(aim).w;
    return by_parts(1.0 / (1.0 + b * drags / massive), sum);
}

#endif
