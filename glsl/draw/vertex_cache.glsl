// vertex_cache.glsl - the position of a follower, read from the vertex cache that expand.comp
// writes. It replaces strands/evaluate.glsl.
#include "strands/follower.glsl"

layout(binding = HAIR_UNIT_CACHED_POSITION) uniform samplerBuffer cached_position_texture;
layout(binding = HAIR_UNIT_CACHED_TANGENT) uniform samplerBuffer cached_tangent_texture;

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
    float fraction  = place_between(number, t, at);
    vec4 vertex =
        mix(texelFetch(cached_position_texture, at), texelFetch(cached_position_texture, at + 1), fraction);
    vec3  a      = texelFetch(cached_tangent_texture, at).xyz * 2.0 - 1.0;
    vec3  b      = texelFetch(cached_tangent_texture, at + 1).xyz * 2.0 - 1.0;
    return hair_point(vertex.xyz, direction_or(mix(a, b, fraction), a), vertex.w);
}
#else
hair_point evaluate(hair_follower follower, uint number, float t)
{
    int  at     = int(number * (draw.segments + 1u) + uint(t * float(draw.segments) + 0.5));
    vec4 vertex = texelFetch(cached_position_texture, at);
    return hair_point(vertex.xyz, texelFetch(cached_tangent_texture, at).xyz * 2.0 - 1.0, vertex.w);
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
