// pass_time.c - GPU time of passes by the first letters of their names.
#include "tools/bench/pass_time.h"

#include <string.h>

double bench_sum_passes(const struct bench* bench, const char* prefix, uint32_t* runs)
{
    hair_timing timings[BENCH_MAX_PASSES];
    uint32_t count = hair_get_timings(bench->context, timings, BENCH_MAX_PASSES);
    double sum = 0;
    *runs = 0;
    for (uint32_t i = 0; i < count && i < BENCH_MAX_PASSES; ++i)
        if (!strncmp(timings[i].pass, prefix, strlen(prefix))) {
            sum += timings[i].total_ms;
            *runs += timings[i].runs;
        }
    return sum;
}
