// driver_quirks.tese - the number of the patch and the coordinate across its isolines, for
// transform feedback.
#version 450 core
layout(isolines, equal_spacing) in;

layout(location = 0) patch in float number;
out vec2 captured;

void main()
{
    captured    = vec2(number, gl_TessCoord.y);
    gl_Position = vec4(0.0);
}
