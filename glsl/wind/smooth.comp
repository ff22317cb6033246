// smooth.comp - half of a red-black Gauss-Seidel sweep. The pressures of the cells of one colour
// are solved for with those of the other colour. One thread per two cells.
#version 450 core
#include "wind/pressure.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_PRESSURE) writeonly buffer pressure_buffer { float pressure[]; };

void main()
{
    uint i = thread(), half_row = level.cells / 2u;
    if (i >= half_row * level.cells * level.cells) return;
    ivec3 at = ivec3(2u * (i % half_row), i / half_row % level.cells, i / (half_row * level.cells));
    at.x += (at.y + at.z + int(level.color)) & 1;
    fluid_cell cell = fetch_cell(at);
    float      own  = texelFetch(pressure_texture, cell_of(at)).x;
    if (cell.whole > 0.0)
        pressure[cell_of(at)] = own + level.relax * ((cell.rhs + cell.sum) / cell.whole - own);
}
