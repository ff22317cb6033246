// timer.c - Timed spans of OpenGL commands, and the median of many.
#include "tools/bench/timer.h"

#include "tools/common/stats.h"

#include <assert.h>
#include <epoxy/gl.h>
#include <stdlib.h>

void bench_timer_make(struct bench_timer* timer, bool software)
{
    *timer = (struct bench_timer){.software = software};
    if (!software) glCreateQueries(GL_TIMESTAMP, 2 * BENCH_TIMER_SPANS, timer->queries);
}

void bench_timer_free(struct bench_timer* timer)
{
    if (timer->queries[0]) glDeleteQueries(2 * BENCH_TIMER_SPANS, timer->queries);
    *timer = (struct bench_timer){0};
}

void bench_timer_start(struct bench_timer* timer)
{
    assert(timer->spans < BENCH_TIMER_SPANS);
    if (timer->software) {
        glFinish();
        timer->start = hair_now();
    } else
        glQueryCounter(timer->queries[2 * timer->spans], GL_TIMESTAMP);
}

void bench_timer_stop(struct bench_timer* timer)
{
    if (timer->software) {
        glFinish();
        timer->ms += hair_now() - timer->start;
    } else
        glQueryCounter(timer->queries[2 * timer->spans + 1], GL_TIMESTAMP);
    ++timer->spans;
}

double bench_timer_take(struct bench_timer* timer)
{
    double ms = timer->ms;
    for (uint32_t i = 0; i < timer->spans && !timer->software; ++i) {
        GLuint64 start = 0, end = 0;
        glGetQueryObjectui64v(timer->queries[2 * i], GL_QUERY_RESULT, &start);
        glGetQueryObjectui64v(timer->queries[2 * i + 1], GL_QUERY_RESULT, &end);
        ms += (double)(end - start) * 1e-6;
    }
    timer->ms = 0;
    timer->spans = 0;
    return ms;
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

struct bench_times bench_times_of(double* ms, uint32_t runs)
{
    qsort(ms, runs, sizeof *ms, compare);
    return (struct bench_times){ms[runs / 2], ms[0], ms[runs - 1], runs};
}

bool bench_times_want_more(uint32_t runs, uint32_t max, double passed, double enough)
{
    enum { ENOUGH_RUNS = 3 };
    return runs == 0 || (runs < max && passed < enough) || (runs < ENOUGH_RUNS && passed < 4 * enough);
}
