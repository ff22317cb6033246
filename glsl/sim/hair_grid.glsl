// hair_grid.glsl - the hair-hair grid, and the place of a guide vertex in it. lib/sim/hair_grid.h
// explains the grid.
#include "shared.h"
#include "rotation.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_STATE) readonly buffer state_buffer { hair_state state[]; };
layout(std430, binding = HAIR_BIND_HISTORY) readonly buffer history_buffer { hair_history history[]; };
layout(std140, binding = HAIR_BIND_HAIR_GRID_PARAMS) uniform hair_grid_params_buffer
{
    hair_grid_params params;
};

uint  thread() { return hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x; }
uvec3 nodes() { return uvec3(params.nodes_x, params.nodes_y, params.nodes_z); }

#ifdef HAIR_FLUID
#define NODE_NUMBERS 4u // Numbers per node: mass and momentum
#else
#define NODE_NUMBERS uint(HAIR_GRID_NODE_NUMBERS)
#endif

uvec3 lowest; // Lowest of the eight nodes around the vertex
vec3  part;    // Fraction of the way to the next node, per axis

// Return whether v is finite and plausible. The comparison is by bits, because compilers may remove
// comparisons with NaN. A vertex that is not finite or is too far away stays out of the grid. Other
// hair must not feel it, and its guide returns to its rest pose.
bool is_sound(vec3 v) { return (floatBitsToUint(dot(v, v)) & 0x7fffffffu) < floatBitsToUint(1e8); }

// Return the displacement per substep of vertex i. A vertex without a known rate has only its last
// displacement.
vec3 rate_of(uint i)
{
    return state[i].position.w < 2.0 ? state[i].displacement.xyz : history[i].rate.xyz;
}

bool counts(uint i) { return is_sound(state[i].position.xyz) && is_sound(rate_of(i)); }

// Return the velocity relative to the head's origin, along the grid's axes, divided by
// HAIR_GRID_SPEED, in [-1, 1].
vec3 speed_of(uint i)
{
    vec3 relative = rotate(quat_conjugate(params.rotation), rate_of(i) - params.moved.xyz);
    return clamp(relative * (params.moved.w / HAIR_GRID_SPEED), vec3(-1.0), vec3(1.0));
}

// Return the position in the middle of the block of substeps, in cells from node 0. A constant
// force over a block has its mean lever arm there. Forces without a torque at these positions
// therefore keep angular momentum.
vec3 grid_position(uint i, vec3 speed)
{
    vec3 from = rotate(quat_conjugate(params.rotation), state[i].position.xyz) - params.lower.xyz;
    return from / params.lower.w + params.ahead * speed;
}

// Return whether a place is inside the grid. Hair that is attached to the head stays inside.
// Outside there is no interaction between hairs. The fluid's box ends half a cell outside its
// outermost nodes.
#ifdef HAIR_FLUID
#define OVERHANG 0.5
#else
#define OVERHANG 0.0
#endif
bool is_inside(vec3 at)
{
    return all(lessThanEqual(abs(at - clamp(at, vec3(0.0), vec3(nodes() - 1u))), vec3(OVERHANG)));
}

void find_stencil(vec3 at)
{
    at     = clamp(at, vec3(0.0), vec3(nodes() - 1u));
    lowest = min(uvec3(at), nodes() - 2u);
    part   = at - vec3(lowest);
}

uvec3 corner_of(uint k) { return uvec3(k & 1u, k >> 1u & 1u, k >> 2u); }

uint node_of(uvec3 corner)
{
    uvec3 at = lowest + corner;
    return at.x + params.nodes_x * (at.y + params.nodes_y * at.z);
}

vec3 fractions_of(uvec3 corner) { return mix(1.0 - part, part, vec3(corner)); }
