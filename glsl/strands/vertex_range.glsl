// vertex_range.glsl - the follower vertices that a work group covers. draw.chunks work groups share
// a patch.
#include "strands/patch.glsl"
#include "workgroup.glsl"

struct vertex_range {
    uint  number; // Patch.
    uint  first, end, stride; // In vertices of all followers.
    float thickness, widened; // Factors of the width, see hair_patch_lines.
};

vertex_range find_vertex_range()
{
    uint number = hair_group() / draw.chunks, each = draw.segments + 1u,
         stride = draw.chunks * HAIR_GROUP_SIZE;
    vertex_range none = vertex_range(number, 0u, 0u, stride, 1.0, 1.0);
    if (number >= uint(textureSize(patch_texture)) / HAIR_PATCH_TEXELS) return none;
    uvec2 all = texelFetch(patch_texture, int(number) * HAIR_PATCH_TEXELS).xy; // hair_patch
    uint  own = hair_group() % draw.chunks * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    // A strand that is about to appear counts as drawn, because other stages round differently.
    hair_patch_lines lines = find_lines(number);
    uint  strands = min(lines.strands + uint(lines.fading > 0.999), all.y);
    return vertex_range(number, all.x * each + own, (all.x + strands) * each, stride, lines.thickness,
                        lines.widened);
}
