// ribbon.geom - a segment as a ribbon of true width that faces the eye.
#version 450 core
#include "draw_params.glsl"
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 strand_position[];
layout(location = 1) in vec4 strand_tangent[];
layout(location = 2) in vec3 strand_place[];

layout(location = 0) out vec4 ribbon_position;
layout(location = 1) out vec4 ribbon_tangent;
layout(location = 2) out vec3 ribbon_place;

void main()
{
    for (int end = 0; end < 2; ++end) {
        vec3  center = strand_position[end].xyz;
        vec3  to_eye = draw.eye.w > 0.0 ? draw.eye.xyz - center : draw.eye.xyz;
        vec3  side   = cross(strand_tangent[end].xyz, to_eye);
        float l      = length(side);
        side         = l > 1e-12 ? side * (strand_position[end].w / l) : vec3(0.0); // Seen end on: no width.
        for (int k = -1; k <= 1; k += 2) {
            ribbon_position = vec4(center + float(k) * side, strand_position[end].w);
            ribbon_tangent  = strand_tangent[end];
            ribbon_place    = vec3(strand_place[end].x, float(k), strand_place[end].z);
            gl_Position     = draw.view_to_clip * (draw.view * vec4(ribbon_position.xyz, 1.0));
            EmitVertex();
        }
    }
    EndPrimitive();
}
