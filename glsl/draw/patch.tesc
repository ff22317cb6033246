// patch.tesc - the isolines of one part of a patch of followers. A part has at most
// HAIR_MAX_ISOLINES followers and HAIR_MAX_ISOLINE_SEGMENTS of their segments.
#version 450 core
#include "strands/patch.glsl"
layout(vertices = 1) out;

layout(location = 0) flat in uvec2 vertex_patch[];

layout(location = 0) patch out uvec4 lines; // First follower, isolines, first segment, segments.
// x: segments of a whole strand. y: factor of the width of all strands. z: further factor for the
// last strand. w: factor in y that compensates for strands that are left out.
layout(location = 1) patch out vec4 whole;

void main()
{
    hair_patch_lines all = find_lines(vertex_patch[0].x);

    // Per strand.
    uint parts    = (draw.segments + HAIR_MAX_ISOLINE_SEGMENTS - 1u) / HAIR_MAX_ISOLINE_SEGMENTS;
    uint before   = vertex_patch[0].y / parts * HAIR_MAX_ISOLINES;
    uint left     = all.strands - min(before, all.strands);
    uint strands  = min(left, uint(HAIR_MAX_ISOLINES));
    uint first    = vertex_patch[0].y % parts * HAIR_MAX_ISOLINE_SEGMENTS;
    uint segments = min(all.segments - min(first, all.segments), uint(HAIR_MAX_ISOLINE_SEGMENTS));
    lines         = uvec4(all.first + before, strands, first, segments);
    whole         = vec4(all.whole, all.drawn, left == strands ? all.fading : 1.0, all.widened);

    // A level of 0 discards the patch. Levels that isolines do not use are written too, because
    // drivers differ.
    bool none = strands == 0u || segments == 0u;
    gl_TessLevelOuter[HAIR_LINES_LEVEL]     = none ? 0.0 : float(strands);
    gl_TessLevelOuter[1 - HAIR_LINES_LEVEL] = none ? 0.0 : float(segments);
    gl_TessLevelOuter[2] = 1.0;
    gl_TessLevelOuter[3] = 1.0;
    gl_TessLevelInner[0] = 1.0;
    gl_TessLevelInner[1] = 1.0;
}
