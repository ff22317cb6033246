// ribbon.geom - a segment as a ribbon of true width that faces the eye.
#version 450 core
#include "draw_params.glsl"
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 strand_position[];
layout(location = 1) in vec3 strand_tangent[];
layout(location = 2) in vec3 strand_color[];

layout(location = 2) out vec3 ribbon_color;

void main()
{
    for (int end = 0; end < 2; ++end) {
        vec3  center = strand_position[end].xyz;
        vec3  to_eye = draw.eye.w > 0.0 ? draw.eye.xyz - center : draw.eye.xyz;
        vec3  side   = cross(strand_tangent[end], to_eye);
        float l      = length(side);
        side         = l > 1e-12 ? side * (strand_position[end].w / l) : vec3(0.0); // Seen end on: no width.
        for (int k = -1; k <= 1; k += 2) {
            ribbon_color = strand_color[end];
            gl_Position  = draw.view_to_clip * (draw.view * vec4(center + float(k) * side, 1.0));
            EmitVertex();
        }
    }
    EndPrimitive();
}
