// expand.comp - the vertex cache of followers, segments + 1 vertices each, to be drawn or read
// back. Work groups are those of run.glsl.
#version 450 core
#include "evaluate.glsl"
#include "run.glsl"
#include "packed.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_EXPANDED) writeonly restrict buffer expanded_buffer { vec4 expanded[]; };
layout(std430, binding = HAIR_BIND_EXPANDED_TANGENT) writeonly restrict buffer expanded_tangent_buffer { uvec2 expanded_tangent[]; };

void main()
{
    vertex_run run  = find_run();
    uint       each = draw.segments + 1u;
    for (uint i = run.first; i < run.end; i += run.stride) {
        hair_point point = evaluate(fetch_follower(i / each), i / each, float(i % each) / float(draw.segments));
        expanded[i]         = vec4(point.position, point.radius);
        expanded_tangent[i] = pack_tangent(point.tangent);
    }
}
