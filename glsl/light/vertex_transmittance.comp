// vertex_transmittance.comp - light that arrives at each vertex of a strand past all other strands
// and past colliders. Work groups are those of strands/vertex_range.glsl.
//
// The number of strands met is a sum. It begins with two steps of one cell, with the first midpoint
// one cell away. Then ever longer steps look for the next cell with hair, and the values that
// node_transmittance.comp found for the nodes around it are added. The strands are taken to be
// parallel to this strand.
//
// For a light with a shadow map, the fraction that meets no strand is more accurate. It is the
// fraction of sample points that nothing occludes in the map. The samples lie on the half segments
// beside the vertex and across the strand.
//
// For each light the pass writes two halves: the fraction that meets no strand, and the number of
// strands met. Before them are two halves for the visible fraction of the sky, and the order of the
// strand.
#version 450 core
#include "strands/vertex_range.glsl"
#include "light/density.glsl"
#include "light/lights.glsl"
#include "light/shadow_map.glsl"
#include "random.glsl"
#ifdef HAIR_WIDENED
#include "strands/lod_contract.glsl"
#endif

layout(std430, binding = HAIR_BIND_DENSITY_LIGHT) readonly restrict buffer node_buffer
{
    float light_of_node[];
};
layout(std430, binding = HAIR_BIND_LIGHT) writeonly restrict buffer light_buffer { uint light_of_vertex[]; };
layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D hair_shadow_map[HAIR_SHADOW_MAPS];

#define TAPS 12
#define NEAR_STEPS 2
#define ORDER_REACH 0.02 // m, along the strand to each side of a vertex.
#define OWN_DEPTH 0.35 // In radii. A strand must be nearer to the light by this to occlude.

struct strand_bit {
    vec3  before, at, after; // m, from the head's origin.
    vec3  tangent;
    float radius, thin; // m. `thin` is without a level of detail.
    uint  seed;
};

// Nodes with hair around a position in the grid, and their weights.
uint  corner[8];
float weight[8];

// Find the nodes with hair around a position. Return false if there are none.
bool find_corners(density_grid grid, vec3 place)
{
    uint  node;
    vec3  part;
    bool  there = find_node(grid, place, node, part);
    float sum   = 0.0;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 c     = uvec3(k & 1u, k >> 1u & 1u, k >> 2u);
        vec3  fraction = mix(1.0 - part, part, vec3(c));
        corner[k]   = there ? node + c.x + grid.nodes.x * (c.y + grid.nodes.y * c.z) : 0u;
        weight[k]   = there && density[corner[k]] > 0u ? fraction.x * fraction.y * fraction.z : 0.0;
        sum += weight[k];
    }
    for (uint k = 0u; k < 8u; ++k) weight[k] /= max(sum, 1e-6);
    return sum > 1e-6;
}

// Return the interpolated value of the nodes found by find_corners().
float around(uint which)
{
    float sum = 0.0;
    for (uint k = 0u; k < 8u; ++k)
        if (weight[k] > 0.0) sum += weight[k] * light_of_node[corner[k] * draw.light_values + which];
    return sum;
}

// Return the number of strands met on the way to a light at the distance `reach`, m.
float met_towards(density_grid grid, vec3 position, uint light, vec3 to, float reach)
{
    vec3  place = place_in(grid, position), way = in_head(to), size = vec3(grid.nodes) - 1.0;
    vec3  left  = mix(place, size - place, greaterThan(way, vec3(0.0))) / max(abs(way), 1e-6);
    float steps = min(min(left.x, min(left.y, left.z)), reach / grid.cell), sum = 0.0;
    float k = 0.0;
    for (int i = 0; i < NEAR_STEPS; ++i) {
        k += 1.0;
        if (k >= steps) return sum;
        sum += density_at(grid, place + k * way);
        if (is_inside(position + k * grid.cell * to)) return MAX_MET;
    }
    for (float each = 1.0; k < steps; k += each, each *= 1.5) {
        if (is_inside(position + k * grid.cell * to)) return MAX_MET;
        if (find_corners(grid, place + k * way)) return min(sum + around(1u + light), MAX_MET);
    }
    return min(sum, MAX_MET);
}

