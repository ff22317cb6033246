// gust.glsl - gusts at a position from the head's origin, from their texture. See lib/wind/gusts.h.
#ifndef HAIR_GUST_GLSL
#define HAIR_GUST_GLSL

#include "shared.h"
#include "rotation.glsl"

layout(binding = HAIR_UNIT_GUST) uniform sampler3D gust_texture;

// Return the gust at a position. `turn` and `from` are gust_turn and gust_from of hair_wind_params.
// `speed` is the standard deviation.
vec3 gust_of(vec4 turn, vec4 from, float speed, vec3 place)
{
    return speed > 0.0 ? speed * textureLod(gust_texture, from.xyz + from.w * rotate(turn, place), 0.0).xyz
                       : vec3(0.0);
}

#endif
