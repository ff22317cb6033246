// air.glsl - how air moves, at any place.
#ifndef HAIR_AIR_GLSL
#define HAIR_AIR_GLSL

#include "shared.h"

layout(std140, binding = HAIR_BIND_WIND) uniform wind_buffer { hair_wind_params wind; };

layout(binding = HAIR_UNIT_AIR) uniform sampler3D air_texture;

// Of a place from the head's origin, m, in the fluid's box; at its border, the last eighth on all sides, less and less.
float fluid_share(vec3 place)
{
    vec3 inside = clamp(8.0 * (0.5 - abs(place - 0.5)), 0.0, 1.0);
    return inside.x * inside.y * inside.z;
}

// m/s, at a place from the head's origin, m.
vec3 air_at(vec3 position)
{
    vec3 air = wind.velocity.xyz;
    if (wind.box.w == 0.0) return air;
    vec3 place = (position - wind.box.xyz) * wind.box.w;
    return mix(air, textureLod(air_texture, place, 0.0).xyz, fluid_share(place));
}

#endif
