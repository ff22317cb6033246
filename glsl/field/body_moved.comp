// body_moved.comp - box of the triangles of a body that move. One thread per triangle.
#version 450 core
#include "field/body.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_BODY_BEFORE) readonly buffer before_buffer { float before[]; };

vec3 before_of(uint vertex)
{
    return vec3(before[3u * vertex], before[3u * vertex + 1u], before[3u * vertex + 2u]);
}

void main()
{
    uint t = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (t == 0u) { // The next pass finds the columns.
        bool is_first  = params.is_first != 0u;
        change.first_y = change.first_z = is_first ? 0u : BODY_NONE;
        change.last_y  = is_first ? params.nodes_y - 1u : 0u;
        change.last_z  = is_first ? params.nodes_z - 1u : 0u;
    }
    if (t >= params.triangles || params.is_first != 0u) return;
    mat3 now = body_triangle(t), was = mat3(before_of(triangle[3u * t]), before_of(triangle[3u * t + 1u]),
                                            before_of(triangle[3u * t + 2u]));
    if (now == was) return;
    vec3 lower = min(min(now[0], min(now[1], now[2])), min(was[0], min(was[1], was[2])));
    vec3 upper = max(max(now[0], max(now[1], now[2])), max(was[0], max(was[1], was[2])));
    // Bits of floats that are not negative are in the order of the floats.
    uvec3 low = floatBitsToUint(max(lower, vec3(0.0))), high = floatBitsToUint(max(upper, vec3(0.0)));
    // Threads that read an old value only do more than they must.
    if (low.x < change.lower_x) atomicMin(change.lower_x, low.x);
    if (low.y < change.lower_y) atomicMin(change.lower_y, low.y);
    if (low.z < change.lower_z) atomicMin(change.lower_z, low.z);
    if (high.x > change.upper_x) atomicMax(change.upper_x, high.x);
    if (high.y > change.upper_y) atomicMax(change.upper_y, high.y);
    if (high.z > change.upper_z) atomicMax(change.upper_z, high.z);
}
