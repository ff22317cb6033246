// fluid.glsl - the grid of the fluid: its indices and its velocities. See lib/wind/fluid.h.
//
// Positions are in cells from the corner of the box. A slot is a cell and the three faces on its
// lower sides. Along each axis there is one more slot than there are cells.
#ifndef HAIR_WIND_FLUID_GLSL
#define HAIR_WIND_FLUID_GLSL

#include "shared.h"
#include "workgroup.glsl"

layout(std140, binding = HAIR_BIND_FLUID) uniform fluid_buffer { hair_fluid_params fluid; };

layout(binding = HAIR_UNIT_VELOCITY) uniform samplerBuffer velocity_texture;
layout(binding = HAIR_UNIT_FACE_FRACTION) uniform usamplerBuffer face_fraction_texture;

uint thread() { return hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x; }

ivec3 place_of(uint i, uint side)
{
    return ivec3(i % side, i / side % side, i / (side * side));
}

int index_of(ivec3 at, uint side) { return at.x + int(side) * (at.y + int(side) * at.z); }

ivec3 axis_of(int k) { return ivec3(k == 0, k == 1, k == 2); }

// Return the index of a velocity component along an axis, in any of the velocity buffers.
int face_of(int axis, ivec3 at)
{
    int side = int(fluid.cells) + 1;
    return axis * side * side * side + index_of(at, uint(side));
}

// Return the centre of a face.
vec3 face_place(int axis, ivec3 at) { return vec3(at) + 0.5 * vec3(1 - axis_of(axis)); }

// Return the open fraction of a face, from the bits of a slot.
float face_fraction(uint slot, int axis) { return float(slot >> (10 * axis) & 1023u) / 1023.0; }

// Return whether a speed is finite and plausible. The test uses bits, because comparisons with NaN
// may be compiled away.
bool is_sound(float v) { return (floatBitsToUint(v) & 0x7fffffffu) <= floatBitsToUint(HAIR_FLUID_FASTEST); }

#endif
