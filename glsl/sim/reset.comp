// reset.comp - every guide in its rest pose, at rest, under the head's pose now. One thread per guide vertex.
#version 450 core
#include "buffers.glsl"
#include "rotation.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;
#ifdef HAIR_ROD
#include "sim/rod_buffers.glsl"
#endif

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= rest.length()) return;
    state[i].position     = vec4(rotate(params.rotation_now, rest[i].position.xyz), 0.0);
    state[i].displacement = vec4(0.0);
#ifdef HAIR_ROD
    material[i] = quat_multiply(params.rotation_now, rest[i].frame);
    if (i < history.length()) history[i] = hair_history(vec4(0.0), vec4(0.0));
#endif
}
