// field_body.c - Cost of the distances to a body that deforms, in suite `field`.
#include "tools/bench/field_body.h"
#include "tools/bench/pass_time.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 100, COLUMNS = 100, VERTICES = (ROWS + 1) * COLUMNS, TRIANGLES = 2 * ROWS * COLUMNS };

#define RUNS 21
#define HALF 0.16f // half a side of the body's box, m
#define LIMIT 0.3 // ms on a GPU, for 64 voxels

struct shape {
    // A shape, one in which every vertex has moved, and one in which a hundredth of them has moved.
    float positions[3][3 * VERTICES];
    uint32_t triangles[3 * TRIANGLES];
};

// Make a lump of 0.1 m that breathes and nods, whose every vertex moves by about 2 mm.
static void fill_shape(struct shape* shape)
{
    const double pi = 3.14159265358979323846;
    size_t count = 0;
    for (uint32_t i = 0; i < VERTICES; ++i) {
        double polar = pi * (i / COLUMNS) / ROWS, turn = 2 * pi * (i % COLUMNS) / COLUMNS;
        double side = i / COLUMNS % ROWS ? sin(polar) : 0; // one point at the poles
        for (int k = 0; k < 2; ++k) {
            double radius = 0.1 * (1 + 0.25 * side * side * sin(3 * turn) + 0.02 * k), nod = 0.02 * k;
            float* p = shape->positions[k] + 3 * i;
            p[0] = (float)(radius * side * sin(turn));
            p[1] = (float)(radius * cos(polar));
            p[2] = (float)(radius * (side * cos(turn) + nod * cos(polar)));
        }
        // The part is as large on a head of 0.1 m as a mouth.
        bool is_in_part = fabs(polar - 2) < 0.35 && (turn < 0.35 || turn > 2 * pi - 0.35);
        memcpy(shape->positions[2] + 3 * i, shape->positions[is_in_part] + 3 * i, 3 * sizeof(float));
    }
    for (uint32_t i = 0; i < ROWS * COLUMNS; ++i) {
        uint32_t right = (i + 1) % COLUMNS ? i + 1 : i + 1 - COLUMNS;
        const uint32_t two[6] = {i, i + COLUMNS, right, right, i + COLUMNS, right + COLUMNS};
        memcpy(shape->triangles + count, two, sizeof two);
        count += 6;
    }
}

// Measure one move. Return NAN if the library refused.
static double time_move(const struct bench* bench, hair_body* body, const float* positions)
{
    uint32_t runs;
    glFinish();
    double gpu = bench_sum_passes(bench, "field/body_", &runs), start = hair_now();
    if (hair_body_set_positions(body, positions, VERTICES, 3 * sizeof(float))) return NAN;
    glFinish();
    double wall = hair_now() - start;
    return bench->software ? wall : bench_sum_passes(bench, "field/body_", &runs) - gpu;
}

static int by_time(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

// Measure a body that moves to the shape `to` and back. It rests if `to` is 0.
static bool run_body(struct bench* bench, const struct shape* shape, const char* name, uint32_t resolution,
                     int to)
{
    uint32_t runs = bench->options.quick ? 5 : RUNS, before, after;
    double ms[RUNS];
    hair_body_desc desc = hair_body_desc_default();
    hair_body* body = NULL;
    desc.positions = shape->positions[0];
    desc.triangles = shape->triangles;
    desc.vertex_count = VERTICES;
    desc.triangle_count = TRIANGLES;
    desc.resolution = resolution;
    for (int k = 0; k < 3; ++k) desc.lower[k] = -HALF, desc.upper[k] = HALF;
    bool ok = !hair_body_create(bench->context, &desc, &body);
    // The first run of a pass may compile it.
    ok = ok && !isnan(time_move(bench, body, shape->positions[to ? to : 1])) &&
         !isnan(time_move(bench, body, shape->positions[0]));
    bench_sum_passes(bench, "field/body_", &before);
    for (uint32_t i = 0; i < runs && ok; ++i)
        ok = !isnan(ms[i] = time_move(bench, body, shape->positions[i % 2 ? 0 : to]));
    bench_sum_passes(bench, "field/body_", &after);
    hair_body_destroy(body);
    if (!ok) return false;
    qsort(ms, runs, sizeof *ms, by_time);
    json_t* row = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", "deform");
    bench_set_count(row, "resolution", resolution);
    bench_set_count(row, "triangles", TRIANGLES);
    bench_set_number(row, "ms", ms[runs / 2]);
    bench_set_number(row, "ms_min", ms[0]);
    bench_set_number(row, "ms_max", ms[runs - 1]);
    bench_set_count(row, "runs", runs);
    bench_set_count(row, "passes_run", after - before);
    if (!to) bench_set_flag(row, "pass", after == before);
    if (to && !bench->software && resolution == 64) {
        bench_set_number(row, "limit", LIMIT);
        bench_set_flag(row, "pass", ms[runs / 2] <= LIMIT);
    }
    return true;
}

void bench_field_bodies(struct bench* bench)
{
    static const uint32_t resolutions[] = {32, 64, 128};
    struct shape* shape = malloc(sizeof *shape);
    static const char* const names[] = {"body at rest", "body", "body in part"};
    if (shape) fill_shape(shape);
    for (int to = 0; to < 3; ++to)
        for (int i = 0; i < (bench->options.quick ? 2 : 3); ++i)
            if ((to || resolutions[i] == 64) && bench_begin(bench, names[to], "deform") &&
                !(shape && run_body(bench, shape, names[to], resolutions[i], to)))
                bench_refuse(bench, names[to], "deform");
    free(shape);
}
