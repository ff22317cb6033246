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
    for (uint vertex = run.first; vertex < run.end; vertex += run.stride) {
        vec3  at = in_head(strand_vertex[vertex].xyz);
        uvec3 u  = to_float_key(at);
        for (int k = 0; k < 3; ++k) {
            atomicMin(own[k], u[k]);
            atomicMin(own[3 + k], ~u[k]);
        }
    }
    synchronise();
    if (i < 6u) atomicMin(box[i], own[i]);
}
