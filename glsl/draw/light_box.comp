// light_box.comp - the box around all hair, in the head's frame. One thread per follower vertex.
#version 450 core
#include "density.glsl"

shared uint own[6]; // of this group

void main()
{
    uint i = gl_LocalInvocationID.x, vertex = hair_group() * HAIR_GROUP_SIZE + i;
    if (i < 6u) own[i] = 0xffffffffu;
    synchronise();
    if (vertex < draw.followers * (draw.segments + 1u)) {
        vec3  at = in_head(strand_vertex[vertex].xyz);
        uvec3 u  = to_ordered(at);
        for (int k = 0; k < 3; ++k) {
            atomicMin(own[k], u[k]);
            atomicMin(own[3 + k], ~u[k]);
        }
    }
    synchronise();
    if (i < 6u) atomicMin(box[i], own[i]);
}
