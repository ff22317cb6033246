// displace.comp - displacements of smoothed guides from their shape at rest, which followers with a
// shape of their own share. One work group per guide.
//
// A displacement is smoothed by a Gaussian along the guide. The displacement of a curled guide
// oscillates with its curls, whose phase is not that of the follower. It would zig-zag the
// follower's curls. Smoothing keeps the displacement at root and tip, beyond which it is odd about
// its value there.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
#include "rotation.glsl"
#include "strands/packed_frame.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

// Standard deviations of the Gaussian in the length of a guide, and its reach in them.
#define DEVIATIONS 16.0
#define REACH 2.5

layout(std430, binding = HAIR_BIND_POSITION) buffer position_buffer { vec4 smooth_position[]; };
layout(std430, binding = HAIR_BIND_FRAME) readonly buffer frame_buffer { uvec2 smooth_frame[]; };
layout(std430, binding = HAIR_BIND_GUIDE_SHAPE) readonly buffer guide_shape_buffer { vec4 guide_shape[]; };
layout(std140, binding = HAIR_BIND_STEP) uniform step_buffer { hair_step_params params; };

shared vec3 raw[HAIR_MAX_SMOOTH_VERTICES];

// Return the displacement at a vertex, which may lie beyond root or tip.
vec3 displacement(int k, int last)
{
    if (k < 0) return -raw[min(-k, last)];
    if (k > last) return 2.0 * raw[last] - raw[max(2 * last - k, 0)];
    return raw[k];
}

void main()
{
    uint g = hair_group();
    if (g >= params.guides) return;
    uint first = g * params.smooth_vertices;
    int  last  = int(params.smooth_vertices) - 1;
    vec3 root  = smooth_position[first].xyz;
    vec4 frame = unpack_frame(smooth_frame[first]);
    for (int k = int(gl_LocalInvocationID.x); k <= last; k += HAIR_GROUP_SIZE)
        raw[k] = smooth_position[first + uint(k)].xyz - root -
                 rotate(frame, guide_shape[first + uint(k)].xyz);
    synchronise();
    float deviation = float(last) / DEVIATIONS;
    int   reach     = int(REACH * deviation);
    for (int k = int(gl_LocalInvocationID.x); k <= last; k += HAIR_GROUP_SIZE) {
        vec3  sum  = raw[k];
        float over = 1.0;
        for (int i = 1; i <= reach; ++i) {
            float weight = exp(-0.5 * float(i * i) / (deviation * deviation));
            sum  += weight * (displacement(k - i, last) + displacement(k + i, last));
            over += 2.0 * weight;
        }
        smooth_position[params.guides * params.smooth_vertices + first + uint(k)] = vec4(sum / over, 0.0);
    }
}
