// strand.glsl - a vertex of a drawn strand: where, how wide and, where colour is asked for, its colour. Shading runs
// here and not for every sample of a pixel: along a strand light changes slowly, across it not at all.
#include "follower.glsl" // First: a file is put in where it is first named, be that left out or not.
#ifdef HAIR_EXPANDED
#include "expanded.glsl"
#else
#include "evaluate.glsl"
#endif
#include "shade.glsl"

struct strand_vertex {
    vec4 position; // xyz: m, from the head's origin; w: radius, m
    vec3 tangent;  // unit
    vec3 color;
};

vec3 shade(hair_follower follower, hair_point point, float t)
{
    hair_fragment f;
    f.position = point.position;
    f.tangent  = point.tangent;
    f.to_eye   = normalize(draw.eye.w > 0.0 ? draw.eye.xyz - point.position : draw.eye.xyz);
    f.t        = t;
    f.random   = random(follower.seed + 7u);
    f.seed     = follower.seed;
    f.lock     = follower.guide0;
    return hair_shade(f);
}

// The k-th vertex of a strand of so many segments, of which there may be a share: t.
float place_of(uint k, float segments) { return min(float(k) / segments, 1.0); }

// `width`: a share of its own.
strand_vertex strand_at(uint number, float t, float width)
{
    hair_follower follower = fetch_follower(number);
    hair_point    point    = evaluate(follower, number, t);
    vec3          color    = draw.colored != 0u ? shade(follower, point, t) : vec3(0.0);
    return strand_vertex(vec4(point.position, point.radius * width), point.tangent, color);
}
