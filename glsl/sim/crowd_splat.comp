// crowd_splat.comp - a guide vertex's mass, momentum and volume given to the eight nodes around it: of each exactly
// what it has, the last node getting what rounding left. The fluid's grid has no volume, and ends. One thread per guide
// vertex.
#version 450 core
#include "sim/crowd.glsl"

void main()
{
    uint i = thread();
    if (i >= params.vertices || !counts(i)) return;
#ifdef HAIR_FLUID
    vec3 from = (state[i].position.xyz - params.lower.xyz) / params.lower.w;
    if (any(notEqual(from, clamp(from, vec3(-0.5), vec3(nodes()) - 0.5)))) return;
#endif
    find_spot(i);
    ivec4 motion = ivec4(int(share[i].mass), ivec3(floor(float(share[i].mass) * speed_of(i) + 0.5)));
    int   volume = int(share[i].volume);
    ivec4 motion_left = motion;
    int   volume_left = volume;
    uint  all         = params.nodes_x * params.nodes_y * params.nodes_z;
    for (uint k = 0u; k < 8u; ++k) {
        uvec3 corner = corner_of(k);
        vec3  s      = shares_of(corner);
        float weight = s.x * s.y * s.z;
        ivec4 m      = k == 7u ? motion_left : ivec4(floor(vec4(motion) * weight + 0.5));
        int   v      = k == 7u ? volume_left : int(floor(float(volume) * weight + 0.5));
        uint  node   = node_of(corner);
        atomicAdd(crowd[4u * node], m.x);
        atomicAdd(crowd[4u * node + 1u], m.y);
        atomicAdd(crowd[4u * node + 2u], m.z);
        atomicAdd(crowd[4u * node + 3u], m.w);
#ifndef HAIR_FLUID
        atomicAdd(crowd[4u * all + node], v);
#endif
        motion_left -= m;
        volume_left -= v;
    }
}
