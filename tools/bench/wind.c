// wind.c - Suite `wind`, cost and convergence of the fluid. The suite measures the parts of a step,
// each projection with a sweep of its tuning, and flows around a ball and in a closed box. It also
// compares the closed-form wind with the fluid.
#include "tools/bench/flow.h"
#include "tools/bench/timer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_RUNS 21
#define ENOUGH 400.0 // total time of the runs of one row, ms
#define MAX_FRUITLESS 30e3 // maximum total time of a method's sweep, ms
#define WANTED 1e-3 // target of the remaining divergence, as a fraction of the initial one

static const char* const columns[] = {
    "case",   "method",     "resolution", "relax",     "iterations", "ms",        "ms_min", "ms_max",
    "runs",   "divergence", "front",      "to_jacobi", "flux",       "asymmetry", "before", "beside",
    "behind", "energy",     "drag_error", "off",       "off_behind", "along",     "speed",  NULL};

static const char* const methods[] = {"multigrid", "relaxation",
                                      "jacobi"}; // in the order of hair_fluid_method

static json_t* new_row(struct bench* bench, const char* name, const char* method, uint32_t cells)
{
    json_t* row = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", method);
    bench_set_count(row, "resolution", cells);
    return row;
}

static void set_times(json_t* row, const struct bench_times* times)
{
    bench_set_number(row, "ms", times->ms);
    bench_set_number(row, "ms_min", times->ms_min);
    bench_set_number(row, "ms_max", times->ms_max);
    bench_set_count(row, "runs", times->runs);
}

static struct bench_times time_part(struct bench_flow* flow, void (*part)(struct bench_flow* flow))
{
    struct bench_timer timer;
    double ms[MAX_RUNS], passed = 0;
    uint32_t runs = 0;
    bench_timer_make(&timer, flow->bench->software);
    part(flow);
    do {
        bench_timer_start(&timer);
        part(flow);
        bench_timer_stop(&timer);
        ms[runs] = bench_timer_take(&timer);
        passed += ms[runs++];
    } while (bench_times_want_more(runs, MAX_RUNS, passed, ENOUGH) && !bench_was_interrupted());
    bench_timer_free(&timer);
    return bench_times_of(ms, runs);
}

// Parts -------------------------------------------------------------------------------------------

static void open_faces(struct bench_flow* flow)
{
    hair_fluid_find_face_fractions(&flow->fluid, &flow->now);
}
static void carry(struct bench_flow* flow)
{
    hair_fluid_advect(&flow->fluid);
}
static void solve(struct bench_flow* flow)
{
    hair_fluid_solve(&flow->fluid);
}
static void project(struct bench_flow* flow)
{
    hair_fluid_project(&flow->fluid);
}
static void step(struct bench_flow* flow)
{
    hair_fluid_step(&flow->fluid, &flow->now);
}

static void run_parts(struct bench* bench)
{
    static const struct {
        const char* name;
        void (*run)(struct bench_flow* flow);
    } parts[] = {
        {"colliders", open_faces}, {"carry", carry}, {"solve", solve}, {"project", project}, {"step", step}};
    for (uint32_t cells = 32; cells <= (bench->options.quick ? 32u : 128u); cells *= 2)
        for (int i = 0; i < 5; ++i) {
            struct bench_flow flow;
            struct hair_fluid_desc desc = {.cells = cells, .side = FLOW_SIDE, .cycles = 4};
            if (!bench_begin(bench, "parts of a step", parts[i].name)) continue;
            if (!bench_flow_live(bench, &desc, true, &flow)) {
                bench_refuse(bench, "parts of a step", parts[i].name);
                continue;
            }
            bench_flow_step(&flow);
            struct bench_times times = time_part(&flow, parts[i].run);
            set_times(new_row(bench, "parts of a step", parts[i].name, cells), &times);
            bench_flow_die(&flow);
        }
}

// Projections -------------------------------------------------------------------------------------

// Best setting of a method, the fastest of those that reach WANTED.
struct best {
    double ms, relax;
    uint32_t iterations;
};

