// body_reach.comp - columns along x of a body that have a node whose distance or motion may change.
// One thread per node.
//
// Each node knows a point of the last surface. If that is nearer than all triangles that move, the
// node keeps its distance and its side, because no surface moves across the node.
#version 450 core
#include "field/body.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

// xyz: surface point, as body_line.comp left it. w: 0.5 in size without a point.
layout(std430, binding = HAIR_BIND_BODY_POINT) readonly buffer point_buffer { vec4 point[]; };
layout(std430, binding = HAIR_BIND_NODE) readonly buffer node_buffer { float node[]; };

// Distance by which the box of the moved triangles grows, voxels. It exceeds the snapping of
// vertices in body_scatter.comp.
#define MARGIN 0.05

void main()
{
    uint n     = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    uint count = params.nodes_x * params.nodes_y * params.nodes_z, layer = params.nodes_x * params.nodes_y;
    if (n >= count || params.is_first != 0u) return;
    uvec3 at     = uvec3(n % params.nodes_x, n / params.nodes_x % params.nodes_y, n / layer);
    // Threads that read an old value only do more than they must.
    bool is_known = all(lessThanEqual(first_changed(), at.yz)) && all(lessThanEqual(at.yz, last_changed()));
    if (is_known) return;
    uvec3 low    = uvec3(change.lower_x, change.lower_y, change.lower_z);
    uvec3 high   = uvec3(change.upper_x, change.upper_y, change.upper_z);
    bool changes = false;
    if (low.x <= high.x) {
        vec3 p = vec3(at), lower = uintBitsToFloat(low) - MARGIN, upper = uintBitsToFloat(high) + MARGIN;
        vec3 moved = clamp(p, lower, upper) - p, known = point[n].xyz - p;
        changes    = abs(point[n].w) < 0.75 || dot(moved, moved) <= dot(known, known);
    }
    uint motion = params.first + count + 3u * n; // The last motion ends.
    changes = changes || node[motion] != 0.0 || node[motion + 1u] != 0.0 || node[motion + 2u] != 0.0;
    if (!changes) return;
    if (at.y < change.first_y) atomicMin(change.first_y, at.y);
    if (at.z < change.first_z) atomicMin(change.first_z, at.z);
    if (at.y > change.last_y) atomicMax(change.last_y, at.y);
    if (at.z > change.last_z) atomicMax(change.last_z, at.z);
}
