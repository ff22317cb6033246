// raster_quad.glsl - the ribbon of a segment as a quadrilateral in the window, and what it is at a
// position: its fraction along the strand, and its depth.
#include "draw/raster.glsl"

// The visible part of a ribbon in the window. It is a quadrilateral whose ends are those of its
// neighbours, drawn as two triangles. Positions are in pixels from `origin`. A linear function has
// the value x a + y b + z at the position (a, b).
struct raster_quad {
    vec2  origin;     // Pixels.
    vec3  corner[4];  // Two at each end, with their depth.
    vec3  ends[2];    // 0 at one end, 1 at the corner of the other that is on the diagonal.
    vec3  sides[2];   // Distances from both sides, positive between them, pixels.
    vec3  diagonal;   // Distance from the common side of both triangles, positive at the first.
    vec3  across;     // Distance from the middle line, pixels.
    float half_width; // Greatest distance of a corner from the middle line, pixels.
    bool  there;
    bool  simple; // The ribbon is thin and does not cross itself.
};

#define THIN 8.0 // Pixels of half the width up to which depth is nearly bilinear.

float turn(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

float at_place(vec3 linear, vec2 place) { return dot(linear.xy, place) + linear.z; }

// Return the distance from a line through `at`, positive towards `inwards`. The line has the
// direction `way`, unless that is too short.
vec3 distance_from(vec2 at, vec2 way, vec2 inwards)
{
    float l = length(way);
    vec2  n = l > 1e-6 ? vec2(-way.y, way.x) / l : normalize(inwards);
    if (dot(n, inwards) < 0.0) n = -n;
    return vec3(n, -dot(n, at));
}

// Write the linear functions of a quadrilateral with its corners. If it crosses itself, they are
// those of one with perpendicular ends.
void find_edges(inout raster_quad q)
{
    vec2 from = 0.5 * (q.corner[0].xy + q.corner[1].xy), to = 0.5 * (q.corner[2].xy + q.corner[3].xy);
    vec2 side0 = q.corner[1].xy - from, side1 = q.corner[3].xy - to, along = to - from;
    vec2 n     = vec2(-along.y, along.x) / length(along);
    vec2 part  = vec2(dot(side0, n), dot(side1, n));
    q.across     = vec3(n, -dot(n, from));
    q.half_width = max(abs(part.x), abs(part.y));
    q.simple     = part.x * part.y >= 0.0 && q.half_width < THIN &&
               abs(turn(side0, side1)) <= length(along) * min(abs(part.x), abs(part.y));
    if (!q.simple) side0 = n * abs(part.x), side1 = n * abs(part.y);
    vec2 inwards = dot(side0 + side1, n) < 0.0 ? n : -n, corner = from + side0, other = to - side1;
    q.ends[0]    = distance_from(from, side0, along);
    q.ends[1]    = distance_from(to, side1, -along);
    q.sides[0]   = distance_from(corner, along + side1 - side0, inwards);
    q.sides[1]   = distance_from(other, along - side1 + side0, -inwards);
    q.diagonal   = distance_from(corner, other - corner, from - side0 - corner);
    q.ends[0] /= max(at_place(q.ends[0], other), 1e-9);
    q.ends[1] /= max(at_place(q.ends[1], corner), 1e-9);
}

// Return the quadrilateral of a ribbon. A ribbon that is not finite is nowhere.
raster_quad quad_of(raster_ribbon r)
{
    raster_quad q;
    for (int k = 0; k < 4; ++k) {
        float seen = r.seen[k / 2], across = (k & 1) == 0 ? -1.0 : 1.0;
        vec4  at   = mix(r.middle[0], r.middle[1], seen) + across * mix(r.side[0], r.side[1], seen);
        q.corner[k] = at.xyz / at.w;
    }
    float l = distance(q.corner[0].xy + q.corner[1].xy, q.corner[2].xy + q.corner[3].xy);
    q.there = r.seen.x < r.seen.y && l > 1e-6 && l < 1e9;
    q.origin = floor(q.corner[0].xy);
    for (int k = 0; k < 4; ++k) q.corner[k].xy -= q.origin;
    find_edges(q);
    return q;
}

#define ROUNDING -1e-5 // Rounding error of fractions and distances. Neighbours leave no gap.

// Return whether a position from the origin is between the ends.
bool is_between(raster_quad q, vec2 place)
{
    return min(at_place(q.ends[0], place), at_place(q.ends[1], place)) >= ROUNDING;
}

// Return the fraction along a ribbon at a position from its origin. Both triangles are interpolated
// linearly.
float fraction_at(raster_quad q, vec2 place)
{
    float fraction = at_place(q.diagonal, place) > 0.0 ? at_place(q.ends[0], place)
                                                       : 1.0 - at_place(q.ends[1], place);
    return clamp(fraction, 0.0, 1.0);
}

// Return the depth at a fraction along a ribbon, between its sides.
float depth_at(raster_quad q, float fraction, float first, float second)
{
    float across = clamp(second / max(first + second, 1e-9), 0.0, 1.0);
    vec2  ends   = mix(vec2(q.corner[0].z, q.corner[2].z), vec2(q.corner[1].z, q.corner[3].z), across);
    return mix(ends.x, ends.y, fraction);
}

// Return whether a point is within a triangle of non-zero area. `e` holds the cross products from
// the point to consecutive corners. They are of one sign if the point is inside.
bool is_within(vec3 e)
{
    return e.x + e.y + e.z != 0.0 &&
           (all(greaterThanEqual(e, vec3(0.0))) || all(lessThanEqual(e, vec3(0.0))));
}

// Do what sees() does, by both triangles. They may overlap.
bool sees_either(raster_quad q, vec2 place, out float fraction, out float depth)
{
    vec2 a = q.corner[0].xy - place, b = q.corner[1].xy - place, c = q.corner[2].xy - place,
         d = q.corner[3].xy - place;
    vec3 first = vec3(turn(b, c), turn(c, a), turn(a, b));
    vec3 second = vec3(-first.x, turn(d, c), turn(b, d));
    bool there = is_within(first);
    fraction = depth = 0.0;
    if (there) {
        first /= first.x + first.y + first.z;
        fraction = first.z;
        depth = dot(first, vec3(q.corner[0].z, q.corner[1].z, q.corner[2].z));
    }
    if (!is_within(second)) return there;
    second /= second.x + second.y + second.z;
    float other = dot(second, vec3(q.corner[3].z, q.corner[1].z, q.corner[2].z));
    if (!there || (raster.flips == 0u ? other < depth : other > depth)) {
        fraction = 1.0 - second.y;
        depth = other;
    }
    return true;
}

// Find a ribbon at a position from its origin. `fraction` goes from 0 at one end to 1 at the other,
// and `depth` is the depth there. Return false if the ribbon does not cover the position.
bool sees(raster_quad q, vec2 place, out float fraction, out float depth)
{
    if (!q.simple) return sees_either(q, place, fraction, depth);
    float first = at_place(q.sides[0], place), second = at_place(q.sides[1], place);
    fraction = fraction_at(q, place);
    depth    = depth_at(q, fraction, first, second);
    return min(first, second) >= ROUNDING && is_between(q, place);
}
