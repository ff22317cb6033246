// density_clear.comp - an empty density grid, and a box that encloses nothing. One thread per four
// nodes. The drivers of GPUs take longer for glClearNamedBufferData() than for a pass.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_DENSITY) writeonly restrict buffer density_buffer { uvec4 density[]; };
layout(std430, binding = HAIR_BIND_DENSITY_BOX) writeonly restrict buffer box_buffer { uint box[6]; };

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i < uint(density.length())) density[i] = uvec4(0u);
    if (i < 6u) box[i] = 0xffffffffu;
}
