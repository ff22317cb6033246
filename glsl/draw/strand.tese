// strand.tese - one vertex of a follower, found from its isoline and segment.
#version 450 core
#include "draw/strand.glsl"
#include "draw/strand_out.glsl"
layout(isolines, equal_spacing) in;

layout(location = 0) patch in uvec4 lines;
layout(location = 1) patch in vec4  whole;

void main()
{
    // Coordinates are rounded, on some drivers to 16 bits. The exact line and segment are recovered
    // from them.
    uint line    = uint(gl_TessCoord.y * float(lines.y) + 0.5);
    uint segment = lines.z + uint(gl_TessCoord.x * float(lines.w) + 0.5);

    float fading = line + 1u == lines.y ? whole.z : 1.0;
    uint  number = lines.x + line;
    pass_on(strand_at(number, number, place_of(segment, whole.x), whole.y * fading, whole.w));
}
