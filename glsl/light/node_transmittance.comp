// node_transmittance.comp - self-shadowing at every grid node with hair: the number of strands and
// colliders on the way to each light, and the visible fraction of the sky. Each thread covers
// several nodes.
//
// Steps are one cell long. The first midpoint is one cell away, because a strand must not shade
// itself. All hair counts as if it lay across the light.
#version 450 core
#include "light/density.glsl"
#include "light/lights.glsl"

layout(std430, binding = HAIR_BIND_DENSITY_LIGHT) writeonly restrict buffer node_buffer
{
    float light_of_node[];
};

#define SKY_WAYS 6
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

float sky_at_node(density_grid grid, vec3 place, vec3 position)
{
    float sum = 0.0;
    for (int i = 0; i < SKY_WAYS; ++i) {
        vec3 way   = vec3(0.0);
        way[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
        vec3  to   = rotate(draw.head, way);
        float met  = 0.0, from = 0.5;
        for (int k = 0; k < SKY_STEPS && met < MAX_MET; ++k) {
            float each = exp2(float(k)), middle = from + 0.5 * each;
            met += TURNED * each * density_at(grid, place + middle * way);
            if (is_inside(position + middle * grid.cell * to)) met = MAX_MET;
            from += each;
        }
        sum += exp(-met);
    }
    return sum / float(SKY_WAYS);
}

void light(density_grid grid, uint node)
{
    vec3 place =
        vec3(node % grid.nodes.x, node / grid.nodes.x % grid.nodes.y, node / (grid.nodes.x * grid.nodes.y));
    vec3 position = rotate(draw.head, grid.lower + grid.cell * place);
    light_of_node[node * draw.light_values] = sky_at_node(grid, place, position);
    for (uint i = 0u; i < draw.lights; ++i) {
        vec4  at    = draw.light[i * HAIR_LIGHT_VECTORS + HAIR_LIGHT_TO];
        float reach = at.w > 0.0 ? length(at.xyz - position) : 1e9;
        light_of_node[node * draw.light_values + 1u + i] =
            met_towards(grid, place, position, beam_at(i, position).to, reach);
    }
}

void main()
{
    density_grid grid = find_grid();
    uint end = grid.nodes.x * grid.nodes.y * grid.nodes.z,
         stride = hair_group_count() * HAIR_GROUP_SIZE;
    for (uint node = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x; node < end; node += stride)
        if (density[node] > 0u) light(grid, node);
}
