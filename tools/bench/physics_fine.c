// physics_fine.c - Numerically hard cases, short segments and heavy tips.
#include "tests/reference/continuum.h"
#include "tools/bench/physics.h"
#include "tools/bench/rest.h"

#include <math.h>

// Short segments ----------------------------------------------------------------------------------

static void add_fine_row(struct bench_live_scene* live, const char* name, double gamma,
                         const double* positions)
{
    struct hair_reference_elastica rest = hair_reference_elastica(gamma, 0, 0);
    double length = live->length, across = rest.across, down = rest.down;
    const double* tip = positions + 3 * (live->scene->vertices - 1);
    double off = hypot(hypot(tip[0] / length - across, tip[1] / length + down), tip[2] / length);
    json_t* row = gamma < 0.1 ? bench_physics_row(live, name, down, -tip[1] / length, 0.005, "elastica, H/L")
                              : bench_physics_row(live, name, 0, off, 0.005, "elastica, off by over L");
    bench_set_number(row, "gamma", gamma);
}

static void measure_fine(struct bench* bench, hair_solver solver, uint32_t vertices, double length)
{
    const char *name = length < 0.02 ? "fur" : "fine_segments", *method = bench_solver_name(solver);
    if (!bench_begin(bench, name, method)) return;
    double positions[3 * BENCH_MAX_VERTICES];
    struct bench_live_scene live;
    struct bench_scene scene = bench_level_scene(bench, solver, vertices, 0, length);
    struct bench_section section = bench_section_of(&scene.physics);
    double gamma = section.line_density * BENCH_GRAVITY * pow(length, 3) / section.bend[0];
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, name, method);
        return;
    }
    if (bench_settle(&live, positions))
        add_fine_row(&live, name, gamma, positions);
    else
        bench_refuse(bench, name, method);
    bench_free_live_scene(&live);
}

void bench_fine_segments(struct bench* bench)
{
    const double length = 0.0631; // length in m that gives gamma 2 with default material
    bool quick = bench->options.quick;
    for (int s = 0; s < BENCH_RODS; ++s) {
        for (uint32_t vertices = 32; vertices <= (quick ? 32 : 256); vertices *= 2)
            measure_fine(bench, bench_rod_solvers[s], vertices, length);
        measure_fine(bench, bench_rod_solvers[s], 32, 0.01);
    }
}

// Heavy tips --------------------------------------------------------------------------------------

#define TIP_MASS 1000
#define TIP_LENGTH 0.1 // m

// Measure the chain with a heavy tip. The row's `speed` is the maximum vertex speed in the last
// half of 14 s.
static bool run_tip(struct bench_live_scene* live, const double* ground_truth, double gamma)
{
    struct bench_rest_desc desc = {14, 0.5, 14, bench_was_interrupted};
    uint32_t vertices = live->scene->vertices;
    double now[3 * BENCH_MAX_VERTICES];
    struct bench_rest rest;
    if (!bench_measure_rest(live->hair, 1, vertices, &desc, &rest) || !bench_read(live, now)) return false;
    json_t* row =
        bench_physics_row(live, "tip_mass", 0, bench_farthest(now, ground_truth, vertices) / live->length,
                          0.001, "statics of the same chain, farthest over the length");
    bench_set_number(row, "gamma", gamma);
    bench_set_number(row, "speed", rest.max_speed);
    if (rest.max_speed > 0.001) bench_set_flag(row, "pass", false);
    return true;
}

static void measure_tip(struct bench* bench, hair_solver solver, uint32_t vertices, double gamma)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "tip_mass", method)) return;
    double ground_truth[3 * BENCH_MAX_VERTICES];
    struct bench_live_scene live;
    struct bench_scene scene = bench_level_scene(bench, solver, vertices, 0, TIP_LENGTH);
    bench_scene_set_gamma(&scene, TIP_LENGTH, gamma);
    scene.physics.tip_mass = TIP_MASS;
    struct hair_reference_rod* rod = bench_reference(&scene);
    bool found = rod && hair_reference_rod_rest(rod).converged;
    if (found) hair_reference_rod_positions(rod, ground_truth);
    hair_reference_rod_destroy(rod);
    snprintf(bench->sentence, sizeof bench->sentence, "the reference does not come to rest");
    if (!found || !bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "tip_mass", method);
        return;
    }
    if (!run_tip(&live, ground_truth, gamma)) bench_refuse(bench, "tip_mass", method);
    bench_free_live_scene(&live);
}

void bench_tip_masses(struct bench* bench)
{
    static const double gammas[] = {2, 184, 3000};
    bool quick = bench->options.quick;
    for (int s = 0; s < BENCH_RODS; ++s)
        for (uint32_t vertices = quick ? 32 : 16; vertices <= 32; vertices *= 2)
            for (int k = 0; k < (quick ? 1 : 3); ++k)
                measure_tip(bench, bench_rod_solvers[s], vertices, gammas[k]);
}
