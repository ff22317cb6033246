// hiz_reduce_depth.comp - the first Hi-Z level, from the application's depth. One thread per texel
// of the level.
#version 450 core
#include "draw/hiz.glsl"

layout(binding = HAIR_UNIT_OCCLUSION) uniform sampler2D occluder_depth;

void main()
{
    int   i = int(hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x);
    ivec2 size = first_level().size;
    if (i >= size.x * size.y) return;
    ivec2 from = (ivec2(hide.first_x, hide.first_y) + ivec2(i % size.x, i / size.x)) * HAIR_HIZ_FIRST;
    ivec2 to   = min(from + HAIR_HIZ_FIRST, ivec2(hide.width, hide.height));
    float far  = -NOWHERE;
    for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x)
            far = max(far, hide.sign * texelFetch(occluder_depth, ivec2(x, y), 0).x);
    farthest[i] = far;
}
