// strand_out.glsl - outputs of a vertex of a strand.
#include "draw/varyings.glsl"

layout(location = 0) out vec4 strand_position; // xyz: from the head's origin, m. w: radius, m.
layout(location = 1) out vec3 strand_tangent;
layout(location = 2) out vec3 strand_color;
#ifdef HAIR_NUMBERED
layout(location = 3) flat out uvec3 strand_numbers;
layout(location = 4) out vec4 strand_place;
#endif
#ifdef HAIR_MOTION
layout(location = 5) out vec3 clip_now;
layout(location = 6) out vec3 clip_before;
#endif

void pass_on(strand_vertex v)
{
    strand_position = v.position;
    strand_tangent  = v.tangent;
    strand_color    = v.color;
#ifdef HAIR_NUMBERED
    strand_numbers = v.numbers;
    strand_place   = vec4(v.place, 0.0);
#endif
#ifdef HAIR_MOTION
    clip_now    = (draw.now_to_clip * vec4(v.position.xyz, 1.0)).xyw;
    clip_before = (draw.before_to_clip * vec4(v.before, 1.0)).xyw;
#endif
    gl_Position = draw.view_to_clip * (draw.view * vec4(v.position.xyz, 1.0));
}
