// driver_quirks.tesc - 64 isolines of 32 segments from every patch.
#version 450 core
layout(vertices = 1) out;

layout(location = 0) flat in uvec2 vertex_patch[];
layout(location = 0) patch out float number;

void main()
{
    number                = float(vertex_patch[0].x);
    gl_TessLevelOuter[0] = 64.0;
    gl_TessLevelOuter[1] = 32.0;
    gl_TessLevelOuter[2] = 1.0;
    gl_TessLevelOuter[3] = 1.0;
    gl_TessLevelInner[0] = 1.0;
    gl_TessLevelInner[1] = 1.0;
}
