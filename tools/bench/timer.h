// timer.h - how long OpenGL takes for what is between start and stop.
#ifndef HAIR_TOOLS_BENCH_TIMER_H
#define HAIR_TOOLS_BENCH_TIMER_H

#include <stdbool.h>
#include <stdint.h>

#define BENCH_TIMER_SPANS 8

// By the driver's timers; where those do not see compute shaders, by a clock and glFinish.
struct bench_timer {
    bool software;
    unsigned queries[2 * BENCH_TIMER_SPANS]; // OpenGL names
    uint32_t spans;
    double start, ms;
};

// Needs OpenGL current, as does what follows.
void bench_timer_make(struct bench_timer* timer, bool software);
void bench_timer_free(struct bench_timer* timer);

// At most BENCH_TIMER_SPANS spans, one after the other.
void bench_timer_start(struct bench_timer* timer);
void bench_timer_stop(struct bench_timer* timer);

// ms of all spans since it was last taken. Waits.
double bench_timer_take(struct bench_timer* timer);

struct bench_times {
    double ms, ms_min, ms_max; // ms: the median
    uint32_t runs;
};

// Of the ms of several runs, which get sorted.
struct bench_times bench_times_of(double* ms, uint32_t runs);

// Whether another run is worth its time: of those that took `passed` ms together.
bool bench_times_want_more(uint32_t runs, uint32_t most, double passed, double enough);

#endif
