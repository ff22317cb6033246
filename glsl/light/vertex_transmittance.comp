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
// beside the vertex and across the strand, where the map's own level of detail draws the strand.
//
// A wide strand stands for several. Constants that are fitted to the light of all strands adjust
// its light, see light/wide_strands.glsl.
//
// For each light the pass writes two halves: the fraction that meets no strand, and the number of
// strands met. Before them are two halves for the visible fraction of the sky, and the order of the
// strand.
#version 450 core
#include "strands/vertex_range.glsl"
#include "light/density.glsl"
#include "light/lights.glsl"
#include "light/wide_strands.glsl"

layout(std430, binding = HAIR_BIND_DENSITY_LIGHT) readonly restrict buffer node_buffer
{
    uint light_of_node[];
};
layout(std430, binding = HAIR_BIND_LIGHT) writeonly restrict buffer light_buffer { uint light_of_vertex[]; };

#define NEAR_STEPS 2
#define ORDER_REACH 0.02 // m, along the strand to each side of a vertex.

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
    uint  each = HAIR_NODE_WORDS(draw.light_values), word = max(which, 1u) - 1u;
    float sum  = 0.0;
    for (uint k = 0u; k < 8u; ++k)
        if (weight[k] > 0.0) {
            uint bits = light_of_node[corner[k] * each + word];
            vec2 two  = unpackHalf2x16(bits);
            sum += weight[k] * (which == 0u ? two.x : which == 1u ? two.y : uintBitsToFloat(bits));
        }
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

// Return how straight a strand is around vertex k: 1 for a line, and 0 for curls. Strands around it
// are taken to have the same shape, so that this is how parallel they are. `part` is the length of
// a segment, m.
float find_order(uint vertex, uint k, float part)
{
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

// Light a vertex. `run` has the width of its strands.
void light(density_grid grid, uint vertex, vertex_range run)
{
    uint k = vertex % (draw.segments + 1u), number = vertex / (draw.segments + 1u) + run.skipped;
    vec3 at = strand_vertex[vertex].xyz, before = k > 0u ? strand_vertex[vertex - 1u].xyz : at;
    vec3 after = k < draw.segments ? strand_vertex[vertex + 1u].xyz : at;
    vec3 tangent = direction_or(after - before, vec3(0.0, 1.0, 0.0));
    float order  = find_order(vertex, k, max(length(after - at), length(at - before)));
    find_corners(grid, place_in(grid, at));
    // A wide strand has the light of its visible part.
    vec3 outer = vec3(0.0);
    if (run.widened > 1.0) outer = find_outer_side(grid, at, tangent);
    float wide = strand_vertex[vertex].w * run.thickness;
    vec3  seen = at + find_seen(wide * (1.0 - 1.0 / run.widened)) * outer;
    float wider = 2.0 * strand_vertex[vertex].w * (run.widened - 1.0) / grid.cell;
    light_of_vertex[vertex * draw.light_values] = packHalf2x16(vec2(sky_past_wide(around(0u), wider), order));
    for (uint i = 0u; i < draw.lights; ++i) {
        vec4  place = draw.light[i * HAIR_LIGHT_VECTORS + HAIR_LIGHT_TO];
        vec3  to    = beam_at(i, at).to;
        float along = dot(tangent, to), reach = place.w > 0.0 ? length(place.xyz - at) : 1e9;
        uint  map   = map_of(i);
        float met   = met_towards(grid, seen, i, to, reach) * sqrt(max(1.0 - along * along, 0.0));
        float open  = exp(-met);
        if (map < uint(HAIR_SHADOW_MAPS)) {
            strand_bit s = find_bit(vertex, k, number, widened_in[map], run.thickness / run.widened);
            vec3  shift   = find_seen(wide * max(1.0 - widened_in[map] / run.widened, 0.0)) * outer;
            float between = dot(to, normalize(towards_eye(draw.eye, at)));
            s.before += shift, s.at += shift, s.after += shift;
            open = open_past_wide(open_in(map, i, to, s), order, between, widened_in[map]);
            open = open_in_front(open, order, between, find_gain(map, run.widened), run.cut);
        }
        light_of_vertex[vertex * draw.light_values + 1u + i] = packHalf2x16(vec2(open, met));
    }
}

void main()
{
    vertex_range run = find_vertex_range();
    if (run.first >= run.end) return;
    density_grid grid = find_grid();
    find_widths(run.number, run.widened);
    for (uint vertex = run.first; vertex < run.end; vertex += run.stride) light(grid, vertex, run);
}
