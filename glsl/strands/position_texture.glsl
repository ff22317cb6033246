// position_texture.glsl - positions of the samples of smoothed guides. xyz is relative to the
// head's origin. w is the length from the root.
#ifndef HAIR_POSITION_TEXTURE_GLSL
#define HAIR_POSITION_TEXTURE_GLSL

#include "draw_params.glsl"

layout(binding = HAIR_UNIT_POSITION) uniform samplerBuffer position_texture;

#endif
