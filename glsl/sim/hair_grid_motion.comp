// hair_grid_motion.comp - the rigid motion of the hair at each node, and how far the hair presses.
// hair_grid_gather.comp explains both. One thread per node.
#version 450 core
#include "sim/hair_grid.glsl"
#include "sim/hair_grid_rigid.glsl"

layout(std430, binding = HAIR_BIND_HAIR_GRID) readonly buffer hair_grid_buffer { int hair_grid[]; };
layout(std430, binding = HAIR_BIND_REST_DENSITY) readonly buffer rest_density_buffer
{
    float rest_density[];
};
layout(std430, binding = HAIR_BIND_NODE_MOTION) writeonly buffer node_motion_buffer
{
    hair_grid_node node_motion[];
};

vec3 numbers_at(uint at) { return vec3(hair_grid[at], hair_grid[at + 1u], hair_grid[at + 2u]); }

sums sums_at(uint at)
{
    return sums(float(hair_grid[at]), numbers_at(at + HAIR_GRID_MOMENTUM), numbers_at(at + HAIR_GRID_MOMENT),
                numbers_at(at + HAIR_GRID_ANGULAR), numbers_at(at + HAIR_GRID_SQUARES),
                numbers_at(at + HAIR_GRID_PRODUCTS));
}

// Return g of a node. With the masses m_s of strands at the node and their sum m, Q = sum_s m_s^2 /
// m^2 is 1/N for N equal strands.
float company_at(uint at)
{
    float mass = float(hair_grid[at]),
          alike = float(hair_grid[at + HAIR_GRID_ALIKE]) / (params.per_strand * mass * mass);
    return clamp(2.0 * (1.0 - alike), 0.0, 1.0);
}

void main()
{
    uint node = thread(), at = NODE_NUMBERS * node;
    if (node >= params.nodes_x * params.nodes_y * params.nodes_z) return;
    hair_grid_node own = hair_grid_node(vec4(0.0), vec4(0.0), vec4(0.0));
    // A loop of no rounds replaces a branch, because a software rasteriser executes both sides of a
    // branch.
    for (uint k = 0u, end = hair_grid[at] > 0 ? 1u : 0u; k < end; ++k) {
        motion m = rigid_motion(sums_at(at));
        // Rounding may leave a negative volume.
        float volume = float(hair_grid[at + HAIR_GRID_VOLUME]);
        float over   = 1.0 - min(rest_density[node] / max(volume, 1.0), 1.0);
        own = hair_grid_node(vec4(m.centre, company_at(at)), vec4(m.speed, over), vec4(m.turn, 0.0));
    }
    node_motion[node] = own;
}
