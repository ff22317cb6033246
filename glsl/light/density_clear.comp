// density_clear.comp - a box that encloses nothing, and an empty density grid. One thread per four
// numbers. The drivers of GPUs take longer for glClearNamedBufferData() than for a pass.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_DENSITY) writeonly restrict buffer density_buffer { uvec4 words[]; };

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i < uint(words.length())) words[i] = uvec4(i < HAIR_DENSITY_FIRST / 4u ? 0xffffffffu : 0u);
}
