// vulkan_beads.vert - A bead on the tip of a strand, a triangle that faces the eye.
#version 450 core
layout(push_constant) uniform parameters { mat4 clip; };
layout(location = 0) in vec3 tip;
layout(location = 0) out vec3 color;

const vec2 corners[3] = vec2[](vec2(0.0, 1.0), vec2(-0.87, -0.5), vec2(0.87, -0.5));

void main()
{
    const vec2 radius = vec2(0.009, 0.012);
    color = vec3(0.0, 0.7, 0.25);
    gl_Position = clip * vec4(tip, 1.0) + vec4(radius * corners[gl_VertexIndex], 0.0, 0.0);
}
