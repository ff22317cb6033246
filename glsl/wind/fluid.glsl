// fluid.glsl - the grid of the fluid: where its numbers are, and its velocities at any place. See lib/wind/fluid.h.
//
// Places are in sides of a cell from the box's corner. A slot is the cell of the same number along each axis, and the three
// faces below it: there are one more of them along each axis than cells.
#ifndef HAIR_WIND_FLUID_GLSL
#define HAIR_WIND_FLUID_GLSL

#include "shared.h"
#include "workgroup.glsl"

layout(std140, binding = HAIR_BIND_FLUID) uniform fluid_buffer { hair_fluid_params fluid; };
layout(std140, binding = HAIR_BIND_LEVEL) uniform level_buffer { hair_fluid_level level; };

layout(binding = HAIR_UNIT_VELOCITY) uniform samplerBuffer velocity_texture;
layout(binding = HAIR_UNIT_OPEN) uniform usamplerBuffer open_texture;

uint thread() { return hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x; }

ivec3 place_of(uint i, uint side)
{
    return ivec3(i % side, i / side % side, i / (side * side));
}

int index_of(ivec3 at, uint side) { return at.x + int(side) * (at.y + int(side) * at.z); }

ivec3 axis_of(int k) { return ivec3(k == 0, k == 1, k == 2); }

// Of the component along the axis in any of the buffers of velocities.
int face_of(int axis, ivec3 at)
{
    int side = int(fluid.cells) + 1;
    return axis * side * side * side + index_of(at, uint(side));
}

// The middle of a face.
vec3 face_place(int axis, ivec3 at) { return vec3(at) + 0.5 * vec3(1 - axis_of(axis)); }

// Share of a face that is open, by what a slot holds.
float open_share(uint slot, int axis) { return float(slot >> (10 * axis) & 1023u) / 1023.0; }

// By the bits, for comparisons with NaN may be compiled away.
bool is_sound(float v) { return (floatBitsToUint(v) & 0x7fffffffu) <= floatBitsToUint(HAIR_FLUID_FASTEST); }

#endif
