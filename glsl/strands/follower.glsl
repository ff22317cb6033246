// follower.glsl - interpolation of a follower from guides, as shared.h defines it. Drawing code
// calls it through strands/evaluate.glsl.
#ifndef HAIR_FOLLOWER_GLSL
#define HAIR_FOLLOWER_GLSL

#include "rotation.glsl"
#include "strands/look.glsl"
#include "strands/fetch.glsl"

#ifdef HAIR_LENGTHS
layout(binding = HAIR_UNIT_LENGTH) uniform samplerBuffer length_texture;

// Fraction of its length that the follower has which was fetched last, above 0.
float kept = 1.0;

// Return t of the whole strand for t of the follower that was fetched last. Looks place everything
// on the whole strand, so that a cut does not move it.
float whole_t(float t) { return t * kept; }
#else
float whole_t(float t) { return t; }
#endif

// Return a follower, cut to the length that is drawn.
hair_follower fetch_follower(uint number)
{
    hair_follower follower = fetch_whole(number);
    note_fetched(number);
#ifdef HAIR_LENGTHS
    kept = clamp(texelFetch(length_texture, int(number)).x, 1e-4, 1.0);
#endif
#ifdef HAIR_STYLED
    cut(follower);
#endif
    return follower;
}

struct hair_point {
    vec3  position; // m, from the head's origin.
    vec3  tangent;  // Unit.
    float radius;   // m.
};

struct guide_point {
    vec3  position, tangent;
    vec3  bend;         // Derivative of the tangent by u.
    float guide_length; // m, approximate.
};

struct guide_place { // A position between a sample of a smoothed guide and the next.
    int   at;
    float fraction;
};

guide_place find_place(uint number, float u)
{
    float along = min(u, 1.0) * float(draw.smooth_vertices - 1u);
    int   k     = min(int(along), int(draw.smooth_vertices) - 2);
    return guide_place(int(number * draw.smooth_vertices) + k, along - float(k));
}

// Return a point of a guide at u. Beyond its tip, with u > 1, a guide goes on straight where
// `beyond` allows it. Otherwise the position does not depend on tangents.
guide_point fetch_guide(uint number, float u, bool beyond)
{
    guide_place place = find_place(number, u);
    vec4        a     = fetch_position(place.at);
    vec4        b     = fetch_position(place.at + 1);
    vec3        ta    = tangent_of(fetch_turn(place.at));
    vec3        tb    = tangent_of(fetch_turn(place.at + 1));
    vec4        p     = mix(a, b, place.fraction);
    vec3        t     = direction_or(mix(ta, tb, place.fraction), ta);
    float       more  = max(u - 1.0, 0.0) * b.w;
    float       each  = float(draw.smooth_vertices - 1u);
    vec3        bend  = u < 1.0 ? each * (tb - ta) : vec3(0.0);
    return guide_point(beyond ? p.xyz + more * t : p.xyz, t, bend, each * (b.w - a.w));
}

float fetch_length(uint number)
{
    return fetch_position(int((number + 1u) * draw.smooth_vertices) - 1).w;
}

vec4 fetch_frame(uint number, float u)
{
    guide_place place = find_place(number, u);
    vec4        a     = fetch_turn(place.at);
    vec4        b     = fetch_turn(place.at + 1);
    return normalize(mix(a, dot(a, b) < 0.0 ? -b : b, place.fraction));
}

// Repair at t of a follower that meets a collider.
struct repair {
    vec3  away, away_slope;   // Displacement, m, and its derivative by t.
    // Blend from all guides to its own guide alone, [0, 1], and its derivative by t.
    float freed, freed_slope;
};
const repair UNTOUCHED = repair(vec3(0.0), vec3(0.0), 0.0, 0.0);

#include "strands/shape.glsl"

// Return a point of a follower. Beyond t = 1 it goes on straight. `beyond` allows the follower to
// be longer than its guides.
hair_point interpolate(hair_follower follower, float t, repair r, bool beyond)
{
    t = whole_t(t);
#ifdef HAIR_LENGTHS
    r.away_slope  /= kept;
    r.freed_slope /= kept;
#endif
    if (follower.multi < 0.0) return interpolate_own(follower, t, r);
    float       u       = t * follower.length_ratio;
    float       v       = min(t, 1.0);
    float       s       = 1.0 - v;
    guide_point g0      = fetch_guide(follower.guide0, u, beyond);
    vec4        frame   = fetch_frame(follower.guide0, u);
    float       length_ = follower.length_ratio * fetch_length(follower.guide0);
    vec2        clump = GROUP_FACTOR(group_of(follower), clump) * STRAND_FACTOR(HAIR_FACTOR_CLUMP) *
                        curve_at(HAIR_CURVE_CLUMP, v);
    vec2        width = curve_at(HAIR_CURVE_CLUMP_WIDTH, v);

    vec3 offset = s * s * s * follower.offset[0].xyz + 3.0 * s * s * v * follower.offset[1].xyz +
                  3.0 * s * v * v * follower.offset[2].xyz + v * v * v * follower.offset[3].xyz;
    vec3 slope = 3.0 * (s * s * (follower.offset[1].xyz - follower.offset[0].xyz) +
                        2.0 * s * v * (follower.offset[2].xyz - follower.offset[1].xyz) +
                        v * v * (follower.offset[3].xyz - follower.offset[2].xyz));
    slope  = width.x * slope + width.y * offset;
    offset = width.x * offset;

    // Multi-strand where the follower does not clump. Tangents are derivatives by t.
    vec3  position = g0.position, along = length_ * g0.tangent;
    float multi       = follower.multi * (1.0 - clump.x) * (1.0 - r.freed);
    float multi_slope = -follower.multi * (clump.y * (1.0 - r.freed) + (1.0 - clump.x) * r.freed_slope);
    if (multi > 0.0 || multi_slope != 0.0) {
        guide_point g1 = fetch_guide(follower.guide1, u, beyond);
        guide_point g2 = fetch_guide(follower.guide2, u, beyond);
        float       w1 = follower.weight1, w2 = follower.weight2, w0 = 1.0 - w1 - w2;
        vec3        own     = vec3(follower.offset[1].w, follower.offset[2].w, follower.offset[3].w);
        vec3        blended = w0 * g0.position + w1 * g1.position + w2 * g2.position;
        vec3 beside = w0 * along + follower.length_ratio * (w1 * g1.guide_length * g1.tangent +
                                                            w2 * g2.guide_length * g2.tangent);
        along    = mix(along, beside, multi) + multi_slope * (blended - position);
        position = mix(position, blended, multi);
        slope    = (1.0 - multi) * slope + multi_slope * (own - offset);
        offset   = mix(offset, own, multi);
    }

    aside a = find_aside(follower, v, length_);
    offset.xz += a.at;
    slope.xz  += a.slope;
    vec3 turned = rotate(frame, offset);
    // The frame turns with the strand, so a point on the inside of a bend moves more slowly.
    along += rotate(frame, slope) + r.away_slope - follower.length_ratio * dot(g0.bend, turned) * g0.tangent;
    float radius = draw.radius * follower.offset[0].w * curve_at(HAIR_CURVE_TAPER, v).x;
    return hair_point(position + turned + r.away, direction_or(along, g0.tangent), radius);
}

hair_point interpolate(hair_follower follower, float t, repair r)
{
    return interpolate(follower, t, r, true);
}

#endif
