// selftest.tese - number of the patch and place across its isolines, to be captured.
#version 450 core
layout(isolines, equal_spacing) in;

layout(location = 0) patch in float number;
out vec2 captured;

void main()
{
    captured    = vec2(number, gl_TessCoord.y);
    gl_Position = vec4(0.0);
}
