// body_scatter.comp - one triangle of a body. Each node near the triangle gets its distance, and
// each column along x that crosses the triangle gets the direction of the crossing. Only columns
// that may change take part. One work group per triangle. A thread takes every 32nd of the columns
// near the triangle.
#version 450 core
#include "field/body.glsl"
layout(local_size_x = 32) in;

#define BAND float(HAIR_BODY_BAND)
#define SNAP 32.0 // Positions per voxel that a vertex may have across columns.

// Return a position across columns in units of half a snap. Vertices are odd, so no column, which
// is even, passes through one.
ivec2 snapped(vec3 p) { return 2 * ivec2(floor(SNAP * p.yz)) + 1; }

// Return a unit vector across the triangle. Only a triangle without area has several of them.
vec3 normal_of(vec3 a, vec3 b, vec3 c)
{
    vec3 normal = cross(b - a, c - a), side = dot(b - a, b - a) > dot(c - a, c - a) ? b - a : c - a;
    if (dot(normal, normal) <= 1e-12 * dot(side, side) * dot(side, side))
        normal = abs(side.x) > abs(side.y) ? vec3(-side.z, 0.0, side.x) : vec3(0.0, -side.z, side.y);
    float square = dot(normal, normal);
    return square > 0.0 ? normal * inversesqrt(square) : vec3(0.0);
}

// Return twice the area between an edge and a column, positive on the left of the edge.
int beside(ivec2 from, ivec2 to, ivec2 column)
{
    ivec2 edge = to - from, off = column - from;
    return edge.x * off.y - edge.y * off.x;
}

// Return whether a column on an edge counts as inside. Of two triangles that share the edge and lie
// on either side, one counts the column.
bool has_edge(ivec2 from, ivec2 to)
{
    ivec2 edge = to - from;
    return edge.y > 0 || (edge.y == 0 && edge.x < 0);
}

void cross_column(vec3 a, vec3 b, vec3 c, uvec2 at)
{
    ivec2 p = snapped(a), q = snapped(b), r = snapped(c), column = ivec2(at) * 2 * int(SNAP);
    int   area = beside(p, q, r);
    if (area == 0) return;
    if (area < 0) {
        ivec2 other = q;
        q = r, r = other;
        vec3 place = b;
        b = c, c = place;
    }
    ivec3 weight = ivec3(beside(q, r, column), beside(r, p, column), beside(p, q, column));
    bool  is_crossed = (weight.x > 0 || (weight.x == 0 && has_edge(q, r))) &&
                      (weight.y > 0 || (weight.y == 0 && has_edge(r, p))) &&
                      (weight.z > 0 || (weight.z == 0 && has_edge(p, q)));
    if (!is_crossed) return;
    vec3 part  = vec3(weight);
    float x    = dot(part, vec3(a.x, b.x, c.x)) / (part.x + part.y + part.z);
    uint  node = uint(clamp(ceil(x), 0.0, float(params.nodes_x - 1u)));
    atomicAdd(crossing[node + params.nodes_x * (at.x + params.nodes_y * at.y)], area > 0 ? -1 : 1);
}

void main()
{
    uint t = hair_group();
    if (t == 0u && gl_LocalInvocationID.x == 0u) { // The next body_moved.comp begins with these.
        change.lower_x = change.lower_y = change.lower_z = BODY_NONE;
        change.upper_x = change.upper_y = change.upper_z = 0u;
    }
    if (t >= params.triangles) return;
    mat3 corner = body_triangle(t);
    vec3 a = corner[0], b = corner[1], c = corner[2],
         last = vec3(params.nodes_x, params.nodes_y, params.nodes_z) - 1.0;
    vec3 lower = max(ceil(min(a, min(b, c)) - BAND), vec3(0.0)),
         upper = min(floor(max(a, max(b, c)) + BAND), last), normal = normal_of(a, b, c);
    uvec2 first = max(uvec2(lower.yz), first_changed()), end = min(uvec2(upper.yz), last_changed()) + 1u;
    if (any(greaterThanEqual(first, end))) return;
    uvec2 count = end - first;
    for (uint n = gl_LocalInvocationID.x; n < count.x * count.y; n += 32u) {
        uvec2 at = first + uvec2(n % count.x, n / count.x);
        cross_column(a, b, c, at);
        // Nodes of the column between the two planes at the distance BAND from the triangle.
        float off = dot(normal, vec3(0.0, at) - a);
        vec2  way = vec2(lower.x, upper.x);
        if (abs(normal.x) > 1e-6) {
            vec2 ends = (vec2(-BAND, BAND) - off) / normal.x;
            way       = vec2(max(way.x, ceil(min(ends.x, ends.y))), min(way.y, floor(max(ends.x, ends.y))));
        } else if (abs(off) > BAND) {
            continue;
        }
        for (float x = way.x; x <= way.y; x += 1.0) {
            vec3  p   = vec3(x, at);
            float far = length(p - corner * nearest_weights(p, a, b, c));
            if (far >= BAND) continue;
            uint key = uint(far * float(HAIR_BODY_STEPS)) << HAIR_BODY_TRIANGLE_BITS | t;
            atomicMin(nearest[uint(x) + params.nodes_x * (at.x + params.nodes_y * at.y)], key);
        }
    }
}
