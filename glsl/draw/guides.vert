// guides.vert - the simulated strands as lines, coloured by stretch: blue at -2 %, grey at 0, red
// at +2 %. One instance per guide, one vertex per sample.
#version 450 core
#include "draw_params.glsl"
#include "strands/packed_frame.glsl"

layout(binding = HAIR_UNIT_POSITION) uniform samplerBuffer position_texture;
layout(binding = HAIR_UNIT_FRAME) uniform usamplerBuffer frame_texture;

layout(location = 0) out vec3 line_color;

void main()
{
    int   at      = gl_InstanceID * int(draw.smooth_vertices) + gl_VertexID;
    float stretch = clamp(unpack_stretch(texelFetch(frame_texture, at).xy) / 0.02, -1.0, 1.0);
    line_color    = mix(vec3(0.5), stretch > 0.0 ? vec3(1.0, 0.1, 0.05) : vec3(0.05, 0.2, 1.0), abs(stretch));
    gl_Position   = draw.view_to_clip * (draw.view * vec4(texelFetch(position_texture, at).xyz, 1.0));
}
