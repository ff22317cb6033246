// compact_strands.comp - the list of strands that are drawn without a tessellator. A work group per
// patch.
#version 450 core
#include "strands/patch.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_START) readonly restrict buffer start_buffer { uint start[]; };
layout(std430, binding = HAIR_BIND_STRAND) writeonly restrict buffer strand_buffer { hair_strand strand[]; };

void main()
{
    uint number = hair_group();
    if (number >= count_patches()) return;
    hair_patch_lines lines = find_lines(number);
    uint first = first_in_cache(number, lines.first);
    uint last  = limit_to_cache(number, lines.first, lines.all, lines.strands) - 1u;
    for (uint i = gl_LocalInvocationID.x; i < lines.strands; i += HAIR_GROUP_SIZE) {
        float fraction = i + 1u == lines.strands ? lines.fading : 1.0;
        strand[start[number] + i] =
            hair_strand(lines.first + i, lines.drawn * fraction, lines.widened, lines.whole,
                        first + min(i, last), 0u, 0u, 0u);
    }
}
