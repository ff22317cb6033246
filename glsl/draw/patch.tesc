// patch.tesc - how many isolines a patch draws, and how many segments each. One patch of followers, one part of
// at most HAIR_MAX_ISOLINE_SEGMENTS of their segments.
//
// The number of lines falls continuously: the last one thins out before it goes.
#version 450 core
#include "draw_params.glsl"
layout(vertices = 1) out;

layout(binding = HAIR_UNIT_PATCH) uniform usamplerBuffer patch_texture;

layout(location = 0) flat in uvec2 vertex_patch[];

layout(location = 0) patch out uvec4 lines;  // first follower, isolines, first segment, segments
layout(location = 1) patch out float fading; // share of its width that the last isoline has

void main()
{
    uvec4 record   = texelFetch(patch_texture, int(vertex_patch[0].x)); // hair_patch
    float wanted   = float(record.y) * clamp(uintBitsToFloat(record.z), 0.0, 1.0) * draw.density;
#ifdef HAIR_EVERY_FOLLOWER
    wanted = float(record.y);
#endif
    uint  isolines = min(uint(ceil(wanted)), uint(HAIR_MAX_ISOLINES));
    uint  first    = vertex_patch[0].y * HAIR_MAX_ISOLINE_SEGMENTS;
    uint  segments = min(draw.segments - min(first, draw.segments), uint(HAIR_MAX_ISOLINE_SEGMENTS));

    lines  = uvec4(record.x, isolines, first, segments);
    fading = 1.0 - (float(isolines) - wanted);

    // A level of 0 discards the patch. Levels that isolines do not use are written too: drivers differ.
    bool none = isolines == 0u || segments == 0u;
    gl_TessLevelOuter[HAIR_LINES_LEVEL]     = none ? 0.0 : float(isolines);
    gl_TessLevelOuter[1 - HAIR_LINES_LEVEL] = none ? 0.0 : float(segments);
    gl_TessLevelOuter[2] = 1.0;
    gl_TessLevelOuter[3] = 1.0;
    gl_TessLevelInner[0] = 1.0;
    gl_TessLevelInner[1] = 1.0;
}
