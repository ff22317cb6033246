// prolong.comp - prolongation: the pressure of the coarser cell that contains a cell is added to
// the pressure of the cell. One thread per cell.
#version 450 core
#include "wind/level.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_PRESSURE) uniform samplerBuffer pressure_texture;
layout(std430, binding = HAIR_BIND_PRESSURE) writeonly buffer pressure_buffer { float pressure[]; };

void main()
{
    uint i = thread();
    if (i >= level.cells * level.cells * level.cells) return;
    int coarse = int(level.coarse_cell) + index_of(place_of(i, level.cells) / 2, level.cells / 2u);
    int own    = int(level.cell + i);
    pressure[own] = texelFetch(pressure_texture, own).x + texelFetch(pressure_texture, coarse).x;
}