// Return the fraction of sample points around a vertex that nothing occludes in a shadow map.
float open_in(uint map, uint light, vec3 to, strand_bit s)
{
    vec2  size  = vec2(textureSize(hair_shadow_map[map], 0));
    vec3  along = find_place_in_map(map, s.after) - find_place_in_map(map, s.before);
    vec2  texels = along.xy * size;
    float slope = along.z / max(dot(texels, texels), 1.0); // Slope of depth along the strand.
    vec3  side  = cross(s.tangent, to);
    side *= s.radius / max(length(side), 1e-12);
    float each = depth_by_metre(light, find_place_in_map(map, s.at).z, distance_to_light(light, s.at));
    float own = OWN_DEPTH * s.thin * each, turn = random(s.seed + 0x3c6ef372u), open = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        float x = (float(i) + turn) / float(TAPS) * 2.0 - 1.0,
              across = 2.0 * fract(turn + 0.618034 * float(i + 1)) - 1.0;
        vec3  p  = s.at + 0.5 * abs(x) * ((x < 0.0 ? s.before : s.after) - s.at) + across * side;
        vec3  at = find_place_in_map(map, p);
        ivec2 texel = ivec2(floor(at.xy * size));
        // Depth of the strand itself at the centre of the texel.
        float depth = at.z + slope * dot(vec2(texel) + 0.5 - at.xy * size, texels);
        bool  there = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(size)));
        float stored = depth_from_light(map, texelFetch(hair_shadow_map[map], texel, 0).r);
        open += !there || depth - own <= stored ? 1.0 : 0.0;
    }
    return open / float(TAPS);
}

// Return how straight a strand is around vertex k: 1 for a line, and 0 for curls. Strands around it
// are taken to have the same shape, so that this is how parallel they are.
float find_order(uint vertex, uint k, strand_bit s)
{
    float part  = max(length(s.after - s.at), length(s.at - s.before));
    uint  reach = uint(clamp(ORDER_REACH / max(part, 1e-6) + 0.5, 1.0, 8.0));
    uint  first = k - min(reach, k), last = min(k + reach, draw.segments);
    float path  = 0.0;
    vec3  from  = strand_vertex[vertex - k + first].xyz, start = from;
    for (uint i = first + 1u; i <= last; ++i) {
        vec3 to = strand_vertex[vertex - k + i].xyz;
        path += length(to - from);
        from = to;
    }
    float straight = min(length(from - start) / max(path, 1e-9), 1.0);
    straight *= straight, straight *= straight, straight *= straight;
    return straight * straight;
}

// Return the place where a vertex is drawn. Wider strands of a level of detail are drawn elsewhere.
vec3 drawn_at(uint vertex, float widened)
{
    vec4 v = strand_vertex[vertex];
#ifdef HAIR_WIDENED
    uint       each  = draw.segments + 1u;
    hair_point point = hair_point(v.xyz, vec3(0.0), v.w);
    float      t     = float(vertex % each) / float(draw.segments);
    hair_follower follower = fetch_follower(vertex / each);
    if (widened > 1.0) gather(follower, whole_t(t), v.w * (widened - 1.0), point);
    v.xyz = point.position;
#endif
    return v.xyz;
}

// Light a vertex. `run` has the width of strands.
void light(density_grid grid, uint vertex, vertex_range run)
{
    uint       each = draw.segments + 1u, k = vertex % each;
    vec4       at = strand_vertex[vertex];
    strand_bit s;
    s.at      = drawn_at(vertex, run.widened);
    s.before  = k > 0u ? drawn_at(vertex - 1u, run.widened) : s.at;
    s.after   = k + 1u < each ? drawn_at(vertex + 1u, run.widened) : s.at;
    s.tangent = direction_or(s.after - s.before, vec3(0.0, 1.0, 0.0));
    s.radius  = at.w * run.thickness;
    s.thin    = at.w;
    s.seed    = vertex / each;
    find_corners(grid, place_in(grid, at.xyz));
    light_of_vertex[vertex * draw.light_values] = packHalf2x16(vec2(around(0u), find_order(vertex, k, s)));
    for (uint i = 0u; i < draw.lights; ++i) {
        vec4  place = draw.light[i * HAIR_LIGHT_VECTORS + HAIR_LIGHT_TO];
        vec3  to    = beam_at(i, s.at).to;
        float along = dot(s.tangent, to), reach = place.w > 0.0 ? length(place.xyz - s.at) : 1e9;
        float met   = met_towards(grid, at.xyz, i, to, reach) * sqrt(max(1.0 - along * along, 0.0));
        uint  map   = uint(draw.light[i * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MORE].w);
        float open  = map < uint(HAIR_SHADOW_MAPS) ? open_in(map, i, to, s) : exp(-met);
        light_of_vertex[vertex * draw.light_values + 1u + i] = packHalf2x16(vec2(open, met));
    }
}

void main()
{
    vertex_range run = find_vertex_range();
    if (run.first >= run.end) return;
    density_grid grid = find_grid();
    for (uint vertex = run.first; vertex < run.end; vertex += run.stride) light(grid, vertex, run);
}