static double run_projection(struct bench* bench, struct hair_fluid_desc desc, struct best* best,
                             double* passed)
{
    struct bench_flow flow;
    if (!bench_flow_live(bench, &desc, true, &flow)) {
        bench_refuse(bench, "projection", methods[desc.method]);
        return NAN;
    }
    hair_fluid_place(&flow.fluid, &flow.now); // Start with the wind everywhere around the ball.
    hair_fluid_advect(&flow.fluid);
    struct bench_times times = time_part(&flow, solve);
    double left = bench_flow_residual(&flow);
    json_t* row = new_row(bench, "projection", methods[desc.method], desc.cells);
    bench_set_number(row, "relax", (double)desc.relax);
    bench_set_count(row, "iterations", desc.cycles);
    bench_set_number(row, "divergence", left);
    set_times(row, &times);
    bench_flow_die(&flow);
    if (left <= WANTED && (best->ms == 0 || times.ms < best->ms))
        *best = (struct best){times.ms, (double)desc.relax, desc.cycles};
    *passed += times.ms;
    return left;
}

static void sweep(struct bench* bench, hair_fluid_method method, uint32_t cells, struct best* best)
{
    static const float relax[][5] = {{1, 1.1f, 1.15f, 1.2f, 0}, {1.75f, 1.8f, 1.85f, 1.9f, 0}, {0.9f, 1, 0}};
    double passed = 0;
    for (const float* r = relax[method]; *r > 0; ++r) {
        // Increase the number of iterations in proportion to itself until the divergence is small
        // enough.
        uint32_t count = method == HAIR_FLUID_MULTIGRID    ? 1
                         : method == HAIR_FLUID_RELAXATION ? cells / 2
                                                           : 8 * cells;
        for (double left = 1; left > 0.1 * WANTED && passed < MAX_FRUITLESS && !bench_was_interrupted();) {
            struct hair_fluid_desc desc = {
                .cells = cells, .side = FLOW_SIDE, .method = method, .cycles = count, .relax = *r};
            double was = left;
            left = run_projection(bench, desc, best, &passed);
            if (!(left <= was) || (left <= WANTED && method == HAIR_FLUID_JACOBI)) break;
            count += count > 4 ? count / 4 : 1;
        }
    }
}

static void run_projections(struct bench* bench)
{
    uint32_t cells = bench->options.quick ? 32 : 64;
    struct best best[3] = {{0}};
    for (int m = 2; m >= 0; --m)
        if (bench_begin(bench, "projection", methods[m])) sweep(bench, (hair_fluid_method)m, cells, &best[m]);
    if (!bench->planning) bench_mark_front(bench->rows.rows, "ms", "divergence");
    for (int m = 2; m >= 0; --m) {
        if (!bench_begin(bench, "projection to 1e-3", methods[m]) || best[m].ms == 0) continue;
        json_t* row = new_row(bench, "projection to 1e-3", methods[m], cells);
        bench_set_number(row, "relax", best[m].relax);
        bench_set_count(row, "iterations", best[m].iterations);
        bench_set_number(row, "ms", best[m].ms);
        if (best[2].ms > 0) bench_set_number(row, "to_jacobi", best[2].ms / best[m].ms);
    }
}

// Flows -------------------------------------------------------------------------------------------

// Measure the flow around the ball. Average over two seconds after half a second of start-up.
static bool measure_ball(struct bench_flow* flow, json_t* row)
{
    enum { BEFORE = 30, STEPS = 120 };
    double *mean = calloc(flow->faces, sizeof *mean), flux = 0, lee = 0;
    if (!mean) abort();
    for (int i = 0; i < BEFORE; ++i) bench_flow_step(flow);
    for (int i = 0; i < STEPS && !bench_was_interrupted(); ++i) {
        bench_flow_step(flow);
        double* velocity = bench_flow_velocity(flow);
        if (i % 10 == 0) flux = fmax(flux, fabs(bench_flow_flux(flow, velocity)));
        for (size_t k = 0; k < flow->faces; ++k) mean[k] += velocity[k] / (STEPS * FLOW_WIND);
        free(velocity);
    }
    for (int i = 0; i < 5; ++i) lee += fabs(bench_flow_beside(flow, mean, 1.5 + 0.25 * i, 0)) / 5;
    bench_set_number(row, "flux", flux);
    bench_set_number(row, "asymmetry",
                     fmax(bench_flow_asymmetry(flow, mean, 1), bench_flow_asymmetry(flow, mean, 2)));
    bench_set_number(row, "before", bench_flow_beside(flow, mean, -1.5, 0));
    bench_set_number(row, "beside", bench_flow_beside(flow, mean, 0, 1.5));
    bench_set_number(row, "behind", lee);
    bench_lee_compare(flow, mean);
    free(mean);
    return !bench_was_interrupted();
}

