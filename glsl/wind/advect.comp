// advect.comp - advection of the fluid's velocities. Each face gets the velocity at the point from
// which its fluid comes, linear between faces (Stam 1999, "Stable Fluids"). Fluid from outside the
// box has the velocity of the wind there. One thread per slot.
#version 450 core
#include "wind/backtrace.glsl"
#include "wind/ambient.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_VELOCITY) writeonly buffer velocity_buffer { float velocity[]; };

void main()
{
    uint side = fluid.cells + 1u, i = thread();
    if (i >= side * side * side) return;
    ivec3 at = place_of(i, side);
    for (int axis = 0; axis < 3; ++axis) {
        vec3  from = backtrace(face_place(axis, at) + fluid.shift.xyz, -1.0);
        vec4  near, far;
        float advected = ambient_at(from - fluid.shift.xyz)[axis];
        if (is_in_box(from)) {
            face_stencil stencil = stencil_at(axis, from);
            fetch_faces(velocity_texture, axis, stencil, near, far);
            advected = between(near, far, stencil.part);
        }
        velocity[face_of(axis, at)] = advected;
    }
}
