// physics_spin.c - Hair on a head that spins steadily, and how far it trails.
#include "tools/bench/physics.h"

#include <math.h>

#define LENGTH 0.3 // m
#define ROOT 0.1 // distance of the root from the axis, m
#define RISE 2.0 // time until the head's speed is constant, s
#define STEADY 4.0 // time at constant speed, s
#define STEP (1.0 / 240)

static const double up[3] = {0, 1, 0}, none[3] = {0, 0, 0};

static double find_angle(double rate, double time)
{
    return 2 * BENCH_PI * rate * (time < RISE ? time * time / (2 * RISE) : time - RISE / 2);
}

static bool turn(struct bench_live_scene* live, struct hair_reference_rod* rod, double rate, double from,
                 double to, uint32_t substeps)
{
    for (double time = from + STEP; time < to + STEP / 2; time += STEP) {
        struct hair_reference_rod_pose head = bench_pose(up, find_angle(rate, time), none);
        if (live && !bench_step(live, &head, STEP)) return false;
        if (rod && !hair_reference_rod_advance(rod, &head, STEP, substeps)) return false;
        if (bench_was_interrupted()) return false;
    }
    return true;
}

// Compute the reference. The rod starts straight outwards and rotating with the head. It reaches
// its trailing shape within the damping time.
static bool find_truth(const struct bench_scene* scene, double rate, double* ground_truth)
{
    double start[3 * BENCH_MAX_VERTICES], velocities[3 * BENCH_MAX_VERTICES];
    struct bench_scene turned = *scene;
    double angle = find_angle(rate, RISE), spin = 2 * BENCH_PI * rate;
    turned.head = bench_pose(up, angle, none);
    struct hair_reference_rod* rod = bench_reference(&turned);
    if (!rod) return false;
    for (uint32_t i = 0; i < scene->vertices; ++i) {
        double far = (double)scene->positions[3 * i];
        start[3 * i] = far * cos(angle);
        start[3 * i + 1] = 0;
        start[3 * i + 2] = -far * sin(angle);
        velocities[3 * i] = -far * spin * sin(angle);
        velocities[3 * i + 1] = 0;
        velocities[3 * i + 2] = -far * spin * cos(angle);
    }
    hair_reference_rod_set_state(rod, start, velocities);
    double longest = hair_reference_rod_longest_substep(rod) / 2;
    uint32_t substeps = (uint32_t)fmax(8, ceil(STEP / longest));
    bool whole = turn(NULL, rod, rate, RISE, RISE + STEADY, substeps);
    hair_reference_rod_positions(rod, ground_truth);
    hair_reference_rod_destroy(rod);
    return whole;
}

static void add_row(struct bench_live_scene* live, double rate, double error)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    json_t* row = bench_physics_row(live, "head_spin", 0, error, 0.005,
                                    "rod in double precision, farthest over the length");
    bench_set_number(row, "rate", rate);
    if (hair_get_solver_stats(live->hair, &solver_stats)) return;
    uint64_t fallbacks = (uint64_t)solver_stats.euler_fallbacks + solver_stats.parts +
                         solver_stats.follow_fallbacks + solver_stats.reset;
    bench_set_count(row, "fallbacks", fallbacks);
    if (fallbacks > 0) bench_set_flag(row, "pass", false);
}

static void measure(struct bench* bench, hair_solver solver, uint32_t vertices, double rate)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "head_spin", method)) return;
    double ground_truth[3 * BENCH_MAX_VERTICES], now[3 * BENCH_MAX_VERTICES];
    struct bench_scene scene = bench_level_scene(bench, solver, vertices, ROOT, LENGTH);
    struct bench_live_scene live;
    if (!bench_live_in_step(bench, &scene, STEP, &live)) {
        bench_refuse(bench, "head_spin", method);
        return;
    }
    if (find_truth(&scene, rate, ground_truth) && turn(&live, NULL, rate, 0, RISE + STEADY, 0) &&
        bench_read(&live, now)) {
        add_row(&live, rate, bench_farthest(now, ground_truth, vertices) / LENGTH);
    } else
        bench_refuse(bench, "head_spin", method);
    bench_free_live_scene(&live);
}

void bench_head_spin(struct bench* bench)
{
    bool quick = bench->options.quick;
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t vertices = 32; vertices <= (quick ? 32 : 128); vertices *= 2)
            for (int rate = quick ? 3 : 1; rate <= (quick ? 3 : 6); ++rate)
                measure(bench, bench_rod_solvers[s], vertices, rate);
}
