// hair_grid_clear.comp - clear the hair-hair grid. One thread per four numbers.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;
layout(std430, binding = HAIR_BIND_HAIR_GRID) writeonly buffer hair_grid_buffer { ivec4 hair_grid[]; };

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i < uint(hair_grid.length())) hair_grid[i] = ivec4(0);
}
