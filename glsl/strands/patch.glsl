// patch.glsl - the number of strands of a patch that are drawn, their width and their number of
// segments. Every drawing path calls it. With HAIR_EVERY_FOLLOWER all followers count as drawn.
//
// All of these change continuously. The last strand thins out before it disappears. Segments begin
// at equal distances from the root, and the last segment shrinks.
#ifndef HAIR_PATCH_GLSL
#define HAIR_PATCH_GLSL

#include "strands/lod.glsl"

layout(binding = HAIR_UNIT_PATCH) uniform usamplerBuffer patch_texture;

struct hair_patch_lines {
    uint  first;     // First follower.
    uint  strands;
    uint  segments;  // Segments of a whole strand.
    float whole;     // Segments, with the last one as a fraction.
    float fading;    // Fraction of its width that the last strand has.
    float thickness; // Factor of the width of all strands that have all segments.
    float drawn; // Factor of the width with the segments that are drawn.
    float widened;   // Factor within `thickness` that compensates for strands that are left out.
};

hair_patch_lines find_lines(uint number)
{
    int   at     = int(number) * HAIR_PATCH_TEXELS;
    uvec4 record = texelFetch(patch_texture, at); // hair_patch
#ifdef HAIR_EVERY_FOLLOWER
    return hair_patch_lines(record.x, record.y, draw.segments, float(draw.segments), 1.0, 1.0, 1.0, 1.0);
#else
#ifdef HAIR_OCCLUSION
    if (texelFetch(patch_texture, at + 3).w != 0u)
        return hair_patch_lines(record.x, 0u, 1u, 1.0, 1.0, 1.0, 1.0, 1.0);
#endif
    float mapped    = dot(uintBitsToFloat(texelFetch(patch_texture, at + 1)), draw.map_weights);
    float thickness = dot(uintBitsToFloat(texelFetch(patch_texture, at + 2)), draw.map_weights);
    float fraction     = clamp(uintBitsToFloat(record.z) * mapped, 0.0, 1.0) * draw.density;

    hair_detail detail  = find_detail(record.w, uintBitsToFloat(texelFetch(patch_texture, at + 3)));
    float       wanted  = float(record.y) * fraction * detail.strands;
    uint        strands = uint(ceil(wanted));
    return hair_patch_lines(record.x, strands, uint(ceil(detail.segments)), detail.segments,
                            1.0 - (float(strands) - wanted), thickness * detail.thickness,
                            thickness * detail.thickness * detail.wider, detail.thickness);
#endif
}

#endif
