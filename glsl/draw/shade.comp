// shade.comp - light from strand vertices to the eye, computed before drawing, because some GPUs
// have few graphics units. Work groups are those of strands/vertex_range.glsl.
#version 450 core
#include "draw/strand.glsl"
#include "strands/vertex_range.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_SHADED) writeonly restrict buffer shaded_buffer { uvec2 shaded[]; };

void main()
{
    vertex_range run  = find_vertex_range();
    uint       each = draw.segments + 1u;
    for (uint i = run.first; i < run.end; i += run.stride) {
        uint          number   = i / each;
        float         t        = place_of(i % each, float(draw.segments));
        hair_follower follower = fetch_follower(number);
        hair_point    point    = evaluate(follower, number, t);
        shaded[i] = pack_color(shade(fragment_of(follower, number, number, point, t)));
    }
}
