// guide_positions.glsl - positions of the samples of smoothed guides. xyz is relative to the head's
// origin. w is the length from the root. Compute shaders read storage buffers. OpenGL guarantees
// those to no other stage, so that the stages that draw read textures.
#ifndef HAIR_GUIDE_POSITIONS_GLSL
#define HAIR_GUIDE_POSITIONS_GLSL

#include "draw_params.glsl"

#ifdef HAIR_STORED
layout(std430, binding = HAIR_BIND_STORED_POSITION) readonly restrict buffer position_buffer
{
    vec4 stored_position[];
};

vec4 fetch_position(int at) { return stored_position[at]; }
#else
layout(binding = HAIR_UNIT_POSITION) uniform samplerBuffer position_texture;

vec4 fetch_position(int at) { return texelFetch(position_texture, at); }
#endif

#endif
