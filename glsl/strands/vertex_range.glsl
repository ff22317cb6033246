// vertex_range.glsl - the follower vertices that a work group covers. draw.chunks work groups share
// a patch.
#include "strands/patch.glsl"
#include "workgroup.glsl"

struct vertex_range {
    uint  number; // Patch.
    uint  first, end, stride; // In vertices of the vertex cache.
    uint  skipped; // Number of a strand of the patch among all followers, less that in the cache.
    float thickness, widened; // Factors of the width, see hair_patch_lines.
    float cut; // Fraction of the segments that are left out.
};

vertex_range find_vertex_range()
{
    uint number = hair_group() / draw.chunks, each = draw.segments + 1u,
         stride = draw.chunks * HAIR_GROUP_SIZE;
    vertex_range none = vertex_range(number, 0u, 0u, stride, 0u, 1.0, 1.0, 0.0);
    if (number >= count_patches()) return none;
    hair_patch all = fetch_patch(number);
    uint  own = hair_group() % draw.chunks * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    // A strand that is about to appear counts as drawn, because other stages round differently.
    hair_patch_lines lines = find_lines(number);
    uint  strands = min(lines.strands + uint(lines.fading > 0.999), all.count);
    uint  first   = first_in_cache(number, all.first);
    strands       = limit_to_cache(number, all.first, all.count, strands);
    return vertex_range(number, first * each + own, (first + strands) * each, stride, all.first - first,
                        lines.thickness, lines.widened,
                        max(1.0 - lines.whole / float(draw.segments), 0.0));
}
