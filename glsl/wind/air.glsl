// air.glsl - how air moves, at any place: the wind and its gusts, diverted by what is in their way, or the
// fluid in its box; what blows from places; and the application's texture.
#ifndef HAIR_AIR_GLSL
#define HAIR_AIR_GLSL

#include "shared.h"
#include "rotation.glsl"
#include "wind/gust.glsl"

layout(std140, binding = HAIR_BIND_WIND) uniform wind_buffer { hair_wind_params wind; };
layout(binding = HAIR_UNIT_AIR) uniform sampler3D air_texture;
layout(binding = HAIR_UNIT_VOLUME) uniform sampler3D volume_texture;

// Taylor's frozen turbulence: the pattern goes along with the wind.
vec3 gust_at(vec3 place, float time)
{
    return gust_of(wind.gust_turn, wind.gust_from, wind.velocity.w, place - wind.velocity.xyz * time);
}

// Around a ball, with p from its centre in radii, and x how far that is down the wind. Potential flow has no part into it;
// behind it is a wake of a drag coefficient of 0.5, Gaussian and with the momentum that takes (Bastankhah and Porte-Agel
// 2014), into which still air behind the ball goes over within some four radii.
vec3 around_ball(vec3 u, vec3 p, vec3 down)
{
    float r     = max(length(p), 1e-6), s = 1.0 / (max(r, 1.0) * max(r, 1.0) * max(r, 1.0));
    vec3  n     = p / r;
    float x     = dot(p, down), beside = max(dot(p, p) - x * x, 0.0);
    float width = 0.7 + 0.1 * max(x, 0.0), still = exp(-0.12 * x * x);
    float wake  = mix(1.0 - sqrt(max(1.0 - 0.25 / (width * width), 0.0)), 1.0, still);
    float lack  = wake * exp(-0.5 * beside / (width * width)) * smoothstep(-0.4, 0.6, x);
    return (1.0 - lack) * (u + 0.5 * s * (u - 3.0 * dot(u, n) * n));
}

// To all sides, the same volume through every sphere; or a round turbulent jet, which keeps its momentum and whose width
// at half its speed grows by 0.094 of the way (Pope 2000, "Turbulent Flows").
vec3 from_source(uint k, vec3 place)
{
    vec3  p = place - wind.source[k].xyz, way = wind.jet[k].xyz;
    float radius = wind.source[k].w, speed = wind.jet[k].w, r = length(p);
    if (dot(way, way) == 0.0) return speed * p / radius * min(1.0, pow(radius / max(r, radius), 3.0));
    float x = dot(p, way), half_width = radius + 0.094 * max(x, 0.0);
    float share = max(dot(p, p) - x * x, 0.0) / (half_width * half_width);
    return speed * radius / half_width * exp2(-share) * smoothstep(-radius, 0.0, x) * way;
}

// Of a place from the head's origin, m, in the fluid's box; at its border, the last eighth on all sides, less and less.
float fluid_share(vec3 place)
{
    vec3 inside = clamp(8.0 * (0.5 - abs(place - 0.5)), 0.0, 1.0);
    return inside.x * inside.y * inside.z;
}

// Gusts come into the fluid with the air that does.
vec3 in_fluid(vec3 place, vec3 around)
{
    vec3 at = (place - wind.box.xyz) * wind.box.w;
    return mix(around, textureLod(air_texture, at, 0.0).xyz, fluid_share(at));
}

// What is not finite, which may be the texture's, is no wind. By the bits, for comparisons with NaN may be compiled away.
vec3 sound(vec3 v)
{
    uvec3 bits = floatBitsToUint(v) & 0x7fffffffu;
    return all(lessThan(bits, uvec3(floatBitsToUint(1e4)))) ? v : vec3(0.0);
}

vec3 from_texture(vec3 place)
{
    vec3 at = (wind.to_volume * vec4(place, 1.0)).xyz;
    return all(equal(at, clamp(at, 0.0, 1.0))) ? sound(textureLod(volume_texture, at, 0.0).xyz) : vec3(0.0);
}

// m/s, at a position from the head's origin, which is a place from that at the end of the dispatch; `time` from there, s.
vec3 air_then(vec3 position, vec3 place, float time)
{
    vec3 u     = wind.velocity.xyz + gust_at(place, time), past = u;
    vec3 down  = direction_or(wind.velocity.xyz, vec3(0.0));
    for (uint k = 0u; k < wind.balls; ++k) past = around_ball(past, (position - wind.ball[k].xyz) / wind.ball[k].w, down);
    u = wind.box.w > 0.0 ? in_fluid(place, u) : mix(u, past, wind.shelter);
    for (uint k = 0u; k < wind.sources; ++k) u += from_source(k, place);
    return wind.volume != 0u ? u + from_texture(place) : u;
}

// At the start of a substep of the dispatch.
vec3 air_at(vec3 position, uint substep)
{
    vec4 at = wind.at[substep];
    return air_then(position, position + at.xyz, at.w);
}

#endif
