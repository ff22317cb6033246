// rotate_state.comp - turn the shape and motion of every guide about the head's origin. One thread
// per guide vertex.
#version 450 core
#include "sim/buffers.glsl"
#include "rotation.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;
#ifdef HAIR_ROD
#include "sim/rod_buffers.glsl"
#endif

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= params.vertices) return; // zink of Mesa 22.3 returns a wrong state.length() here.
    vec4 turn                 = quat_multiply(params.rotation_now, quat_conjugate(params.rotation_before));
    state[i].position.xyz     = rotate(turn, state[i].position.xyz);
    state[i].displacement.xyz = rotate(turn, state[i].displacement.xyz);
#ifdef HAIR_ROD
    material[i] = normalize(quat_multiply(turn, material[i]));
#if defined(HAIR_ROD) && defined(HAIR_MIXED)
    for (uint k = 0u; k < 3u; ++k) bend[3u * i + k].xyz = rotate(turn, bend[3u * i + k].xyz);
#endif
    if (i < history.length()) {
        history[i].rate.xyz        = rotate(turn, history[i].rate.xyz);
        history[i].rate_before.xyz = rotate(turn, history[i].rate_before.xyz);
    }
#endif
}
