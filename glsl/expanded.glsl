// expanded.glsl - where a follower is drawn, as expand.comp has left its vertices: in place of evaluate.glsl, at those t.
#include "follower.glsl"

layout(binding = HAIR_UNIT_EXPANDED) uniform samplerBuffer expanded_texture;
layout(binding = HAIR_UNIT_EXPANDED_TANGENT) uniform samplerBuffer expanded_tangent_texture;

hair_point evaluate(hair_follower follower, uint number, float t)
{
    int  at     = int(number * (draw.segments + 1u) + uint(t * float(draw.segments) + 0.5));
    vec4 vertex = texelFetch(expanded_texture, at);
    return hair_point(vertex.xyz, texelFetch(expanded_tangent_texture, at).xyz * 2.0 - 1.0, vertex.w);
}
