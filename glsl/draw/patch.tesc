// patch.tesc - the isolines of a patch. One patch of followers, one part of at most HAIR_MAX_ISOLINE_SEGMENTS of their
// segments.
#version 450 core
#include "patch.glsl"
layout(vertices = 1) out;

layout(location = 0) flat in uvec2 vertex_patch[];

layout(location = 0) patch out uvec4 lines;  // first follower, isolines, first segment, segments
layout(location = 1) patch out vec2 whole;  // segments of a whole strand; share of its width that the last one has

void main()
{
    hair_patch_lines all = find_lines(vertex_patch[0].x);

    uint first    = vertex_patch[0].y * HAIR_MAX_ISOLINE_SEGMENTS;
    uint segments = min(all.segments - min(first, all.segments), uint(HAIR_MAX_ISOLINE_SEGMENTS));
    lines         = uvec4(all.first, all.strands, first, segments);
    whole         = vec2(all.segments, all.fading);

    // A level of 0 discards the patch. Levels that isolines do not use are written too: drivers differ.
    bool none = all.strands == 0u || segments == 0u;
    gl_TessLevelOuter[HAIR_LINES_LEVEL]     = none ? 0.0 : float(all.strands);
    gl_TessLevelOuter[1 - HAIR_LINES_LEVEL] = none ? 0.0 : float(segments);
    gl_TessLevelOuter[2] = 1.0;
    gl_TessLevelOuter[3] = 1.0;
    gl_TessLevelInner[0] = 1.0;
    gl_TessLevelInner[1] = 1.0;
}
