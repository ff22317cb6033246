// patch.glsl - the number of strands of a patch that are drawn, their width and their number of
// segments. Every drawing path calls it. With HAIR_EVERY_FOLLOWER all followers count as drawn.
//
// All of these change continuously. The last strand thins out before it disappears. Segments begin
// at equal distances from the root, and the last segment shrinks.
#ifndef HAIR_PATCH_GLSL
#define HAIR_PATCH_GLSL

#include "strands/lod.glsl"

#ifdef HAIR_STORED
layout(std430, binding = HAIR_BIND_STORED_PATCH) readonly restrict buffer patch_buffer
{
    hair_patch stored_patch[];
};

uint       count_patches() { return uint(stored_patch.length()); }
hair_patch fetch_patch(uint number) { return stored_patch[number]; }
#else
layout(binding = HAIR_UNIT_PATCH) uniform usamplerBuffer patch_texture;

hair_patch fetch_patch(uint number)
{
    int   at     = int(number) * HAIR_PATCH_TEXELS;
    uvec4 record = texelFetch(patch_texture, at), detail = texelFetch(patch_texture, at + 3);
    return hair_patch(record.x, record.y, uintBitsToFloat(record.z), record.w,
                      uintBitsToFloat(texelFetch(patch_texture, at + 1)),
                      uintBitsToFloat(texelFetch(patch_texture, at + 2)), uintBitsToFloat(detail.x),
                      uintBitsToFloat(detail.y), uintBitsToFloat(detail.z), detail.w);
}
#endif

struct hair_patch_lines {
    uint  first;     // First follower.
    uint  all;       // Strands, and those that are drawn.
    uint  strands;
    uint  segments;  // Segments of a whole strand.
    float whole;     // Segments, with the last one as a fraction.
    float fading;    // Fraction of its width that the last strand has.
    float thickness; // Factor of the width of all strands that have all segments.
    float drawn; // Factor of the width with the segments that are drawn.
    float widened;   // Factor within `thickness` that compensates for strands that are left out.
};

// Return the number that the first strand of a patch has in the vertex cache. Patches are in the
// order of their strands.
uint first_in_cache(uint number, uint first)
{
    uint place, rest;
    if (draw.cache_fraction == 0u) return first;
    umulExtended(first, draw.cache_fraction, place, rest);
    return place + HAIR_CACHE_MORE * number;
}

// Return how many of the first strands of a patch the vertex cache has room for. The patch has
// `all`, which begin at `first`.
uint limit_to_cache(uint number, uint first, uint all, uint strands)
{
    return min(strands, first_in_cache(number + 1u, first + all) - first_in_cache(number, first));
}

hair_patch_lines find_lines(uint number)
{
    hair_patch own = fetch_patch(number);
#ifdef HAIR_EVERY_FOLLOWER
    return hair_patch_lines(own.first, own.count, own.count, draw.segments, float(draw.segments), 1.0,
                            1.0, 1.0, 1.0);
#else
#ifdef HAIR_OCCLUSION
    if (own.occluded != 0u) return hair_patch_lines(own.first, own.count, 0u, 1u, 1.0, 1.0, 1.0, 1.0, 1.0);
#endif
    float mapped    = dot(own.map_density, draw.map_weights);
    float thickness = dot(own.map_thickness, draw.map_weights);
    float fraction  = clamp(own.density * mapped, 0.0, 1.0) * draw.density;

    hair_detail detail  = find_detail(own.guide, vec3(own.reach, own.longest, own.importance));
    float       wanted  = float(own.count) * fraction * detail.strands;
    uint        strands = uint(ceil(wanted));
    return hair_patch_lines(own.first, own.count, strands, uint(ceil(detail.segments)), detail.segments,
                            1.0 - (float(strands) - wanted), thickness * detail.thickness,
                            thickness * detail.thickness * detail.wider, detail.thickness);
#endif
}

#endif
