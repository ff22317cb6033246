// vulkan_scene.vert - Two triangles. The first cuts through the hair, and the second stands beside it.
#version 450 core
layout(push_constant) uniform parameters { mat4 clip; };
layout(location = 0) out vec3 color;

const vec3 corners[6] = vec3[](vec3(-0.22, 1.38, 0.08), vec3(0.20, 1.38, 0.08), vec3(0.0, 1.78, -0.04),
                               vec3(0.0, 1.66, 0.02), vec3(0.26, 1.54, -0.04), vec3(0.26, 1.70, -0.04));

void main()
{
    color = gl_VertexIndex < 3 ? vec3(0.8, 0.35, 0.05) : vec3(0.05, 0.3, 0.8);
    gl_Position = clip * vec4(corners[gl_VertexIndex], 1.0);
}
