// jacobi.comp - a Jacobi sweep. Every pressure is solved for with its neighbours' old pressures.
// One thread per cell.
#version 450 core
#include "wind/pressure.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_PRESSURE) writeonly buffer pressure_buffer { float pressure[]; };

void main()
{
    uint i = thread();
    if (i >= level.cells * level.cells * level.cells) return;
    ivec3      at   = place_of(i, level.cells);
    fluid_cell cell = fetch_cell(at);
    float      own  = texelFetch(pressure_texture, cell_of(at)).x;
    if (cell.whole > 0.0) own += level.relax * ((cell.rhs + cell.sum) / cell.whole - own);
    pressure[i] = own;
}
