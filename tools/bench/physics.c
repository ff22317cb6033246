// physics.c - Suite `physics`, hair at rest and in motion against known results for rods and
// chains.
#include "tools/bench/physics.h"

#include <math.h>

static const char* const columns[] = {
    "case",     "method",    "vertices",  "gamma",     "angle",    "mode",
    "reynolds", "rate",      "substeps",  "expected",  "measured", "relative_error",
    "limit",    "pass",      "reference", "friction",  "load",     "creep",
    "speed",    "fallbacks", "peak",      "still_air", "drag",     BENCH_MATERIAL_COLUMNS,
    NULL};

const hair_solver bench_rod_solvers[BENCH_RODS] = {HAIR_SOLVER_ACCURATE, HAIR_SOLVER_DIRECT};

json_t* bench_physics_row(struct bench_live_scene* live, const char* name, double expected, double measured,
                          double limit, const char* reference)
{
    double error = expected == 0 ? fabs(measured) : fabs(measured / expected - 1);
    json_t* row = bench_rows_add(&live->bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", bench_solver_name(live->scene->solver));
    bench_set_count(row, "vertices", live->scene->vertices);
    bench_set_number(row, "expected", expected);
    bench_set_number(row, "measured", measured);
    bench_set_number(row, "relative_error", error);
    if (limit >= 0) bench_set_number(row, "limit", limit);
    if (limit >= 0) bench_set_flag(row, "pass", error <= limit);
    bench_set_text(row, "reference", reference);
    bench_set_material(row, live);
    return row;
}

bool bench_live_in_step(struct bench* bench, struct bench_scene* scene, double dt,
                        struct bench_live_scene* out)
{
    if (!bench_live(bench, scene, out)) return false;
    double count = dt / out->substep;
    if (fabs(count - round(count)) < 1e-3) return true;
    bench_free_live_scene(out);
    scene->substep = dt / ceil(count);
    return bench_live(bench, scene, out);
}

struct bench_scene bench_level_scene(const struct bench* bench, hair_solver solver, uint32_t vertices,
                                     double root, double length)
{
    const double at[3] = {root, 0, 0}, along[3] = {1, 0, 0};
    struct bench_scene scene = bench_scene_default();
    bench_scene_straight(&scene, vertices, length, at, along);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.damping = 4;
    return scene;
}

double bench_farthest(const double* a, const double* b, uint32_t vertices)
{
    double max = 0;
    for (uint32_t i = 0; i < 3 * vertices; i += 3) {
        double off = hypot(hypot(a[i] - b[i], a[i + 1] - b[i + 1]), a[i + 2] - b[i + 2]);
        if (off > max || isnan(off)) max = off;
    }
    return max;
}

static void run_suite(struct bench* bench)
{
    bench_cantilever(bench);
    bench_catenary(bench);
    bench_bend_twist(bench);
    bench_lateral_buckling(bench);
    bench_chain_modes(bench);
    bench_pendulums(bench);
    bench_order(bench);
    bench_energy(bench);
    bench_frame_rates(bench);
    bench_vertex_counts(bench);
    bench_drag(bench);
    bench_still_air(bench);
    bench_whip_energy(bench);
    bench_free_bodies(bench);
    bench_head_spin(bench);
    bench_capstan(bench);
    bench_tip_masses(bench);
    bench_fine_segments(bench);
}

const struct bench_suite bench_physics = {"physics", "hair against what is known of rods and chains", columns,
                                          run_suite};
