// view_cache.vert - one of the per-view vertices that expand_view.comp wrote. It is a side of a
// ribbon or the middle of a line.
#version 450 core
#include "draw_params.glsl"

#ifdef HAIR_LINES
#define SIDES 1
#else
#define SIDES 2
#endif
layout(binding = HAIR_UNIT_CACHED_POSITION) uniform samplerBuffer clip_texture;
#ifndef HAIR_DEPTH
layout(binding = HAIR_UNIT_SHADED) uniform samplerBuffer shaded_texture;
layout(location = 2) out vec3 strand_color;
#endif

void main()
{
    int at      = gl_InstanceID * int(HAIR_INSTANCE_STRANDS * (draw.segments + 1u)) * SIDES + gl_VertexID;
    gl_Position = texelFetch(clip_texture, at);
#ifndef HAIR_DEPTH
    strand_color = texelFetch(shaded_texture, at / SIDES).rgb;
#endif
}
