// patch.glsl - how many strands of a patch are drawn, and with how many segments: what every path of drawing asks.
//
// The number of strands falls continuously: the last one thins out before it goes.
#include "draw_params.glsl"

layout(binding = HAIR_UNIT_PATCH) uniform usamplerBuffer patch_texture;

struct hair_patch_lines {
    uint  first;    // follower
    uint  strands;
    uint  segments; // of a whole strand
    float fading;   // share of its width that the last strand has
    float thickness; // of all of them, as a share of their own
};

hair_patch_lines find_lines(uint number)
{
    int   at     = int(number) * HAIR_PATCH_TEXELS;
    uvec4 record = texelFetch(patch_texture, at); // hair_patch
    float mapped = dot(uintBitsToFloat(texelFetch(patch_texture, at + 1)), draw.map_weights);
    float wanted = float(record.y) * clamp(uintBitsToFloat(record.z) * mapped, 0.0, 1.0) * draw.density;
#ifdef HAIR_EVERY_FOLLOWER
    wanted = float(record.y);
#endif
    float thickness = dot(uintBitsToFloat(texelFetch(patch_texture, at + 2)), draw.map_weights);
    uint  strands   = uint(ceil(wanted));
    return hair_patch_lines(record.x, strands, draw.segments, 1.0 - (float(strands) - wanted), thickness);
}
