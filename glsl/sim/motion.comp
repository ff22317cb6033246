// motion.comp - the speed of guides relative to the head, and their stretch, after the last
// substep.
//
// A thread loops over the vertices of a guide. A guide is restless if it moves although damping has
// had the time to calm it. lib/sim/solver_stats.c explains this.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
#include "rotation.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

#define RESTLESS_SPEED 0.02 // Speed of a restless guide, m/s: 20 times the maximum of hair at rest
#define OVERSTRETCHED 0.01  // Relative error of length, as TOO_LONG of length_constraints.glsl

layout(std430, binding = HAIR_BIND_GUIDE) readonly restrict buffer guide_buffer { hair_guide guide[]; };
layout(std430, binding = HAIR_BIND_REST) readonly restrict buffer rest_buffer { hair_rest rest[]; };
layout(std430, binding = HAIR_BIND_STATE) readonly restrict buffer state_buffer { hair_state state[]; };
layout(std430, binding = HAIR_BIND_FOUND) restrict buffer found_buffer { uint found[]; };
layout(std140, binding = HAIR_BIND_MOTION_PARAMS) uniform motion_params_buffer { hair_motion_params params; };

// Return the displacement of a vertex relative to a point of the head that was at its place before
// the last substep.
vec3 motion_of(hair_state vertex)
{
    vec3 own    = vertex.displacement.xyz - params.moved.xyz;
    vec3 before = vertex.position.xyz - own, t = 2.0 * cross(params.turn.xyz, before);
    // This form loses no digits if the head is at rest.
    return own - (params.turn.w * t + cross(params.turn.xyz, t));
}

void main()
{
    uint g = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (g >= params.guides) return;
    uint  first = guide[g].first, last = first + guide[g].count - 1u;
    float motion = 0.0, stretch = 0.0;
    for (uint i = first; i <= last; ++i) {
        motion = max(motion, length(motion_of(state[i])));
        if (i == last) break;
        float l = distance(state[i].position.xyz, state[i + 1u].position.xyz);
        stretch = max(stretch, abs(l / rest[i].position.w - 1.0));
    }
    float speed = params.moved.w * motion;
    // Non-negative floats have the same order as their bits.
    atomicMax(found[HAIR_FOUND_FASTEST], floatBitsToUint(speed));
    atomicMax(found[HAIR_FOUND_STRETCH], floatBitsToUint(stretch));
    if (stretch > OVERSTRETCHED) atomicAdd(found[HAIR_FOUND_OVERSTRETCHED], 1u);
    bool rests = params.calm <= params.wait + params.creep * guide[g].arc_length;
    if (!rests && speed > RESTLESS_SPEED) atomicAdd(found[HAIR_FOUND_RESTLESS], 1u);
}
