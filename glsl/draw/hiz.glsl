// hiz.glsl - Hi-Z of the application's depth (Greene, Kass and Miller 1993): the farthest depth of
// every texel. The levels follow each other in one buffer. Depth is signed, so that a greater value
// is farther away.
#ifndef HAIR_HIZ_GLSL
#define HAIR_HIZ_GLSL

#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std140, binding = HAIR_BIND_OCCLUSION) uniform occlusion_buffer { hair_occlusion_params hide; };
layout(std430, binding = HAIR_BIND_HIZ) restrict buffer hiz_buffer { float farthest[]; };

struct hiz_level {
    ivec2 size;
    int   first; // First texel in the buffer.
};

hiz_level next_level(hiz_level level)
{
    return hiz_level((level.size + HAIR_HIZ_NEXT - 1) / HAIR_HIZ_NEXT,
                     level.first + level.size.x * level.size.y);
}

hiz_level first_level() { return hiz_level(ivec2(hide.columns, hide.rows), 0); }

#define NOWHERE 1e30 // Farther than any depth.

#endif
