// restrict.comp - restriction: the residual of eight cells becomes the right side of the coarser
// cell that they form. It is halved, because the coarser cell's neighbours are twice as far away.
// It also clears the pressure of the coarser level. One thread per coarser cell.
#version 450 core
#include "wind/pressure.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_PRESSURE) writeonly buffer pressure_buffer { float pressure[]; };
layout(std430, binding = HAIR_BIND_RHS) writeonly buffer rhs_buffer { float rhs[]; };

void main()
{
    uint cells = level.cells / 2u, i = thread();
    if (i >= cells * cells * cells) return;
    ivec3 at  = 2 * place_of(i, cells);
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) sum += residual_at(at + ivec3(k & 1, k >> 1 & 1, k >> 2));
    rhs[level.coarse_cell + i]    = 0.5 * sum;
    pressure[level.coarse_cell + i] = 0.0;
}
