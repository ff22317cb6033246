// strand.frag - the colour of a strand where a pixel sees it.
#version 450 core

layout(location = 2) in vec3 strand_color;

layout(location = 0) out vec4 color;

void main() { color = vec4(strand_color, 1.0); }
