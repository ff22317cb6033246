// hiz_downsample.comp - a Hi-Z level from the level before it. One thread per texel of the level.
#version 450 core
#include "draw/hiz.glsl"

void main()
{
    int        i      = int(hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x);
    hiz_level before = first_level();
    for (uint k = 1u; k < hide.level; ++k) before = next_level(before);
    hiz_level own = next_level(before);
    if (i >= own.size.x * own.size.y) return;
    ivec2 from = ivec2(i % own.size.x, i / own.size.x) * HAIR_HIZ_NEXT,
          to = min(from + HAIR_HIZ_NEXT, before.size);
    float far  = -NOWHERE;
    for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x) far = max(far, farthest[before.first + y * before.size.x + x]);
    farthest[own.first + i] = far;
}
