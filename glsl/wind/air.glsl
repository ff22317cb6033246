// air.glsl - how air moves, at any place.
#ifndef HAIR_AIR_GLSL
#define HAIR_AIR_GLSL

#include "shared.h"

layout(std140, binding = HAIR_BIND_WIND) uniform wind_buffer { hair_wind_params wind; };

// m/s, at a place from the head's origin, m.
vec3 air_at(vec3 position) { return wind.velocity.xyz; }

#endif
