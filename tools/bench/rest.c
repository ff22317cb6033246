// rest.c - Speed of hair that should be at rest.
#include "tools/bench/rest.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAME (1.0 / 60)
#define MAX_ROWS 64
// Minimum interval of a speed, s. Over a shorter time, rounding of floats would count as speed. A
// vertex that oscillates every substep returns to its position after two substeps. Speeds are
// therefore measured over an odd number of substeps.
#define MIN_INTERVAL (1.0 / 1000)

struct bench_rest_desc bench_rest_desc_default(void)
{
    return (struct bench_rest_desc){.seconds = 10, .window = 0.5, .patience = 15};
}

bool bench_is_asleep(hair_instance* hair)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[MAX_ROWS];
    uint32_t count = 0;
    if (hair_report(hair, true, &info, rows, sizeof *rows, MAX_ROWS, &count)) return false;
    for (uint32_t i = 0; i < count && i < MAX_ROWS; ++i)
        if (!strcmp(rows[i].stage, "solve")) return rows[i].skip_reason == HAIR_SKIP_REASON_ASLEEP;
    return false;
}

struct state {
    hair_instance* hair;
    const struct bench_rest_desc* desc;
    uint32_t guides, vertices;
    double time;
    float *now, *before;
    bool* moving; // per guide
};

static bool has_to_stop(const struct state* state)
{
    return state->desc->stop && state->desc->stop();
}

static bool read_guides(struct state* state)
{
    uint32_t count, all = state->guides * state->vertices;
    return !hair_read_positions(state->hair, HAIR_READ_GUIDES, state->now, all, &count) && count == all;
}

// Simulate until the time `until` or until the hair is asleep. Wait for each step, because a queue
// of steps would delay the report of sleep.
static bool wait_until(struct state* state, double until, struct bench_rest* out)
{
    while (state->time < until - 1e-6 && !isfinite(out->seconds_asleep)) {
        if (has_to_stop(state) || hair_step(state->hair, (float)FRAME)) return false;
        glFinish();
        state->time += FRAME;
        if (bench_is_asleep(state->hair)) out->seconds_asleep = state->time;
    }
    return true;
}

static void compare(struct state* state, double passed, struct bench_rest* out)
{
    for (uint32_t i = 0; i < state->guides * state->vertices; ++i) {
        double squares = 0;
        for (uint32_t k = 0; k < 3; ++k)
            squares += pow((double)state->now[3 * i + k] - (double)state->before[3 * i + k], 2);
        double speed = sqrt(squares) / passed;
        out->finite = out->finite && isfinite(speed);
        if (!(speed <= out->max_speed)) out->max_speed = speed;
        if (!(speed <= BENCH_REST_MOVING)) state->moving[i / state->vertices] = true;
    }
}

// Return the interval of a speed, an odd number of substeps. Hair moves in whole substeps only.
static double find_interval(hair_instance* hair)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    if (hair_get_solver_stats(hair, &solver_stats) || !(solver_stats.substep > 0)) return FRAME;
    double substep = (double)solver_stats.substep, count = ceil(MIN_INTERVAL / substep - 1e-3);
    return substep * (fmod(count, 2) == 0 ? count + 1 : count);
}

static bool measure_window(struct state* state, struct bench_rest* out)
{
    double interval = find_interval(state->hair);
    if (!read_guides(state)) return false;
    for (double end = state->desc->seconds; state->time < end - 1e-6; state->time += interval) {
        memcpy(state->before, state->now, 3 * sizeof *state->now * state->guides * state->vertices);
        if (has_to_stop(state) || hair_step(state->hair, (float)interval) || !read_guides(state))
            return false;
        if (bench_is_asleep(state->hair)) out->seconds_asleep = fmin(out->seconds_asleep, state->time);
        compare(state, interval, out);
    }
    for (uint32_t i = 0; i < state->guides; ++i) out->moving_fraction += state->moving[i];
    out->moving_fraction /= state->guides;
    return true;
}

static bool measure(struct state* state, struct bench_rest* out)
{
    const struct bench_rest_desc* desc = state->desc;
    if (!wait_until(state, desc->seconds - desc->window, out)) return false;
    if (!isfinite(out->seconds_asleep) && !measure_window(state, out)) return false;
    // Moving hair does not fall asleep.
    double patience = out->max_speed <= BENCH_REST_MOVING ? desc->patience : 0;
    return wait_until(state, patience, out) && read_guides(state);
}

bool bench_measure_rest(hair_instance* hair, uint32_t guides, uint32_t vertices,
                        const struct bench_rest_desc* desc, struct bench_rest* out)
{
    size_t size = 3 * sizeof(float) * guides * vertices;
    struct state state = {.hair = hair, .desc = desc, .guides = guides, .vertices = vertices};
    state.now = malloc(size);
    state.before = malloc(size);
    state.moving = calloc(guides, sizeof *state.moving);
    *out = (struct bench_rest){.seconds_asleep = INFINITY, .finite = true};
    bool whole = state.now && state.before && state.moving && measure(&state, out);
    for (size_t i = 0; i < 3 * (size_t)guides * vertices && whole; ++i)
        out->finite = out->finite && isfinite(state.now[i]);
    free(state.now);
    free(state.before);
    free(state.moving);
    return whole;
}
