// expand.comp - the vertex cache of followers, segments + 1 vertices each, to be drawn or read
// back. It has all followers with HAIR_EVERY_FOLLOWER, and otherwise those that a view draws. Light
// needs no tangents (HAIR_POSITIONS). Work groups are those of strands/vertex_range.glsl.
#version 450 core
#include "strands/evaluate.glsl"
#include "strands/vertex_range.glsl"
#include "strands/packed.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_CACHED_POSITION) writeonly restrict buffer cached_position_buffer
{
    vec4 expanded[];
};
#ifndef HAIR_POSITIONS
layout(std430, binding = HAIR_BIND_CACHED_TANGENT) writeonly restrict buffer cached_tangent_buffer
{
    uvec2 cached_tangent[];
};
#endif

void main()
{
    vertex_range run  = find_vertex_range();
    uint       each = draw.segments + 1u;
    for (uint i = run.first; i < run.end; i += run.stride) {
        uint       number = i / each + run.skipped;
        hair_point point  = evaluate(fetch_follower(number), number, float(i % each) / float(draw.segments));
        expanded[i] = vec4(point.position, point.radius);
#ifndef HAIR_POSITIONS
        cached_tangent[i] = pack_tangent(point.tangent);
#endif
    }
}
