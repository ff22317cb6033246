// node_transmittance.comp - self-shadowing at every grid node with hair: the number of strands and
// colliders on the way to each light, and the visible fraction of the sky.
//
// Few nodes have hair. A work group lists them until there is one for each of its threads. The
// threads then follow the ways from the listed nodes.
//
// Steps are one cell long. The first midpoint is one cell away, because a strand must not shade
// itself. All hair counts as if it lay across the light.
#version 450 core
#include "light/density.glsl"
#include "light/lights.glsl"

layout(std430, binding = HAIR_BIND_DENSITY_LIGHT) writeonly restrict buffer node_buffer
{
    uint light_of_node[];
};

#define SKY_WAYS 6u
#define SKY_STEPS 5     // Each is twice as long as the one before.
#define MAX_STEPS 1024.0 // Maximum number of cells on the way to a light. Long grids have more.
#define TURNED 0.785398 // Mean factor of a strand's projected width over all directions.

// Return the number of strands met from a node towards `to`, over at most `reach`, m.
float met_towards(density_grid grid, vec3 place, vec3 position, vec3 to, float reach)
{
    vec3  way   = in_head(to), size = vec3(grid.nodes) - 1.0;
    vec3  left  = mix(place, size - place, greaterThan(way, vec3(0.0))) / max(abs(way), 1e-6);
    float steps = min(min(left.x, min(left.y, left.z)), min(reach / grid.cell, MAX_STEPS)), sum = 0.0;
    for (float k = 1.0; k < steps && sum < MAX_MET; k += 1.0) {
        sum += density_at(grid, place + k * way);
        if (is_inside(position + k * grid.cell * to)) sum = MAX_MET;
    }
    return min(sum, MAX_MET);
}

// Return the visible fraction of the sky along a coordinate axis of the head.
float sky_along(density_grid grid, vec3 place, vec3 position, uint axis)
{
    vec3 way       = vec3(0.0);
    way[axis / 2u] = axis % 2u == 0u ? 1.0 : -1.0;
    vec3  to       = rotate(draw.head, way);
    float met      = 0.0, from = 0.5;
    for (int k = 0; k < SKY_STEPS && met < MAX_MET; ++k) {
        float each = exp2(float(k)), middle = from + 0.5 * each;
        met += TURNED * each * density_at(grid, place + middle * way);
        if (is_inside(position + middle * grid.cell * to)) met = MAX_MET;
        from += each;
    }
    return exp(-met);
}

shared uint  nodes; // Number of nodes in the list.
shared uint  node_at[2u * HAIR_GROUP_SIZE];
// Visible fractions along each axis, then the number of strands on the way to the first light.
shared float found[(SKY_WAYS + 1u) * HAIR_GROUP_SIZE];

// Follow way number `which` from a node, to the sky or to a light. `at` is the place of the node.
void follow(density_grid grid, uint node, uint at, uint which)
{
    vec3 place =
        vec3(node % grid.nodes.x, node / grid.nodes.x % grid.nodes.y, node / (grid.nodes.x * grid.nodes.y));
    vec3 position = rotate(draw.head, grid.lower + grid.cell * place);
    if (which < SKY_WAYS) {
        found[which * HAIR_GROUP_SIZE + at] = sky_along(grid, place, position, which);
        return;
    }
    uint  i     = which - SKY_WAYS;
    vec4  light = draw.light[i * HAIR_LIGHT_VECTORS + HAIR_LIGHT_TO];
    float reach = light.w > 0.0 ? length(light.xyz - position) : 1e9;
    float met   = met_towards(grid, place, position, beam_at(i, position).to, reach);
    if (i == 0u) found[SKY_WAYS * HAIR_GROUP_SIZE + at] = met;
    else light_of_node[node * HAIR_NODE_WORDS(draw.light_values) + i] = floatBitsToUint(met);
}

// Find the light of the last nodes in the list, a node per thread, and shorten the list.
void find_light(density_grid grid)
{
    uint own = gl_LocalInvocationID.x, count = min(nodes, HAIR_GROUP_SIZE), first = nodes - count;
    uint ways = count * (SKY_WAYS + draw.lights);
    for (uint i = own; i < ways; i += HAIR_GROUP_SIZE)
        follow(grid, node_at[first + i % count], i % count, i / count);
    synchronise();
    if (own < count) {
        float sum = 0.0, met = draw.lights > 0u ? found[SKY_WAYS * HAIR_GROUP_SIZE + own] : 0.0;
        for (uint i = 0u; i < SKY_WAYS; ++i) sum += found[i * HAIR_GROUP_SIZE + own];
        light_of_node[node_at[first + own] * HAIR_NODE_WORDS(draw.light_values)] =
            packHalf2x16(vec2(sum / float(SKY_WAYS), met));
    }
    if (own == 0u) nodes = first;
    synchronise();
}

void main()
{
    density_grid grid = find_grid();
    uint own = gl_LocalInvocationID.x, end = grid.nodes.x * grid.nodes.y * grid.nodes.z,
         stride = hair_group_count() * HAIR_GROUP_SIZE;
    if (own == 0u) nodes = 0u;
    synchronise();
    for (uint base = hair_group() * HAIR_GROUP_SIZE; base < end; base += stride) {
        uint node = base + own;
        // The order of the list does not matter.
        if (node < end && density[node] > 0u) node_at[atomicAdd(nodes, 1u)] = node;
        synchronise();
        uint count = nodes;
        synchronise(); // No thread adds a node before all have read the number.
        if (count >= HAIR_GROUP_SIZE) find_light(grid);
    }
    if (nodes > 0u) find_light(grid);
}
