// body_line.comp - one line of nodes of a body along an axis. Each node gets the nearest surface
// point of the nodes before it and after it, as it is passed on from node to node (Danielsson
// 1980). After two rounds of all axes, each node knows a point that is nearest or nearly so. Lines
// end at columns that do not change, whose nodes pass their points on. One thread per line.
//
// HAIR_FIRST begins with the triangles near nodes. It also finds the side of each node: outside the
// body, the surfaces that a column has entered equal those it has left. HAIR_LAST writes the signed
// distance, and the motion of the surface since the last shape.
#version 450 core
#include "field/body.glsl"
layout(local_size_x = HAIR_BODY_THREADS) in;

// xyz: surface point. w: 1 plus the index of its triangle, or UNKNOWN. w is negative inside.
layout(std430, binding = HAIR_BIND_BODY_POINT) buffer point_buffer { vec4 point[]; };
#ifdef HAIR_LAST
layout(std430, binding = HAIR_BIND_NODE) writeonly buffer node_buffer { float node[]; };
layout(std430, binding = HAIR_BIND_BODY_BEFORE) readonly buffer before_buffer { float before[]; };
#endif

#define UNKNOWN 0.5 // Size of w of a node that knows no point.
// Number of nodes that are read at once, so that a thread waits for memory less often.
#define AHEAD 8u

// Return the point that is nearer to p, with a positive w.
vec4 nearer(vec3 p, vec4 own, vec4 other)
{
    vec3  a = own.xyz - p, b = other.xyz - p;
    float w = abs(own.w);
    bool  is_own = w > UNKNOWN && (other.w <= UNKNOWN || dot(a, a) <= dot(b, b));
    return is_own ? vec4(own.xyz, w) : other;
}

// Return the point that the node n passes on to a line that ends beside it.
vec4 passed_on(uint n) { return vec4(point[n].xyz, abs(point[n].w)); }

#ifdef HAIR_FIRST
// Return the point that a node near a triangle knows from the triangle.
vec4 first_point(uint n, vec3 p)
{
    uint key = nearest[n], t = key & ((1u << HAIR_BODY_TRIANGLE_BITS) - 1u);
    if (key == BODY_NONE) return vec4(vec3(0.0), UNKNOWN);
    mat3 corner = body_triangle(t);
    return vec4(corner * nearest_weights(p, corner[0], corner[1], corner[2]), float(t + 1u));
}
#endif
#ifdef HAIR_LAST
// Write the distance of a node from the triangle of its point, and the motion of the surface there.
// The triangle may be nearer than the point.
void write_node(uint n, vec3 p, vec4 known)
{
    float far   = length(vec3(params.nodes_x, params.nodes_y, params.nodes_z));
    vec3  moved = vec3(0.0);
    if (abs(known.w) > UNKNOWN) {
        uint t      = uint(abs(known.w)) - 1u;
        mat3 corner = body_triangle(t);
        vec3 weight = nearest_weights(p, corner[0], corner[1], corner[2]);
        far         = length(p - corner * weight);
        for (int k = 0; k < 3; ++k) {
            uint i = 3u * triangle[3u * t + uint(k)];
            moved += weight[k] * (corner[k] - vec3(before[i], before[i + 1u], before[i + 2u]));
        }
    }
    node[params.first + n] = params.voxel * (known.w < 0.0 ? -far : far) - params.shell;
    uint motion = params.first + params.nodes_x * params.nodes_y * params.nodes_z + 3u * n;
    for (int k = 0; k < 3; ++k) node[motion + uint(k)] = params.voxel * moved[k];
}
#endif

void main()
{
    uvec3 size = uvec3(params.nodes_x, params.nodes_y, params.nodes_z);
    uint  line = hair_group() * HAIR_BODY_THREADS + gl_LocalInvocationID.x, count = size[HAIR_AXIS];
    uvec2 low = first_changed(), high = last_changed();
#if HAIR_AXIS == 0
    uvec3 at = uvec3(0u, line % max(size.y, 1u), line / max(size.y, 1u)), way = uvec3(1u, 0u, 0u);
    if (at.z >= size.z || any(lessThan(at.yz, low)) || any(greaterThan(at.yz, high))) return;
    uint from = 0u, end = count;
#elif HAIR_AXIS == 1
    uvec3 at = uvec3(line % max(size.x, 1u), 0u, line / max(size.x, 1u)), way = uvec3(0u, 1u, 0u);
    if (at.z < low.y || at.z > high.y) return;
    uint from = low.x, end = high.x + 1u;
#else
    uvec3 at = uvec3(line % max(size.x, 1u), line / max(size.x, 1u), 0u), way = uvec3(0u, 0u, 1u);
    if (at.y < low.x || at.y > high.x) return;
    uint from = low.y, end = high.y + 1u;
#endif
    uint start = at.x + size.x * (at.y + size.y * at.z), stride = way.x + size.x * (way.y + size.y * way.z);
    vec4 known = vec4(vec3(0.0), UNKNOWN), own[AHEAD];
    int  winding = 0;
    if (from > 0u) known = passed_on(start + (from - 1u) * stride);
    for (uint first = from; first < end; first += AHEAD) {
#ifdef HAIR_FIRST
        int crossed[AHEAD];
#endif
        for (uint k = 0u; k < AHEAD; ++k) {
            uint i = min(first + k, end - 1u), n = start + i * stride;
#ifdef HAIR_FIRST
            own[k]     = first_point(n, vec3(at + i * way));
            crossed[k] = crossing[n];
#else
            own[k] = point[n];
#endif
        }
        for (uint k = 0u; k < AHEAD && first + k < end; ++k) {
            uint i = first + k, n = start + i * stride;
#ifdef HAIR_FIRST
            winding += crossed[k];
            nearest[n]  = BODY_NONE; // The next body_scatter.comp begins with these.
            crossing[n] = 0;
            bool is_inside = winding != 0 && params.is_closed != 0u;
#else
            bool is_inside = own[k].w < 0.0;
#endif
            known    = nearer(vec3(at + i * way), own[k], known);
            point[n] = vec4(known.xyz, is_inside ? -known.w : known.w);
        }
    }
    known = end < count ? passed_on(start + end * stride) : vec4(vec3(0.0), UNKNOWN);
    for (uint left = end; left > from; left -= min(left - from, AHEAD)) {
        for (uint k = 0u; k < AHEAD; ++k)
            own[k] = point[start + (max(left, from + k + 1u) - k - 1u) * stride];
        for (uint k = 0u; k < AHEAD && from + k < left; ++k) {
            uint i = left - k - 1u;
            known  = nearer(vec3(at + i * way), own[k], known);
            own[k] = vec4(known.xyz, own[k].w < 0.0 ? -known.w : known.w);
            point[start + i * stride] = own[k];
        }
#ifdef HAIR_LAST
        for (uint k = 0u; k < AHEAD && from + k < left; ++k) {
            uint i = left - k - 1u;
            write_node(start + i * stride, vec3(at + i * way), own[k]);
        }
#endif
    }
}
