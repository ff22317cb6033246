// prefix_sum.comp - prefix sum of the depth histogram, which gives the first sorted segment of each
// bin, and the commands that draw all segments. One work group.
#version 450 core
#include "draw_params.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_COUNT_THREADS) in;

layout(std430, binding = HAIR_BIND_HISTOGRAM) restrict buffer bucket_buffer { uint bin[]; };
layout(std430, binding = HAIR_BIND_COMMAND) writeonly restrict buffer command_buffer
{
    hair_draw_command command[];
};

shared uint sums[HAIR_COUNT_THREADS];

// Write the commands that draw sorted segments, as many at a time as full strands have.
void write_commands(uint segments)
{
    uint at_once = draw.draw_instances * HAIR_INSTANCE_STRANDS;
    uint all     = (draw.followers + at_once - 1u) / at_once;
    for (uint k = gl_LocalInvocationID.x; k < all; k += HAIR_COUNT_THREADS) {
        uint from  = min(k * at_once * draw.segments, segments);
        uint count = min(segments - from, at_once * draw.segments);
        command[HAIR_LIST_COMMANDS + HAIR_LIST_KINDS * k + HAIR_LIST_SORTED] =
            hair_draw_command(2u * count, 1u, 2u * from, 0u, 0u, 0u, 0u, 0u);
    }
}

void main()
{
    uint i = gl_LocalInvocationID.x, each = uint(HAIR_SORT_BUCKETS / HAIR_COUNT_THREADS), first = i * each,
         sum = 0u;
    for (uint k = first; k < first + each; ++k) sum += bin[k];

    // Inclusive prefix sum over the threads (Hillis and Steele 1986).
    sums[i] = sum;
    for (uint reach = 1u; reach < HAIR_COUNT_THREADS; reach *= 2u) {
        synchronise();
        uint more = i >= reach ? sums[i - reach] : 0u;
        synchronise();
        sums[i] += more;
    }
    uint start = sums[i] - sum;
    for (uint k = first; k < first + each; ++k) {
        uint count = bin[k];
        bin[k]  = start;
        start += count;
    }
    write_commands(sums[HAIR_COUNT_THREADS - 1u]);
}
