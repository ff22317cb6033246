// strand.frag - the colour of a strand where a pixel sees it.
#version 450 core

layout(location = 2) in vec3 strand_color;

layout(location = 0) out vec4 color;

// Where a segment covers a pixel but not its middle, its colours are extrapolated, and might become negative.
void main() { color = vec4(max(strand_color, 0.0), 1.0); }
