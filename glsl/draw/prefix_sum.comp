// prefix_sum.comp - prefix sum of the depth histogram, which gives the first sorted segment of each
// bin, and the command that draws all segments. One work group.
#version 450 core
#include "shared.h"
#include "workgroup.glsl"
layout(local_size_x = HAIR_COUNT_THREADS) in;

layout(std430, binding = HAIR_BIND_HISTOGRAM) restrict buffer bucket_buffer { uint bin[]; };
layout(std430, binding = HAIR_BIND_COMMAND) writeonly restrict buffer command_buffer
{
    hair_draw_command command[];
};

shared uint sums[HAIR_COUNT_THREADS];

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
    if (i == HAIR_COUNT_THREADS - 1u)
        command[HAIR_SORTED_COMMAND] = hair_draw_command(2u * sums[i], 1u, 0u, 0u, 0u, 0u, 0u, 0u);
}
