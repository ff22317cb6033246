// position_texture.glsl - where the samples of smoothed guides are: xyz from the head's origin, w: length from the root.
#ifndef HAIR_POSITION_TEXTURE_GLSL
#define HAIR_POSITION_TEXTURE_GLSL

#include "draw_params.glsl"

layout(binding = HAIR_UNIT_POSITION) uniform samplerBuffer position_texture;

#endif
