// unpack_positions.comp - copy positions out of the application's buffer, which may hold other data
// between them. One thread per vertex.
#version 450 core
#include "sim/scalp_buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_GIVEN) readonly buffer given_buffer { float given[]; };

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= on.vertices) return;
    for (uint k = 0u; k < 3u; ++k) scalp[3u * i + k] = given[on.first + i * on.stride + k];
}
