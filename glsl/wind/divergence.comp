// divergence.comp - the right side of the pressure equation: the flow into a cell, which its
// pressure must drive out. The open fraction of a face carries the fluid, and the rest carries what
// closes the face. It also clears the pressure of the finest level. One thread per cell.
#version 450 core
#include "wind/fluid.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_WALL_VELOCITY) uniform samplerBuffer wall_velocity_texture;
layout(std430, binding = HAIR_BIND_PRESSURE) writeonly buffer pressure_buffer { float pressure[]; };
layout(std430, binding = HAIR_BIND_RHS) writeonly buffer rhs_buffer { float rhs[]; };

float flow_through(int axis, ivec3 at)
{
    int   face  = face_of(axis, at);
    float fraction = face_fraction(texelFetch(face_fraction_texture, index_of(at, fluid.cells + 1u)).x, axis);
    return mix(texelFetch(wall_velocity_texture, face).x, texelFetch(velocity_texture, face).x, fraction);
}

void main()
{
    uint i = thread();
    if (i >= fluid.cells * fluid.cells * fluid.cells) return;
    ivec3 at  = place_of(i, fluid.cells);
    float sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        sum += flow_through(axis, at) - flow_through(axis, at + axis_of(axis));
    rhs[i]    = sum;
    pressure[i] = 0.0;
}
