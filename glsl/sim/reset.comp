// reset.comp - set every guide to its rest pose, at rest, under the head's current pose. One thread
// per guide vertex.
#version 450 core
#include "sim/buffers.glsl"
#include "sim/root_transforms.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;
#ifdef HAIR_ROD
#include "sim/rod_buffers.glsl"
#endif

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= rest.length()) return;
    vec3 place = rest[i].position.xyz;
    vec4 turn  = params.rotation_now;
#ifdef HAIR_SKINNED
    // Find the guide of the vertex by bisection.
    uint low = 0u, high = params.guides;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (guide[middle].first <= i) low = middle;
        else high = middle;
    }
    root_transform r = root_transform_of(low, HAIR_ROOT_TRANSFORM_END);
    place  = carry(r, rest[guide[low].first].position.xyz, place);
    turn   = quat_multiply(turn, r.turn);
#endif
    state[i].position     = vec4(rotate(params.rotation_now, place), 0.0);
    state[i].displacement = vec4(0.0);
#ifdef HAIR_ROD
    material[i] = quat_multiply(turn, rest[i].frame);
    if (i < history.length()) history[i] = hair_history(vec4(0.0), vec4(0.0));
#endif
#if defined(HAIR_ROD) && defined(HAIR_MIXED)
    for (uint k = 0u; k < 3u; ++k) bend[3u * i + k] = vec4(0.0);
#endif
}
