// pressure.glsl - the equation of a cell, for its pressure p, in m/s, and the pressures p_k of its
// neighbours:
//
//   sum_k w_k (p - p_k) = right side
//
// w_k is the open fraction of the face between them. Outside the box the pressure is 0. It is 0 at
// the border itself, which is half as far away as a neighbour.
#include "wind/level.glsl"

layout(binding = HAIR_UNIT_PRESSURE) uniform samplerBuffer pressure_texture;
layout(binding = HAIR_UNIT_RHS) uniform samplerBuffer rhs_texture;

struct fluid_cell {
    float sum;   // Sum of w_k p_k.
    float whole; // Sum of w_k. 0 if the cell is inside a collider.
    float rhs;
};

int cell_of(ivec3 at) { return int(level.cell) + index_of(at, level.cells); }

fluid_cell fetch_cell(ivec3 at)
{
    int n = int(level.cells), own = cell_of(at), slot = int(level.slot) + index_of(at, level.cells + 1u);
    ivec3      stride = ivec3(1, n, n * n), next = ivec3(1, n + 1, (n + 1) * (n + 1));
    uint       lower  = texelFetch(face_fraction_texture, slot).x;
    fluid_cell cell   = fluid_cell(0.0, 0.0, texelFetch(rhs_texture, own).x);
    for (int axis = 0; axis < 3; ++axis) {
        bool  first = at[axis] == 0, last = at[axis] == n - 1;
        float below = face_fraction(lower, axis);
        float above = face_fraction(texelFetch(face_fraction_texture, slot + next[axis]).x, axis);
        float p     = texelFetch(pressure_texture, first ? own : own - stride[axis]).x;
        float q     = texelFetch(pressure_texture, last ? own : own + stride[axis]).x;
        cell.sum += (first ? 0.0 : below * p) + (last ? 0.0 : above * q);
        cell.whole += (first ? 2.0 : 1.0) * below + (last ? 2.0 : 1.0) * above;
    }
    return cell;
}

float residual_at(ivec3 at)
{
    fluid_cell cell = fetch_cell(at);
    float      own  = texelFetch(pressure_texture, cell_of(at)).x;
    return cell.whole > 0.0 ? cell.rhs - (cell.whole * own - cell.sum) : 0.0;
}
