// density_bounds.comp - the bounding box of the drawn strands, in the head's frame. Work groups are
// those of strands/vertex_range.glsl.
#version 450 core
#include "strands/vertex_range.glsl"
#include "light/density.glsl"

shared uint own[6]; // Box of this work group.

void main()
{
    uint       i   = gl_LocalInvocationID.x;
    vertex_range run = find_vertex_range();
    if (i < 6u) own[i] = 0xffffffffu;
    synchronise();
    uvec3 low = uvec3(0xffffffffu), high = low;
    for (uint vertex = run.first; vertex < run.end; vertex += run.stride) {
        uvec3 u = to_float_key(in_head(strand_vertex[vertex].xyz));
        low = min(low, u), high = min(high, ~u);
    }
    for (int k = 0; k < 3 && run.first < run.end; ++k) {
        atomicMin(own[k], low[k]);
        atomicMin(own[3 + k], high[k]);
    }
    synchronise();
    if (i < 6u && own[i] < box[i]) atomicMin(box[i], own[i]);
}
