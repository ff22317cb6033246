// project.comp - subtraction of the pressure gradient from the velocity of every face. A closed
// face gets the velocity of what closes it. Air between strands partly moves with them. Values that
// are not finite become the wind. One thread per slot.
#version 450 core
#include "wind/fluid.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_PRESSURE) uniform samplerBuffer pressure_texture;
layout(binding = HAIR_UNIT_WALL_VELOCITY) uniform samplerBuffer wall_velocity_texture;
layout(binding = HAIR_UNIT_BARE_FACE_FRACTION) uniform usamplerBuffer bare_face_fraction_texture;
layout(binding = HAIR_UNIT_BARE_WALL_VELOCITY) uniform samplerBuffer bare_wall_velocity_texture;
layout(std430, binding = HAIR_BIND_VELOCITY) buffer velocity_buffer { float velocity[]; };

// Return the mean velocity through the part of a face that colliders leave open. Hair leaves
// `fraction` of the face to air of the given speed.
float among_hair(int slot, int face, int axis, float fraction, float speed)
{
    float bare = face_fraction(texelFetch(bare_face_fraction_texture, slot).x, axis),
          hair = texelFetch(wall_velocity_texture, face).x;
    return (fraction * speed + (1.0 - fraction) * hair -
            (1.0 - bare) * texelFetch(bare_wall_velocity_texture, face).x) /
           bare;
}

void main()
{
    uint side = fluid.cells + 1u, i = thread();
    if (i >= side * side * side) return;
    ivec3 at   = place_of(i, side);
    uint  slot = texelFetch(face_fraction_texture, int(i)).x;
    for (int axis = 0; axis < 3; ++axis) {
        int   face = face_of(axis, at), n = int(fluid.cells);
        float speed = texelFetch(wall_velocity_texture, face).x;
        float fraction = face_fraction(slot, axis);
        if (fraction > 0.0) {
            bool  first = at[axis] == 0, last = at[axis] == n;
            int   above = index_of(min(at, n - 1), fluid.cells);
            int   below = index_of(max(at - axis_of(axis), 0), fluid.cells);
            float q     = last ? 0.0 : texelFetch(pressure_texture, above).x;
            float p     = first ? 0.0 : texelFetch(pressure_texture, below).x;
            speed       = velocity[face] - (first || last ? 2.0 : 1.0) * (q - p);
            if (fluid.thick > 0.0) speed = among_hair(int(i), face, axis, fraction, speed);
        }
        velocity[face] = is_sound(speed) ? speed : fluid.wind[axis];
    }
}
