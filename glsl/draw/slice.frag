// slice.frag - the distance field as colour: blue outside, red inside, white at the surface, and a
// line for every voxel of distance. Pixels far from all colliders are discarded.
#version 450 core
#include "field.glsl"

layout(location = 0) in vec3 slice_position;
layout(location = 0) out vec4 color;

void main()
{
    float distance = field_distance(slice_position), voxels = distance / field.lower.w;
    if (distance > 0.999 * field.inverse.w) discard;
    float width = max(length(vec2(dFdx(voxels), dFdy(voxels))), 1e-4);
    float line  = abs(fract(voxels - 0.5) - 0.5) / width;
    float depth = clamp(abs(voxels) / 8.0, 0.0, 1.0);
    vec3  tone  = voxels > 0.0 ? mix(vec3(0.25, 0.55, 1.0), vec3(0.02, 0.06, 0.2), depth)
                               : mix(vec3(1.0, 0.45, 0.25), vec3(0.2, 0.02, 0.02), depth);
    float shade = abs(voxels) < 0.5 ? 1.0 : 0.7;
    color = vec4(mix(abs(voxels) < 0.5 ? vec3(1.0) : shade * tone, tone, clamp(line - 0.5, 0.0, 1.0)), 1.0);
}
