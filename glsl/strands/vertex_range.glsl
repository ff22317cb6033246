// vertex_range.glsl - the follower vertices that a work group covers. draw.chunks work groups share
// a patch.
#include "strands/patch.glsl"
#include "workgroup.glsl"

struct vertex_range {
    uint first, end, stride; // In vertices of all followers.
};

vertex_range find_vertex_range()
{
    uint number = hair_group() / draw.chunks, each = draw.segments + 1u,
         stride = draw.chunks * HAIR_GROUP_SIZE;
    if (number >= uint(textureSize(patch_texture)) / HAIR_PATCH_TEXELS) return vertex_range(0u, 0u, stride);
    uvec2 strands = find_strands(number);
    uint  own     = hair_group() % draw.chunks * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    return vertex_range(strands.x * each + own, (strands.x + strands.y) * each, stride);
}
