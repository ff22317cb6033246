// hide.glsl - Hi-Z of the application's depth (Greene, Kass and Miller 1993): the farthest depth of
// every texel. The levels follow each other in one buffer. Depth is signed, so that a greater value
// is farther away.
#ifndef HAIR_HIDE_GLSL
#define HAIR_HIDE_GLSL

#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std140, binding = HAIR_BIND_HIDE) uniform hide_buffer { hair_hide_params hide; };
layout(std430, binding = HAIR_BIND_HIDE_DEPTH) restrict buffer hide_depth_buffer { float farthest[]; };

struct hide_level {
    ivec2 size;
    int   first; // First texel in the buffer.
};

hide_level next_level(hide_level level)
{
    return hide_level((level.size + HAIR_HIDE_NEXT - 1) / HAIR_HIDE_NEXT, level.first + level.size.x * level.size.y);
}

hide_level first_level() { return hide_level(ivec2(hide.columns, hide.rows), 0); }

#define NOWHERE 1e30 // Farther than any depth.

#endif
