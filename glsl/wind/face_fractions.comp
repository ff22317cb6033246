// face_fractions.comp - the open fraction of each face, and the velocity of what closes it along
// the axis of the face. The method is that of Ng, Min and Gibou 2009, "An efficient fluid-collider
// coupling algorithm for single-phase flows". The open part lies outside all colliders by the
// distance field. It is measured in sixteenths of the face, and in fractions of them where a
// surface passes through one. One thread per slot.
#version 450 core
#include "wind/fluid.glsl"
#include "field.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_WALL_VELOCITY) writeonly buffer wall_velocity_buffer
{
    float wall_velocity[];
};
layout(std430, binding = HAIR_BIND_FACE_FRACTION) writeonly buffer face_fraction_buffer { uint slots[]; };
layout(std430, binding = HAIR_BIND_MOTION) readonly buffer motion_buffer { hair_fluid_motion motion[]; };

vec3 position_of(vec3 place) { return fluid.lower.xyz + fluid.lower.w * place; }

// Return a position as a fraction of the field's box. The distance field belongs to the head pose
// of its last update, whereas this pose is that of the current step.
vec3 box_place(vec3 place)
{
    return (rotate(quat_conjugate(fluid.rotation), position_of(place)) - field.lower.xyz) * field.inverse.xyz;
}

// Return the distance to the nearest collider, in cells.
float distance_at(vec3 place)
{
    vec3 in_field = box_place(place);
    return (field_holds(in_field) ? textureLod(field_texture, in_field, 0.0).x : field.inverse.w) /
           fluid.lower.w;
}

// Return the open fraction of a face with the given centre. a and b are the two directions along
// the face.
float find_open_fraction(vec3 middle, vec3 a, vec3 b)
{
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        vec3  quarter  = middle + (float(k & 1) - 0.5) * 0.5 * a + (float(k >> 1) - 0.5) * 0.5 * b;
        float distance = distance_at(quarter);
        if (abs(distance) > 0.36) { // Half the diagonal of a quarter, and rounding.
            sum += distance > 0.0 ? 0.25 : 0.0;
            continue;
        }
        for (int j = 0; j < 4; ++j) {
            vec3 part = quarter + (float(j & 1) - 0.5) * 0.25 * a + (float(j >> 1) - 0.5) * 0.25 * b;
            sum += clamp(0.5 + 4.0 * distance_at(part), 0.0, 1.0) / 16.0;
        }
    }
    return sum;
}

vec3 find_wall_velocity(vec3 place)
{
    uint number = field_collider(box_place(place));
    if (number >= uint(motion.length())) return vec3(0.0);
    return motion[number].velocity.xyz + cross(motion[number].spin.xyz, position_of(place));
}

void main()
{
    uint side = fluid.cells + 1u, i = thread();
    if (i >= side * side * side) return;
    ivec3 at   = place_of(i, side);
    uint  slot = 0u;
    for (int axis = 0; axis < 3; ++axis) {
        vec3  middle = face_place(axis, at), velocity = vec3(0.0);
        bool  border = at[axis] == 0 || at[axis] == int(fluid.cells);
        float fraction  = border && fluid.open == 0u ? 0.0 : 1.0;
        if (any(greaterThanEqual(at, ivec3(fluid.cells) + axis_of(axis)))) fraction = 0.0;
        if (fluid.colliders != 0u && fraction > 0.0) {
            fraction =
                find_open_fraction(middle, vec3(axis_of((axis + 1) % 3)), vec3(axis_of((axis + 2) % 3)));
            if (fraction < 1.0) velocity = find_wall_velocity(middle);
        }
        slot |= uint(fraction * 1023.0 + 0.5) << (10 * axis);
        wall_velocity[face_of(axis, at)] = velocity[axis];
    }
    slots[i] = slot;
}
