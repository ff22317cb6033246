// vertex_cache.glsl - the position of a follower, read from the vertex cache that expand.comp
// writes. It replaces strands/evaluate.glsl.
#include "strands/follower.glsl"
#include "strands/packed.glsl"

#ifdef HAIR_STORED
#ifndef HAIR_POSITION_SLOT
#define HAIR_POSITION_SLOT HAIR_BIND_CACHED_POSITION
#endif
layout(std430, binding = HAIR_POSITION_SLOT) readonly restrict buffer cached_position_buffer
{
    vec4 cached_position[];
};
layout(std430, binding = HAIR_BIND_CACHED_TANGENT) readonly restrict buffer cached_tangent_buffer
{
    uvec2 cached_tangent[];
};

vec4 position_of(int at) { return cached_position[at]; }
vec3 tangent_of(int at) { return unpack_tangent(cached_tangent[at]); }
#else
layout(binding = HAIR_UNIT_CACHED_POSITION) uniform samplerBuffer cached_position_texture;
layout(binding = HAIR_UNIT_CACHED_TANGENT) uniform samplerBuffer cached_tangent_texture;

vec4 position_of(int at) { return texelFetch(cached_position_texture, at); }
vec3 tangent_of(int at) { return texelFetch(cached_tangent_texture, at).xyz * 2.0 - 1.0; }
#endif

// Return the fraction by which t lies beyond a cached vertex. `at` is the index of the vertex. Near
// a vertex the fraction is exactly 0 or 1.
float place_between(uint number, float t, out int at)
{
    float along = t * float(draw.segments), k = min(floor(along + 1e-3), float(draw.segments) - 1.0);
    at          = int(number * (draw.segments + 1u)) + int(k);
    float fraction = along - k;
    return fraction < 1e-3 ? 0.0 : fraction > 1.0 - 1e-3 ? 1.0 : fraction;
}

#if defined(HAIR_MOTION) || defined(HAIR_ALPHA_COVERAGE)
// Interpolate between cached vertices, because levels of detail leave out segments too.
hair_point evaluate(hair_follower follower, uint number, float t)
{
    int   at;
    float fraction = place_between(number, t, at);
    vec4  vertex   = mix(position_of(at), position_of(at + 1), fraction);
    vec3  a = tangent_of(at), b = tangent_of(at + 1);
    return hair_point(vertex.xyz, direction_or(mix(a, b, fraction), a), vertex.w);
}
#else
hair_point evaluate(hair_follower follower, uint number, float t)
{
    int  at     = int(number * (draw.segments + 1u) + uint(t * float(draw.segments) + 0.5));
    vec4 vertex = position_of(at);
    return hair_point(vertex.xyz, tangent_of(at), vertex.w);
}
#endif

#ifdef HAIR_MOTION
layout(binding = HAIR_UNIT_BEFORE) uniform samplerBuffer before_texture;

// Return the position of the strand in the previous frame that was drawn.
vec3 before_at(uint number, float t)
{
    int   at;
    float fraction = place_between(number, t, at);
    return mix(texelFetch(before_texture, at).xyz, texelFetch(before_texture, at + 1).xyz, fraction);
}
#endif
