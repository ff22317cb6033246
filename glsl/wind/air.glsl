// air.glsl - the wind at any position. It is the sum of three parts. The first is the ambient wind
// with its gusts, diverted by obstacles, or the fluid in its box. The second is the local wind
// sources. The third is the application's texture.
#ifndef HAIR_AIR_GLSL
#define HAIR_AIR_GLSL

#include "shared.h"
#include "rotation.glsl"
#include "wind/gust.glsl"

layout(std140, binding = HAIR_BIND_WIND) uniform wind_buffer { hair_wind_params wind; };
layout(binding = HAIR_UNIT_AIR) uniform sampler3D air_texture;
layout(binding = HAIR_UNIT_VOLUME) uniform sampler3D volume_texture;

// Return the gust at a position and time. By Taylor's frozen turbulence, the pattern moves with the
// wind.
vec3 gust_at(vec3 place, float time)
{
    return gust_of(wind.gust_turn, wind.gust_from, wind.velocity.w, place - wind.velocity.xyz * time);
}

// Return the wind around a sphere. p is the position relative to its centre, in radii, and x the
// distance downwind. Outside the wake it is potential flow, which cannot enter the sphere. The wake
// behind it has a Gaussian profile, a drag coefficient of 0.5 and the momentum deficit of that drag
// (Bastankhah and Porte-Agel 2014). Still air directly behind the sphere changes into the wake
// within about four radii.
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

// Return the velocity of a local wind source. A source without a direction blows the same volume
// through every sphere. A directed source is a round turbulent jet that keeps its momentum. Its
// half-width at half speed grows by 0.094 of the distance (Pope 2000, "Turbulent Flows").
vec3 from_source(uint k, vec3 place)
{
    vec3  p = place - wind.source[k].xyz, way = wind.jet[k].xyz;
    float radius = wind.source[k].w, speed = wind.jet[k].w, r = length(p);
    if (dot(way, way) == 0.0) return speed * p / radius * min(1.0, pow(radius / max(r, radius), 3.0));
    float x = dot(p, way), half_width = radius + 0.094 * max(x, 0.0);
    float fraction = max(dot(p, p) - x * x, 0.0) / (half_width * half_width);
    return speed * radius / half_width * exp2(-fraction) * smoothstep(-radius, 0.0, x) * way;
}

// Return the weight of the fluid at a position in its box, given in fractions of its sides. The
// weight falls to 0 over the last eighth on all sides.
float fluid_fraction(vec3 place)
{
    vec3 inside = clamp(8.0 * (0.5 - abs(place - 0.5)), 0.0, 1.0);
    return inside.x * inside.y * inside.z;
}

// Return the fluid's velocity, blended at the border with the wind `around`. Gusts enter the fluid
// with the air that flows in.
vec3 in_fluid(vec3 place, vec3 around)
{
    vec3 at = (place - wind.box.xyz) * wind.box.w;
    return mix(around, textureLod(air_texture, at, 0.0).xyz, fluid_fraction(at));
}

// Return a velocity, or 0 if it is not finite, as the application's texture may be. The test uses
// bits, because comparisons with NaN may be compiled away.
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

// Return the wind, m/s, at a position from the head's origin. `place` is the same position relative
// to the head's origin at the end of the dispatch. `time` is relative to that end, s.
vec3 air_then(vec3 position, vec3 place, float time)
{
    vec3 u     = wind.velocity.xyz + gust_at(place, time), past = u;
    vec3 down  = direction_or(wind.velocity.xyz, vec3(0.0));
    for (uint k = 0u; k < wind.balls; ++k)
        past = around_ball(past, (position - wind.ball[k].xyz) / wind.ball[k].w, down);
    u = wind.box.w > 0.0 ? in_fluid(place, u) : mix(u, past, wind.shelter);
    for (uint k = 0u; k < wind.sources; ++k) u += from_source(k, place);
    return wind.volume != 0u ? u + from_texture(place) : u;
}

// Return the wind at the start of a substep of the dispatch.
vec3 air_at(vec3 position, uint substep)
{
    vec4 at = wind.at[substep];
    return air_then(position, position + at.xyz, at.w);
}

#endif