static bool measure_box(struct bench_flow* flow, json_t* row)
{
    size_t side = flow->fluid.desc.cells + 1, slots = side * side * side;
    double pi = 3.14159265358979, n = (double)flow->fluid.desc.cells;
    float* roll = calloc(flow->faces, sizeof *roll);
    if (!roll) abort();
    bench_flow_step(flow);
    for (size_t i = 0; i < slots; ++i) { // a vortex about z
        double x = (double)(i % side) / n, y = (double)(i / side % side) / n;
        int last = i % side == side - 1 || i / side % side == side - 1 || i / side / side == side - 1;
        if (i / side / side < side - 1 && i / side % side < side - 1)
            roll[i] = (float)(sin(pi * x) * cos(pi * (y + 0.5 / n)));
        if (!last || (i / side % side == side - 1 && i % side < side - 1 && i / side / side < side - 1))
            roll[i + slots] = (float)(-cos(pi * (x + 0.5 / n)) * sin(pi * y));
    }
    glNamedBufferSubData(flow->fluid.velocity[flow->fluid.now].buffer, 0,
                         (GLsizeiptr)(flow->faces * sizeof *roll), roll);
    free(roll);
    hair_fluid_publish(&flow->fluid);
    double* velocity = bench_flow_velocity(flow);
    double first = bench_flow_energy(velocity, flow->faces);
    free(velocity);
    for (int i = 0; i < 60; ++i) bench_flow_step(flow);
    velocity = bench_flow_velocity(flow);
    double max = 0;
    for (size_t i = 0; i < slots; ++i) // maximum velocity through the walls
        for (size_t axis = 0; axis < 3; ++axis) {
            size_t at[3] = {i % side, i / side % side, i / side / side};
            if (at[axis] == 0 || at[axis] == side - 1) max = fmax(max, fabs(velocity[axis * slots + i]));
        }
    bench_set_number(row, "energy", bench_flow_energy(velocity, flow->faces) / first);
    bench_set_number(row, "flux", max);
    free(velocity);
    return !bench_was_interrupted();
}

static void run_flows(struct bench* bench)
{
    for (uint32_t cells = 32; cells <= (bench->options.quick ? 32u : 64u); cells *= 2)
        for (int closed = 0; closed < 2; ++closed) {
            struct bench_flow flow;
            const char* name = closed ? "closed box, a second" : "past a ball";
            struct hair_fluid_desc desc = {
                .cells = cells, .side = FLOW_SIDE, .cycles = closed ? 6 : 4, .closed = closed};
            if (!bench_begin(bench, name, methods[0])) continue;
            if (!bench_flow_live(bench, &desc, !closed, &flow)) {
                bench_refuse(bench, name, methods[0]);
                continue;
            }
            if (closed) flow.now.wind = hair_v3(0, 0, 0);
            json_t* row = new_row(bench, name, methods[0], cells);
            if (closed)
                measure_box(&flow, row);
            else
                measure_ball(&flow, row);
            bench_flow_die(&flow);
        }
}

static void run_suite(struct bench* bench)
{
    run_parts(bench);
    run_projections(bench);
    run_flows(bench);
    bench_lee_cost(bench);
}

const struct bench_suite bench_wind = {
    "wind", "the fluid: projections, tuned, and flows whose shape is known", columns, run_suite};
