// coarse_solve.comp - the coarsest multigrid level, of at most 8 cells along an axis. One work
// group solves it by red-black Gauss-Seidel sweeps with overrelaxation suited to so few cells.
#version 450 core
#include "wind/pressure.glsl"
layout(local_size_x = HAIR_FLUID_COARSEST_THREADS) in;

layout(std430, binding = HAIR_BIND_PRESSURE) writeonly buffer pressure_buffer { float pressure[]; };

#define SWEEPS 16
#define BEYOND 1.4 // Overrelaxation factor.

shared float solved[2 * HAIR_FLUID_COARSEST_THREADS];

struct coarsest_cell {
    int   at, n;
    ivec3 place;
    float rhs, whole;
    vec3  below, above; // Open fractions. 0 where there is no neighbour.
};

coarsest_cell fetch_coarsest(uint i)
{
    coarsest_cell cell;
    int         n = int(level.cells);
    cell.n        = n;
    cell.at       = int(i);
    cell.place    = place_of(min(i, uint(n * n * n - 1)), level.cells);
    cell.whole    = 0.0;
    int slot      = int(level.slot) + index_of(cell.place, level.cells + 1u);
    ivec3 next    = ivec3(1, n + 1, (n + 1) * (n + 1));
    for (int axis = 0; axis < 3; ++axis) {
        bool  first      = cell.place[axis] == 0, last = cell.place[axis] == n - 1;
        float below      = face_fraction(texelFetch(face_fraction_texture, slot).x, axis);
        float above      = face_fraction(texelFetch(face_fraction_texture, slot + next[axis]).x, axis);
        cell.whole += (first ? 2.0 : 1.0) * below + (last ? 2.0 : 1.0) * above;
        cell.below[axis] = first ? 0.0 : below;
        cell.above[axis] = last ? 0.0 : above;
    }
    if (i >= uint(n * n * n)) cell.whole = 0.0;
    cell.rhs = texelFetch(rhs_texture, cell_of(cell.place)).x;
    return cell;
}

void relax(coarsest_cell cell, int color)
{
    if (cell.whole == 0.0 || ((cell.place.x + cell.place.y + cell.place.z) & 1) != color) return;
    ivec3 stride = ivec3(1, cell.n, cell.n * cell.n);
    float sum    = cell.rhs;
    for (int axis = 0; axis < 3; ++axis) {
        if (cell.below[axis] > 0.0) sum += cell.below[axis] * solved[cell.at - stride[axis]];
        if (cell.above[axis] > 0.0) sum += cell.above[axis] * solved[cell.at + stride[axis]];
    }
    solved[cell.at] += BEYOND * (sum / cell.whole - solved[cell.at]);
}

void main()
{
    uint        i = gl_LocalInvocationID.x, count = level.cells * level.cells * level.cells;
    coarsest_cell a = fetch_coarsest(i), b = fetch_coarsest(i + HAIR_FLUID_COARSEST_THREADS);
    solved[i] = solved[i + HAIR_FLUID_COARSEST_THREADS] = 0.0;
    synchronise();
    for (int half_sweep = 0; half_sweep < 2 * SWEEPS; ++half_sweep) {
        relax(a, half_sweep & 1);
        relax(b, half_sweep & 1);
        synchronise();
    }
    if (i < count) pressure[level.cell + i] = solved[i];
    if (i + HAIR_FLUID_COARSEST_THREADS < count)
        pressure[level.cell + i + HAIR_FLUID_COARSEST_THREADS] = solved[i + HAIR_FLUID_COARSEST_THREADS];
}
