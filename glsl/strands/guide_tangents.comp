// guide_tangents.comp - tangents of smoothed guides, for the application. One thread per vertex.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
#include "strands/packed_frame.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_FRAME) readonly buffer frame_buffer { uvec2 smooth_frame[]; };
layout(std430, binding = HAIR_BIND_TANGENT) writeonly buffer tangent_buffer { vec4 smooth_tangent[]; };
layout(std140, binding = HAIR_BIND_STEP) uniform step_buffer { hair_step_params params; };

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= params.guides * params.smooth_vertices) return;
    smooth_tangent[i] = vec4(tangent_of(unpack_frame(smooth_frame[i])), 0.0);
}
