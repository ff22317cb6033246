// activity.comp - the activity of guides. Find the maximum distance of any guide vertex from its
// anchor, and the maximum speed, seen from a head that does not move. A thread loops over vertices.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_STATE) readonly restrict buffer state_buffer { hair_state state[]; };
layout(std430, binding = HAIR_BIND_ANCHOR) restrict buffer anchor_buffer { vec4 anchor[]; };
layout(std430, binding = HAIR_BIND_ACTIVITY) restrict buffer activity_buffer { uint activity[]; };
layout(std140, binding = HAIR_BIND_ACTIVITY_PARAMS) uniform activity_params_buffer
{
    hair_activity_params params;
};

// Distance and speed as bits. Non-negative floats have the same order as their bits.
shared uint max_value[2];

void main()
{
    uint thread = gl_LocalInvocationID.x, first = hair_group() * HAIR_GROUP_SIZE + thread;
    if (thread < 2u) max_value[thread] = 0u;
    if (first < 2u) activity[2u - 2u * params.parity + first] = 0u;
    synchronise();
    float away = 0.0, speed = 0.0;
    for (uint i = first; i < params.vertices; i += hair_group_count() * HAIR_GROUP_SIZE) {
        vec3 at = state[i].position.xyz;
        away    = max(away, distance(at, anchor[i].xyz));
        speed   = max(speed, params.rate * length(state[i].displacement.xyz));
        if (params.anchors > 0u) anchor[i] = vec4(at, 0.0);
    }
    atomicMax(max_value[0], floatBitsToUint(away));
    atomicMax(max_value[1], floatBitsToUint(speed));
    synchronise();
    if (thread < 2u) atomicMax(activity[2u * params.parity + thread], max_value[thread]);
}
