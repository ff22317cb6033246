// project.comp - the pressure's slope taken from the velocity of every face; a face that is closed goes with what closes it.
// What is not sound becomes the wind. One thread per slot.
#version 450 core
#include "wind/fluid.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_PRESSURE) uniform samplerBuffer pressure_texture;
layout(binding = HAIR_UNIT_WALL) uniform samplerBuffer wall_texture;
layout(std430, binding = HAIR_BIND_VELOCITY) buffer velocity_buffer { float velocity[]; };

void main()
{
    uint side = fluid.cells + 1u, i = thread();
    if (i >= side * side * side) return;
    ivec3 at   = place_of(i, side);
    uint  slot = texelFetch(open_texture, int(i)).x;
    for (int axis = 0; axis < 3; ++axis) {
        int   face = face_of(axis, at), n = int(fluid.cells);
        float speed = texelFetch(wall_texture, face).x;
        if (open_share(slot, axis) > 0.0) {
            bool  first = at[axis] == 0, last = at[axis] == n;
            int   above = index_of(min(at, n - 1), fluid.cells);
            int   below = index_of(max(at - axis_of(axis), 0), fluid.cells);
            float q     = last ? 0.0 : texelFetch(pressure_texture, above).x;
            float p     = first ? 0.0 : texelFetch(pressure_texture, below).x;
            speed       = velocity[face] - (first || last ? 2.0 : 1.0) * (q - p);
        }
        velocity[face] = is_sound(speed) ? speed : fluid.wind[axis];
    }
}
