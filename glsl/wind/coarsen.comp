// coarsen.comp - open fractions of the faces of the next coarser level. Each is the mean of the
// four faces that form it. One thread per slot of that level.
#version 450 core
#include "wind/level.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_FACE_FRACTION) buffer face_fraction_buffer { uint slots[]; };

void main()
{
    uint cells = level.cells / 2u, i = thread();
    if (i >= (cells + 1u) * (cells + 1u) * (cells + 1u)) return;
    ivec3 at   = place_of(i, cells + 1u);
    uint  slot = 0u;
    for (int axis = 0; axis < 3; ++axis) {
        if (any(greaterThanEqual(at, ivec3(cells) + axis_of(axis)))) continue;
        ivec3 a   = axis_of((axis + 1) % 3), b = axis_of((axis + 2) % 3);
        uint  sum = 2u;
        for (int k = 0; k < 4; ++k) {
            ivec3 fine = 2 * at + (k & 1) * a + (k >> 1) * b;
            sum += texelFetch(face_fraction_texture, int(level.slot) + index_of(fine, level.cells + 1u)).x >>
                       (10 * axis) &
                   1023u;
        }
        slot |= sum / 4u << (10 * axis);
    }
    slots[level.coarse_slot + i] = slot;
}
