// fetch.glsl - reads of smoothed guides and followers, from storage buffers in compute shaders and
// from textures in other stages.
#include "shared.h"
#include "strands/guide_positions.glsl"
#include "strands/packed_frame.glsl"

// It has the shapes of followers too, see hair_follower.
layout(binding = HAIR_UNIT_FOLLOWER) uniform usamplerBuffer follower_texture;

#ifdef HAIR_STORED
layout(std430, binding = HAIR_BIND_STORED_FRAME) readonly restrict buffer frame_buffer
{
    uvec2 stored_frame[];
};
layout(std430, binding = HAIR_BIND_STORED_FOLLOWER) readonly restrict buffer follower_buffer {
    hair_follower stored_follower[];
};

vec4          fetch_turn(int at) { return unpack_frame(stored_frame[at]); }
hair_follower fetch_whole(uint number) { return stored_follower[number]; }
#else
layout(binding = HAIR_UNIT_FRAME) uniform usamplerBuffer frame_texture;

vec4 fetch_turn(int at) { return unpack_frame(texelFetch(frame_texture, at).xy); }

hair_follower fetch_whole(uint number)
{
    int           at = int(number) * HAIR_FOLLOWER_TEXELS;
    hair_follower follower;
    uvec4         ids   = texelFetch(follower_texture, at);
    vec4          reals = uintBitsToFloat(texelFetch(follower_texture, at + 1));
    follower.guide0 = ids.x, follower.guide1 = ids.y, follower.guide2 = ids.z, follower.seed = ids.w;
    follower.weight1 = reals.x, follower.weight2 = reals.y, follower.length_ratio = reals.z,
    follower.multi = reals.w;
    for (int i = 0; i < 4; ++i)
        follower.offset[i] = uintBitsToFloat(texelFetch(follower_texture, at + 2 + i));
    return follower;
}
#endif
