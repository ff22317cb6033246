// body_unpack.comp - copy the vertices of a body out of the application's buffer, which may hold
// other data between them. A vertex outside the box of the body comes to its surface. A vertex that
// is not finite stays where it was. One thread per vertex.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std140, binding = HAIR_BIND_BODY) uniform body_buffer { hair_body_params params; };
layout(std430, binding = HAIR_BIND_BODY_POSITION) writeonly buffer position_buffer { float position[]; };
layout(std430, binding = HAIR_BIND_GIVEN) readonly buffer given_buffer { float given[]; };
layout(std430, binding = HAIR_BIND_BODY_BEFORE) readonly buffer before_buffer { float before[]; };

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= params.vertices) return;
    vec3 at;
    for (uint k = 0u; k < 3u; ++k) at[k] = given[params.given_first + i * params.given_stride + k];
    bool is_wrong = any(isnan(at)) || any(isinf(at));
    at = clamp((at - params.origin.xyz) / params.voxel, params.lower.xyz, params.upper.xyz);
    for (uint k = 0u; k < 3u; ++k) position[3u * i + k] = is_wrong ? before[3u * i + k] : at[k];
}
