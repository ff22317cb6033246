// gust.glsl - gusts at a place from the head's origin, out of their texture: see lib/wind/gusts.h.
#ifndef HAIR_GUST_GLSL
#define HAIR_GUST_GLSL

#include "shared.h"
#include "rotation.glsl"

layout(binding = HAIR_UNIT_GUST) uniform sampler3D gust_texture;

// `turn` and `from` as in hair_wind_params; `speed` is the standard deviation.
vec3 gust_of(vec4 turn, vec4 from, float speed, vec3 place)
{
    return speed > 0.0 ? speed * textureLod(gust_texture, from.xyz + from.w * rotate(turn, place), 0.0).xyz : vec3(0.0);
}

#endif
