// strand.tese - one vertex of a follower: which isoline, which segment, where, how much light reaches it.
#version 450 core
#include "follower.glsl"
#include "shadow.glsl"
layout(isolines, equal_spacing) in;

layout(location = 0) patch in uvec4 lines;
layout(location = 1) patch in float fading;

layout(location = 0) out vec4 strand_position; // xyz from the head's origin; w: radius
layout(location = 1) out vec4 strand_tangent;  // xyz; w: light that reaches here, [0, 1]
layout(location = 2) out vec3 strand_place;    // from root to tip, [0, 1]; across, -1 to 1; the strand's own random number

void main()
{
    // Coordinates are rounded, on some drivers to 16 bits: the exact line and segment are recovered from them.
    uint  line    = uint(gl_TessCoord.y * float(lines.y) + 0.5);
    uint  segment = lines.z + uint(gl_TessCoord.x * float(lines.w) + 0.5);
    float t       = float(segment) / float(draw.segments);

    hair_follower follower = fetch_follower(lines.x + line);
    hair_point    point    = evaluate(follower, t);
    if (line + 1u == lines.y) point.radius *= fading;

    strand_position = vec4(point.position, point.radius);
    strand_tangent  = vec4(point.tangent, light_through(point.position, follower.seed));
    strand_place    = vec3(t, 0.0, random(follower.seed + 7u));
    gl_Position     = draw.view_to_clip * (draw.view * vec4(point.position, 1.0));
}
