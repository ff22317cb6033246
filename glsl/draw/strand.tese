// strand.tese - one vertex of a follower: which isoline, which segment, where, and its colour. Shading runs here and
// not for every sample of a pixel: along a strand light changes slowly, across it not at all.
#version 450 core
#include "evaluate.glsl"
#include "shadow.glsl"
#include "shade.glsl"
layout(isolines, equal_spacing) in;

layout(location = 0) patch in uvec4 lines;
layout(location = 1) patch in float fading;

layout(location = 0) out vec4 strand_position; // xyz from the head's origin; w: radius
layout(location = 1) out vec3 strand_tangent;
layout(location = 2) out vec3 strand_color;

vec3 shade(hair_follower follower, hair_point point, float t)
{
    hair_fragment f;
    f.tangent = point.tangent;
    f.to_eye  = normalize(draw.eye.w > 0.0 ? draw.eye.xyz - point.position : draw.eye.xyz);
    f.t       = t;
    f.random  = random(follower.seed + 7u);
    f.light   = light_through(point.position, follower.seed);
    return hair_shade(f);
}

void main()
{
    // Coordinates are rounded, on some drivers to 16 bits: the exact line and segment are recovered from them.
    uint  line    = uint(gl_TessCoord.y * float(lines.y) + 0.5);
    uint  segment = lines.z + uint(gl_TessCoord.x * float(lines.w) + 0.5);
    float t       = float(segment) / float(draw.segments);

    hair_follower follower = fetch_follower(lines.x + line);
    hair_point    point    = evaluate(follower, lines.x + line, t);
    if (line + 1u == lines.y) point.radius *= fading;

    strand_position = vec4(point.position, point.radius);
    strand_tangent  = point.tangent;
    strand_color    = draw.colored != 0u ? shade(follower, point, t) : vec3(0.0);
    gl_Position     = draw.view_to_clip * (draw.view * vec4(point.position, 1.0));
}
