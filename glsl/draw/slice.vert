// slice.vert - a slice of the distance field's box, as a strip of four vertices.
#version 450 core
#include "draw/debug_params.glsl"

// Position from the head's origin, along the world's axes.
layout(location = 0) out vec3 slice_position;

void main()
{
    vec3 p = params.corner.xyz + float(gl_VertexID & 1) * params.side[0].xyz +
             float(gl_VertexID >> 1) * params.side[1].xyz;
    slice_position = rotate(params.rotation, p);
    gl_Position    = to_clip(p);
}
