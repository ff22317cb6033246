// skin_scalp.comp - skin the scalp by the joints of the application. One thread per vertex.
#version 450 core
#include "sim/scalp_buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_VERTEX_JOINTS) readonly buffer vertex_joints_buffer
{
    hair_vertex_joints vertex_joints[];
};
layout(std430, binding = HAIR_BIND_JOINT) readonly buffer joint_buffer { hair_joint joints[]; };

// Return the displacement of a vertex that moves with one joint only.
vec3 displacement(uint joint, vec3 rest)
{
    hair_joint own = joints[joint];
    vec4 at = vec4(rest, 1.0);
    return vec3(dot(own.row0, at), dot(own.row1, at), dot(own.row2, at)) - rest;
}

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= on.vertices) return;
    hair_vertex_joints own = vertex_joints[i];
    vec3 rest = vertex_at_rest(i);
    // Joints in their bind pose leave the vertex exactly at rest, although weights are rounded.
    vec3 at = rest + own.weights.x * displacement(own.joint0, rest) +
              own.weights.y * displacement(own.joint1, rest) +
              own.weights.z * displacement(own.joint2, rest) +
              own.weights.w * displacement(own.joint3, rest);
    for (uint k = 0u; k < 3u; ++k) scalp[3u * i + k] = at[k];
}
