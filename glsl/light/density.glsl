// density.glsl - the grid of hair density: its place, and its value at a position.
//
// The grid is fixed in the head's frame and encloses all hair. Its cells have the requested size,
// or the size at which the nodes of the buffer suffice. A node holds the area of the strands
// around it, projected across a light, divided by the area of one face of a cell, in
// HAIR_DENSITY_UNITS. This is the number of strands that light meets on its way through a cell.
#include "draw_params.glsl"
#include "light/float_key.glsl"
#include "rotation.glsl"
#ifdef HAIR_COLLIDERS
#include "field.glsl"
#endif
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_DENSITY) restrict buffer density_buffer
{
    // Minima of x, y and z, then minima of their inverted bits, in the encoding of
    // light/float_key.glsl.
    uint box[HAIR_DENSITY_FIRST];
    uint density[];
};
layout(std430, binding = HAIR_BIND_DENSITY_STRAND) readonly restrict buffer strand_buffer
{
    vec4 strand_vertex[];
};

#define MAX_MET 30.0 // Strands after which no light is left.

// Return whether a position is inside a collider.
bool is_inside(vec3 from_origin)
{
#ifdef HAIR_COLLIDERS
    return field_distance(from_origin) < -0.5 * field.lower.w;
#else
    return false;
#endif
}

// Return a vector in the head's frame.
vec3 in_head(vec3 from_origin) { return rotate(quat_conjugate(draw.head), from_origin); }

struct density_grid {
    vec3  lower; // Node 0, m.
    float cell;  // m.
    uvec3 nodes; // 0 if there is no hair.
};

density_grid find_grid()
{
    uvec3 low = uvec3(box[0], box[1], box[2]), high = ~uvec3(box[3], box[4], box[5]);
    if (low.x > high.x) return density_grid(vec3(0.0), 1.0, uvec3(0u));
    vec3  lower = from_float_key(low), upper = from_float_key(high), nodes;
    float cell  = draw.origin.w;
    for (int i = 0; i < 400; ++i) {
        nodes = floor(upper / cell) - floor(lower / cell) + 2.0;
        if (nodes.x * nodes.y * nodes.z <= float(density.length())) break;
        cell *= 1.1;
    }
    return density_grid(cell * floor(lower / cell), cell, uvec3(nodes));
}

// Return a position in cells from node 0.
vec3 place_in(density_grid grid, vec3 from_origin) { return (in_head(from_origin) - grid.lower) / grid.cell; }

// Find the lowest of the eight nodes around a position and the fractions within the cell. Return
// whether all eight are in the grid.
bool find_node(density_grid grid, vec3 place, out uint node, out vec3 part)
{
    vec3 whole = floor(place);
    part       = place - whole;
    uvec3 at   = uvec3(max(whole, 0.0));
    node       = at.x + grid.nodes.x * (at.y + grid.nodes.y * at.z);
    return all(greaterThanEqual(whole, vec3(0.0))) && all(lessThan(whole, vec3(grid.nodes) - 1.0));
}

// Return the number of strands that light meets in a cell at a position.
float density_at(density_grid grid, vec3 place)
{
    uint node;
    vec3 part;
    if (!find_node(grid, place, node, part)) return 0.0;
    uint y = grid.nodes.x, z = grid.nodes.x * grid.nodes.y;
    vec4 near = vec4(density[node], density[node + 1u], density[node + y], density[node + y + 1u]);
    node += z;
    vec4 far = vec4(density[node], density[node + 1u], density[node + y], density[node + y + 1u]);
    vec4 xy  = mix(near, far, part.z);
    vec2 x   = mix(xy.xy, xy.zw, part.y);
    return mix(x.x, x.y, part.x) / HAIR_DENSITY_UNITS;
}
