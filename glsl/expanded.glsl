// expanded.glsl - where a follower is drawn, as expand.comp has left its vertices: in place of evaluate.glsl. Between two of
// them by the cubic that has their tangents.
#include "follower.glsl"

layout(binding = HAIR_UNIT_EXPANDED) uniform samplerBuffer expanded_texture;
layout(binding = HAIR_UNIT_EXPANDED_TANGENT) uniform samplerBuffer expanded_tangent_texture;

hair_point fetch_expanded(int at)
{
    vec4 vertex = texelFetch(expanded_texture, at);
    return hair_point(vertex.xyz, texelFetch(expanded_tangent_texture, at).xyz * 2.0 - 1.0, vertex.w);
}

hair_point evaluate(hair_follower follower, uint number, float t)
{
    float      along = t * float(draw.segments);
    int        k     = min(int(along + 1e-3), int(draw.segments)), at = int(number * (draw.segments + 1u)) + k;
    float      w     = along - float(k);
    hair_point a     = fetch_expanded(at);
    if (w < 1e-3) return a;
    hair_point b      = fetch_expanded(at + 1);
    vec3       chord  = b.position - a.position;
    vec3       before = length(chord) * a.tangent - chord, after = length(chord) * b.tangent - chord;
    return hair_point(a.position + w * chord + w * (1.0 - w) * ((1.0 - w) * before - w * after),
                      direction_or(mix(a.tangent, b.tangent, w), a.tangent), mix(a.radius, b.radius, w));
}
