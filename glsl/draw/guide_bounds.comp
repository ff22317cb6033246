// guide_bounds.comp - bounding boxes of the parts of smoothed guides, so that followers need not
// read every vertex. One thread per part.
#version 450 core
#include "draw/hiz.glsl"
#include "strands/guide_positions.glsl"

layout(std430, binding = HAIR_BIND_GUIDE_BOUNDS) writeonly restrict buffer guide_bounds_buffer
{
    vec4 box[];
};

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    uint guide = i / HAIR_OCCLUSION_PARTS, part = i % HAIR_OCCLUSION_PARTS,
         segments = draw.smooth_vertices - 1u;
    if (guide >= hide.guides) return;
    uint from = part * segments / HAIR_OCCLUSION_PARTS,
         to = ((part + 1u) * segments + HAIR_OCCLUSION_PARTS - 1u) / HAIR_OCCLUSION_PARTS;
    vec4 lower = vec4(NOWHERE), upper = vec4(-NOWHERE);
    for (uint k = from; k <= to; ++k) {
        vec4 at = fetch_position(int(guide * draw.smooth_vertices + k));
        lower   = min(lower, at);
        upper   = max(upper, at);
    }
    box[2u * i]      = lower;
    box[2u * i + 1u] = upper; // w: length from the root to the part's end.
}
