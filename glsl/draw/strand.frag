// strand.frag - the colour of a strand where a pixel sees it.
#version 450 core
#include "shade.glsl"

layout(location = 0) in vec4 strand_position;
layout(location = 1) in vec4 strand_tangent;
layout(location = 2) in vec3 strand_place;

layout(location = 0) out vec4 color;

void main()
{
    hair_fragment f;
    f.tangent = normalize(strand_tangent.xyz);
    f.to_eye  = normalize(draw.eye.w > 0.0 ? draw.eye.xyz - strand_position.xyz : draw.eye.xyz);
    f.t       = strand_place.x;
    f.across  = strand_place.y;
    f.random  = strand_place.z;
    f.light   = strand_tangent.w;
    color     = vec4(hair_shade(f), 1.0);
}
