// histogram.comp - sorting of segments by distance from the eye. This pass counts them in a depth
// histogram. With HAIR_SCATTER it scatters them to the positions that the prefix sum of the
// histogram gives. One thread per segment.
#version 450 core
#define HAIR_POSITION_SLOT HAIR_BIND_RIBBON_POSITION
#include "draw/vertex_cache.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_HISTOGRAM) restrict buffer bucket_buffer { uint bin[]; };
layout(std430, binding = HAIR_BIND_STRAND) readonly restrict buffer strand_buffer { hair_strand strand[]; };
layout(std430, binding = HAIR_BIND_COMMAND) readonly restrict buffer command_buffer
{
    hair_draw_command command[];
};
layout(std430, binding = HAIR_BIND_SORTED_SEGMENTS) writeonly restrict buffer sorted_buffer
{
    uvec2 sorted[];
};

vec3 position_at(uint number, float t)
{
    int   at;
    float fraction = place_between(number, t, at);
    return mix(position_of(at).xyz, position_of(at + 1).xyz, fraction);
}

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    uint s = i / draw.segments, k = i % draw.segments;
    if (s >= command[0].strands || float(k) >= strand[s].whole) return;
    hair_strand own    = strand[s];
    vec3        middle = 0.5 * (position_at(own.follower, min(float(k) / own.whole, 1.0)) +
                         position_at(own.follower, min(float(k + 1u) / own.whole, 1.0)));
    float       away   = draw.eye.w > 0.0 ? distance(draw.eye.xyz, middle) : -dot(draw.eye.xyz, middle);
    float       near   = clamp((away - draw.sort.x) * draw.sort.y, 0.0, float(HAIR_SORT_BUCKETS) - 1.0);
    uint        number = uint(HAIR_SORT_BUCKETS) - 1u - uint(near);
    uint        at     = atomicAdd(bin[number], 1u);
#ifdef HAIR_SCATTER
    sorted[at] = s * (draw.segments + 1u) + k + uvec2(0u, 1u);
#endif
}
