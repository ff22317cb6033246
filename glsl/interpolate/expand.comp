// expand.comp - followers written out as vertices, segments + 1 each, to be read back. One thread per vertex.
#version 450 core
#include "evaluate.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_EXPANDED) writeonly restrict buffer expanded_buffer { vec4 expanded[]; };

void main()
{
    uint i    = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    uint each = draw.segments + 1u;
    if (i >= expanded.length()) return;
    hair_point point = evaluate(fetch_follower(i / each), i / each, float(i % each) / float(draw.segments));
    expanded[i]      = vec4(point.position, point.radius);
}
