// wake.c - Closed-form wind against the fluid, around a ball, and the cost of both on hair.
#include "tools/bench/flow.h"
#include "tools/bench/live_scene.h"

#include "tests/reference/air.h"

#include <math.h>

#define REACH 6 // points to each side, half a radius apart
#define STRANDS 64
#define FRAMES 4

// Return the fluid's velocity at a place in radii from the ball's middle.
static void fluid_at(const struct bench_flow* flow, const double* mean, const double place[3], double out[3])
{
    double n = flow->fluid.desc.cells, radius = (double)FLOW_BALL * n / (double)FLOW_SIDE, at[3];
    for (int k = 0; k < 3; ++k) at[k] = n / 2 + radius * place[k];
    for (int k = 0; k < 3; ++k) out[k] = bench_flow_at(flow, mean, k, at);
}

// Compute the root mean square difference all around the ball (off[0]) and behind it (off[1]).
static void compare(const struct bench_flow* flow, const double* mean, double off[2])
{
    static const double wind[3] = {1, 0, 0};
    double count[2] = {0, 0};
    off[0] = off[1] = 0;
    for (int z = -REACH; z <= REACH; ++z)
        for (int y = -REACH; y <= REACH; ++y)
            for (int x = -REACH; x <= REACH; ++x) {
                double place[3] = {0.5 * x, 0.5 * y, 0.5 * z}, fluid[3], formulas[3], square = 0;
                double beside = sqrt(place[1] * place[1] + place[2] * place[2]);
                // Skip points inside the ball or less than a cell away.
                if (place[0] * place[0] + beside * beside < 1.2) continue;
                fluid_at(flow, mean, place, fluid);
                hair_reference_around_ball(wind, place, formulas);
                for (int k = 0; k < 3; ++k) square += (fluid[k] - formulas[k]) * (fluid[k] - formulas[k]);
                off[0] += square, ++count[0];
                if (x <= 0 || beside > 1.5) continue;
                off[1] += square, ++count[1];
            }
    for (int i = 0; i < 2; ++i) off[i] = sqrt(off[i] / count[i]);
}

void bench_lee_compare(const struct bench_flow* flow, const double* mean)
{
    struct bench* bench = flow->bench;
    double off[2];
    json_t* row = bench_rows_add(&bench->rows);
    compare(flow, mean, off);
    bench_set_text(row, "case", "past a ball");
    bench_set_text(row, "method", "formulas");
    bench_set_count(row, "resolution", flow->fluid.desc.cells);
    bench_set_number(row, "off", off[0]);
    bench_set_number(row, "off_behind", off[1]);
    for (int i = 0; i < 26; ++i) {
        static const double wind[3] = {1, 0, 0};
        double place[3] = {i < 12 ? -3.9 + 0.25 * i : 1.1 + 0.2 * (i - 12), 0, 0}, speed[2][3];
        fluid_at(flow, mean, place, speed[0]);
        hair_reference_around_ball(wind, place, speed[1]);
        for (int k = 0; k < 2; ++k) {
            row = bench_rows_add(&bench->rows);
            bench_set_text(row, "case", "through a ball's middle");
            bench_set_text(row, "method", k ? "formulas" : "fluid");
            bench_set_count(row, "resolution", flow->fluid.desc.cells);
            bench_set_number(row, "along", place[0]);
            bench_set_number(row, "speed", speed[k][0]);
        }
    }
}

static bool measure(struct bench* bench, struct bench_scene* scene, struct bench_times* times)
{
    struct bench_live_scene live;
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.1f;
    ball.position[1] = -0.15f;
    if (!bench_live(bench, scene, &live)) return false;
    bool ok = hair_set_colliders(live.hair, &ball, 1, sizeof ball) == HAIR_OK;
    for (int i = 0; i < 10 && ok; ++i) ok = bench_step(&live, NULL, 1.0 / 60);
    ok = ok && bench_time(&live, FRAMES, NULL, 1.0 / 60, times);
    bench_free_live_scene(&live);
    return ok;
}

// Measure the step of a frame, of strands that hang around a ball.
void bench_lee_cost(struct bench* bench)
{
    static const char* const methods[] = {"no wind", "formulas", "fluid", "fluid, slowed by hair"};
    const double root[3] = {0, 0, 0}, along[3] = {0, -1, 0};
    for (int i = 0; i < 4; ++i) {
        struct bench_scene scene = bench_scene_default();
        struct bench_times times;
        if (!bench_begin(bench, "a step in wind", methods[i])) continue;
        bench_scene_straight(&scene, 16, 0.2, root, along);
        scene.strands = STRANDS;
        scene.mapping = bench->options.mapping;
        scene.wind.velocity[0] = i > 0 ? 3 : 0;
        scene.wind.model = i > 1 ? HAIR_WIND_FLUID : HAIR_WIND_AMBIENT;
        scene.wind.fluid.drag_strand_count = i > 2 ? 100000 : 0;
        if (!measure(bench, &scene, &times)) {
            bench_refuse(bench, "a step in wind", methods[i]);
            continue;
        }
        json_t* row = bench_rows_add(&bench->rows);
        bench_set_text(row, "case", "a step in wind");
        bench_set_text(row, "method", methods[i]);
        bench_set_count(row, "resolution", scene.wind.fluid.resolution);
        bench_set_number(row, "ms", times.ms / FRAMES);
        bench_set_number(row, "ms_min", times.ms_min / FRAMES);
        bench_set_number(row, "ms_max", times.ms_max / FRAMES);
        bench_set_count(row, "runs", times.runs);
    }
}
