// hide_next.comp - a Hi-Z level from the level before it. One thread per texel of the level.
#version 450 core
#include "hide.glsl"

void main()
{
    int        i      = int(hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x);
    hide_level before = first_level();
    for (uint k = 1u; k < hide.level; ++k) before = next_level(before);
    hide_level own = next_level(before);
    if (i >= own.size.x * own.size.y) return;
    ivec2 from = ivec2(i % own.size.x, i / own.size.x) * HAIR_HIDE_NEXT, to = min(from + HAIR_HIDE_NEXT, before.size);
    float far  = -NOWHERE;
    for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x) far = max(far, farthest[before.first + y * before.size.x + x]);
    farthest[own.first + i] = far;
}
