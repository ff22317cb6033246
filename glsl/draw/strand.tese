// strand.tese - one vertex of a follower: which isoline, and which segment.
#version 450 core
#include "strand.glsl"
layout(isolines, equal_spacing) in;

layout(location = 0) patch in uvec4 lines;
layout(location = 1) patch in vec3  whole;

layout(location = 0) out vec4 strand_position; // xyz from the head's origin; w: radius
layout(location = 1) out vec3 strand_tangent;
layout(location = 2) out vec3 strand_color;

void main()
{
    // Coordinates are rounded, on some drivers to 16 bits: the exact line and segment are recovered from them.
    uint line    = uint(gl_TessCoord.y * float(lines.y) + 0.5);
    uint segment = lines.z + uint(gl_TessCoord.x * float(lines.w) + 0.5);

    float         fading = line + 1u == lines.y ? whole.z : 1.0;
    strand_vertex v      = strand_at(lines.x + line, place_of(segment, whole.x), whole.y * fading);
    strand_position = v.position;
    strand_tangent  = v.tangent;
    strand_color    = v.color;
    gl_Position     = draw.view_to_clip * (draw.view * vec4(v.position.xyz, 1.0));
}
