// timer.h - Time that OpenGL takes between start and stop.
#ifndef HAIR_TOOLS_BENCH_TIMER_H
#define HAIR_TOOLS_BENCH_TIMER_H

#include <stdbool.h>
#include <stdint.h>

#define BENCH_TIMER_SPANS 8

// A timer that uses the driver's timers. If those do not measure compute shaders, a clock and
// glFinish() are used.
struct bench_timer {
    bool software;
    unsigned queries[2 * BENCH_TIMER_SPANS]; // OpenGL names
    uint32_t spans;
    double start, ms;
};

// Create a timer. All functions here need a current OpenGL context.
void bench_timer_make(struct bench_timer* timer, bool software);
void bench_timer_free(struct bench_timer* timer);

// Start a span. There are at most BENCH_TIMER_SPANS successive spans.
void bench_timer_start(struct bench_timer* timer);
void bench_timer_stop(struct bench_timer* timer);

// Return the time in ms of all spans since the last call. Waits for the GPU.
double bench_timer_take(struct bench_timer* timer);

struct bench_times {
    double ms, ms_min, ms_max; // `ms` is the median
    uint32_t runs;
};

// Return the statistics of the times of several runs in ms. The times are sorted.
struct bench_times bench_times_of(double* ms, uint32_t runs);

// Return whether to make another run after `runs` runs that took `passed` ms in total.
bool bench_times_want_more(uint32_t runs, uint32_t max, double passed, double enough);

#endif
