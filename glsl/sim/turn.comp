// turn.comp - turn shape and motion of every guide about the head's origin. One thread per guide vertex.
#version 450 core
#include "buffers.glsl"
#include "rotation.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= state.length()) return;
    vec4 turn             = quat_multiply(params.rotation_now, quat_conjugate(params.rotation_before));
    state[i].position     = vec4(rotate(turn, state[i].position.xyz), 0.0);
    state[i].displacement = vec4(rotate(turn, state[i].displacement.xyz), 0.0);
}
