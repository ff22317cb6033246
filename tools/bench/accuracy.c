// accuracy.c - Suite `accuracy`, run time against error for every solver and setting.
#include "tests/reference/continuum.h"
#include "tools/bench/accuracy.h"
#include "tools/bench/live_scene.h"
#include "tools/bench/peers.h"
#include "tools/common/file.h"
#include "lib/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAME BENCH_MOTION_FRAME
#define MAX_SUBSTEPS 4096
// Maximum change of the reference when its substep is halved, as a fraction of the length.
#define TOLERANCE 1e-7

static const char* const columns[] = {"case",
                                      "method",
                                      "vertices",
                                      "length",
                                      "substeps",
                                      "iterations",
                                      "strands",
                                      "ms",
                                      "ms_min",
                                      "ms_max",
                                      "runs",
                                      "us_per_strand",
                                      "rms_error",
                                      "rms_mm",
                                      "max_error",
                                      "tip_error",
                                      "max_stretch",
                                      "alike",
                                      "reference",
                                      "front",
                                      "default",
                                      "measured_by",
                                      BENCH_MATERIAL_COLUMNS,
                                      NULL};

// A solver and its resolution. 0 substeps uses the solver's default.
struct setting {
    hair_solver solver;
    uint32_t substeps, iterations;
    bool quick;
};

static const struct setting settings[] = {
    {HAIR_SOLVER_REDBLACK, 0, 20, false}, {HAIR_SOLVER_FOLLOW, 0, 0, false},
    {HAIR_SOLVER_DIRECT, 0, 0, true},     {HAIR_SOLVER_REDBLACK, 1, 4, true},
    {HAIR_SOLVER_REDBLACK, 1, 20, true},  {HAIR_SOLVER_REDBLACK, 1, 100, false},
    {HAIR_SOLVER_FOLLOW, 1, 0, true},     {HAIR_SOLVER_FOLLOW, 2, 0, false},
    {HAIR_SOLVER_FOLLOW, 4, 0, false},    {HAIR_SOLVER_DIRECT, 2, 0, false},
    {HAIR_SOLVER_DIRECT, 3, 0, false},    {HAIR_SOLVER_DIRECT, 4, 0, true},
    {HAIR_SOLVER_DIRECT, 5, 0, false},    {HAIR_SOLVER_DIRECT, 6, 0, false},
    {HAIR_SOLVER_DIRECT, 8, 0, false},    {HAIR_SOLVER_DIRECT, 16, 0, false},
    {HAIR_SOLVER_ACCURATE, 0, 0, false},  {HAIR_SOLVER_ACCURATE, 16, 0, true},
    {HAIR_SOLVER_ACCURATE, 24, 0, false}, {HAIR_SOLVER_ACCURATE, 32, 0, false},
    {HAIR_SOLVER_ACCURATE, 48, 0, false}, {HAIR_SOLVER_ACCURATE, 64, 0, false},
};
#define SETTINGS (sizeof settings / sizeof *settings)

static bool bring_to_life(struct bench* bench, const struct bench_motion* motion,
                          struct bench_live_scene* out)
{
    if (!bench_live(bench, &motion->scene, out)) return false;
    if (!hair_set_colliders(out->hair, motion->colliders, motion->collider_count, sizeof *motion->colliders))
        return true;
    bench_free_live_scene(out);
    return false;
}

// Simulate one strand among colliders with the most accurate solver, because the reference has no
// colliders.
static bool run_finely(struct bench* bench, const struct bench_motion* motion, uint32_t substeps,
                       double* positions)
{
    struct bench_motion fine = *motion;
    struct bench_live_scene live;
    fine.scene.solver = HAIR_SOLVER_ACCURATE;
    fine.scene.strands = 1;
    fine.scene.substep = FRAME / substeps;
    if (!bring_to_life(bench, &fine, &live)) return false;
    bool whole = true;
    for (uint32_t k = 0; k < fine.frames && whole; ++k)
        whole = bench_step(&live, fine.moves ? fine.heads + k : NULL, FRAME) &&
                bench_read(&live, positions + (size_t)k * 3 * fine.scene.vertices);
    bench_free_live_scene(&live);
    return whole;
}

static bool find_truth_among_colliders(struct bench* bench, struct bench_motion* motion,
                                       struct bench_truth* truth)
{
    size_t count = (size_t)motion->frames * 3 * motion->scene.vertices;
    HAIR_ASSERT(count > 0);
    double* half = calloc(count, sizeof *half);
    double all = 0, worst = 0;
    bool whole = half != NULL;
    for (uint32_t run = 0; run < motion->runs && whole; ++run) {
        double *ground_truth = truth->positions + run * count, sum = 0;
        bench_set_place(motion, run);
        whole = run_finely(bench, motion, motion->fine_substeps / 2, half) &&
                run_finely(bench, motion, motion->fine_substeps, ground_truth);
        for (size_t i = 0; i < count && whole; ++i) sum += pow(ground_truth[i] - half[i], 2);
        all += sum;
        worst = fmax(worst, sum);
    }
    free(half);
    double scale = 3 / (double)count / (motion->length * motion->length);
    snprintf(truth->reference, sizeof truth->reference,
             "accurate, %u substeps, rms %.1e from half as many, at worst %.1e", motion->fine_substeps,
             sqrt(scale * all / motion->runs), sqrt(scale * worst));
    return whole;
}

static bool find_truth_by_reference(const struct bench_motion* motion, struct bench_truth* truth)
{
    struct hair_reference_rod* rod = bench_reference(&motion->scene);
    if (!rod) return false;
    struct hair_reference_rod_report report =
        hair_reference_rod_converge(rod, motion->frames, motion->moves ? motion->heads : NULL, FRAME, 128,
                                    MAX_SUBSTEPS, TOLERANCE * motion->length, truth->positions);
    hair_reference_rod_destroy(rod);
    snprintf(truth->reference, sizeof truth->reference, "rod, double, %u substeps, converged to %.1e",
             report.substeps, report.change / motion->length);
    return isfinite(report.change);
}

// Return which solution has the energy of the solver. Not all solvers have the same.
static size_t truth_of(const struct bench_motion* motion)
{
    return !motion->collider_count && bench_has_chord_energy(&motion->scene);
}

static bool find_truth(struct bench* bench, struct bench_motion* motion)
{
    struct bench_truth* truth = motion->truth + truth_of(motion);
    if (truth->positions) return true;
    size_t count = (size_t)motion->runs * motion->frames * 3 * motion->scene.vertices;
    HAIR_ASSERT(count > 0);
    double* positions = malloc(count * sizeof *positions);
    if (!positions) return false;
    truth->positions = positions;
    if (motion->collider_count ? find_truth_among_colliders(bench, motion, truth)
                               : find_truth_by_reference(motion, truth))
        return true;
    // An incomplete reference must not be taken for a complete one by the next setting.
    free(positions);
    truth->positions = NULL;
    return false;
}

struct error {
    double squares, stretch;
    double farthest; // maximum over vertices at the ends of frames, m
};

// Simulate all frames and accumulate the errors against the truth.
static bool run_frames(struct bench_live_scene* live, const struct bench_motion* motion,
                       const double* ground_truth, struct error* out)
{
    uint32_t size = 3 * motion->scene.vertices;
    double positions[3 * BENCH_MAX_VERTICES];
    for (uint32_t k = 0; k < motion->frames; ++k, ground_truth += size) {
        if (!bench_step(live, motion->moves ? motion->heads + k : NULL, FRAME)) return false;
        if (!bench_read(live, positions)) return false;
        double stretch = bench_stretch(live, positions);
        for (uint32_t i = 0; i < size; i += 3) {
            double square = pow(positions[i] - ground_truth[i], 2) +
                            pow(positions[i + 1] - ground_truth[i + 1], 2) +
                            pow(positions[i + 2] - ground_truth[i + 2], 2);
            out->squares += square;
            if (!(sqrt(square) <= out->farthest)) out->farthest = sqrt(square);
        }
        if (!(stretch <= out->stretch)) out->stretch = stretch;
    }
    return true;
}

// Simulate all runs. The first run is last, because it is the one that is timed.
static bool run_all(struct bench_live_scene* live, struct bench_motion* motion, struct error* out)
{
    size_t count = (size_t)motion->frames * 3 * motion->scene.vertices;
    const double* truth = motion->truth[truth_of(motion)].positions;
    bool whole = true;
    *out = (struct error){0};
    for (uint32_t run = motion->runs; run-- > 0 && whole;) {
        if (motion->collider_count) bench_set_place(motion, run);
        whole = bench_restart(live) &&
                !hair_set_colliders(live->hair, motion->colliders, motion->collider_count,
                                    sizeof *motion->colliders) &&
                run_frames(live, motion, truth + run * count, out);
    }
    return whole;
}

static void add_row(const struct bench_motion* motion, struct bench_live_scene* live,
                    const struct error* error, const struct bench_times* times, const struct setting* setting)
{
    const struct bench_scene* scene = &motion->scene;
    double rms = sqrt(error->squares / motion->runs / motion->frames / scene->vertices);
    json_t* row = bench_rows_add(&live->bench->rows);
    bench_set_text(row, "case", motion->name);
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", scene->vertices);
    bench_set_number(row, "length", motion->length);
    bench_set_number(row, "substeps", bench_substeps(live));
    if (setting->iterations) bench_set_count(row, "iterations", setting->iterations);
    bench_set_count(row, "strands", scene->strands);
    bench_set_number(row, "ms", times->ms);
    bench_set_number(row, "ms_min", times->ms_min);
    bench_set_number(row, "ms_max", times->ms_max);
    bench_set_count(row, "runs", times->runs);
    bench_set_number(row, "us_per_strand", 1000 * times->ms / scene->strands);
    bench_set_number(row, "rms_error", rms / motion->length);
    bench_set_number(row, "max_error", error->farthest / motion->length);
    bench_set_number(row, "rms_mm", 1000 * rms);
    bench_set_number(row, "max_stretch", error->stretch);
    if (!setting->substeps) bench_set_flag(row, "default", true);
    bench_set_flag(row, "alike", bench_strands_are_alike(live));
    bench_set_text(row, "reference", motion->truth[truth_of(motion)].reference);
    bench_set_text(row, "measured_by", "here");
    bench_set_material(row, live);
}

// Set the solver's own substep, rounded such that it divides a frame. Strands are read at the end
// of the last substep.
static bool settle_substep(struct bench* bench, struct bench_motion* motion)
{
    struct bench_live_scene live;
    motion->scene.substep = 0;
    if (!bring_to_life(bench, motion, &live)) return false;
    // Colliders shorten the substep from the first step on.
    hair_solver_stats solver_stats = hair_solver_stats_default();
    if (bench_step(&live, NULL, FRAME) && !hair_get_solver_stats(live.hair, &solver_stats))
        live.substep = (double)solver_stats.substep;
    motion->scene.substep = FRAME / ceil(FRAME / live.substep - 1e-3);
    bench_free_live_scene(&live);
    return true;
}

static void measure(struct bench* bench, struct bench_motion* motion, const struct setting* setting)
{
    const char* method = bench_solver_name(setting->solver);
    if (!bench_begin(bench, motion->name, method)) return;
    struct bench_scene* scene = &motion->scene;
    struct bench_live_scene live;
    struct error error;
    struct bench_times times;
    scene->solver = setting->solver;
    scene->physics.redblack.iterations = setting->iterations ? setting->iterations : 1;
    scene->substep = setting->substeps ? FRAME / setting->substeps : 0;
    scene->mapping =
        setting->solver == HAIR_SOLVER_REDBLACK ? HAIR_THREAD_MAPPING_AUTO : bench->options.mapping;
    if ((!setting->substeps && !settle_substep(bench, motion)) || !bring_to_life(bench, motion, &live)) {
        bench_refuse(bench, motion->name, method);
        return;
    }
    if (find_truth(bench, motion) && run_all(&live, motion, &error) &&
        bench_time(&live, motion->frames, motion->moves ? motion->heads : NULL, FRAME, &times))
        add_row(motion, &live, &error, &times, setting);
    else
        bench_refuse(bench, motion->name, method);
    bench_free_live_scene(&live);
}

static void measure_all(struct bench* bench, struct bench_motion* motion)
{
    for (size_t i = 0; i < SETTINGS; ++i)
        if (settings[i].quick || !bench->options.quick) measure(bench, motion, &settings[i]);
    for (int k = 0; k < 2; ++k) free(motion->truth[k].positions);
}

// Real hair at rest -------------------------------------------------------------------------------

static void add_static_row(struct bench_live_scene* live, const double* positions)
{
    const struct bench_scene* scene = live->scene;
    struct bench_section section = bench_section_of(&scene->physics);
    double length = live->length;
    double gamma = section.line_density * BENCH_GRAVITY * pow(length, 3) / section.bend[0];
    struct hair_reference_elastica rest = hair_reference_elastica(gamma, 0, 0);
    const double* tip = positions + 3 * (scene->vertices - 1);
    double error = hypot(hypot(tip[0] / length - rest.across, tip[1] / length + rest.down), tip[2] / length);
    json_t* row = bench_rows_add(&live->bench->rows);
    bench_set_text(row, "case", "static");
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", scene->vertices);
    bench_set_number(row, "length", length);
    bench_set_number(row, "substeps", bench_substeps(live));
    if (scene->solver == HAIR_SOLVER_REDBLACK)
        bench_set_count(row, "iterations", scene->physics.redblack.iterations);
    bench_set_number(row, "tip_error", error);
    bench_set_number(row, "max_stretch", bench_stretch(live, positions));
    bench_set_text(row, "reference", "elastica");
    bench_set_text(row, "measured_by", "here");
    bench_set_material(row, live);
}

static void measure_static(struct bench* bench, hair_solver solver, double length)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "static", method)) return;
    double positions[3 * BENCH_MAX_VERTICES] = {0};
    const double root[3] = {0, 0, 0}, along[3] = {1, 0, 0};
    struct bench_live_scene live;
    struct bench_scene scene = bench_scene_default();
    bench_scene_straight(&scene, 32, length, root, along);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.fiber.youngs_modulus = 4e9f;
    scene.physics.fiber.radius = 4e-5f;
    scene.physics.fiber.density = 1300;
    scene.physics.damping = 10;
    if (solver == HAIR_SOLVER_REDBLACK) {
        scene.mapping = HAIR_THREAD_MAPPING_AUTO;
        scene.substep = FRAME;
    }
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, "static", method);
        return;
    }
    if (bench_settle(&live, positions))
        add_static_row(&live, positions);
    else
        bench_refuse(bench, "static", method);
    bench_free_live_scene(&live);
}

static void measure_straight(struct bench* bench)
{
    bool quick = bench->options.quick;
    struct bench_motion motion;
    for (uint32_t vertices = 16; vertices <= (quick ? 16 : 64); vertices *= 2) {
        bench_make_shake(bench, vertices, &motion);
        measure_all(bench, &motion);
    }
    bench_make_swing(bench, quick ? 16 : 32, &motion);
    measure_all(bench, &motion);
    bench_make_contact(bench, 32, &motion);
    if (!quick) measure_all(bench, &motion);
    bench_make_whip(bench, 32, &motion);
    if (!quick) measure_all(bench, &motion);
    bench_make_taut(bench, 64, &motion);
    if (!quick) measure_all(bench, &motion);
}

static void measure_curved(struct bench* bench)
{
    struct bench_motion motion;
    bench_make_wave(bench, &motion);
    measure_all(bench, &motion);
    bench_make_curl(bench, &motion);
    if (!bench->options.quick) measure_all(bench, &motion);
    bench_make_curl_contact(bench, &motion);
    if (!bench->options.quick) measure_all(bench, &motion);
    bench_make_coil(bench, &motion);
    if (!bench->options.quick) measure_all(bench, &motion);
}

static void run_suite(struct bench* bench)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    static const double lengths[] = {0.05, 0.1, 0.3};
    measure_straight(bench);
    measure_curved(bench);
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < (bench->options.quick ? 1 : 3); ++k)
            measure_static(bench, solvers[i], lengths[k]);
    if (bench->planning || json_array_size(bench->rows.rows) == 0) return;
    if (!bench->options.only_method) bench_add_peers(bench);
    bench_mark_front(bench->rows.rows, "ms", "rms_error");
}

const struct bench_suite bench_accuracy = {"accuracy", "run time against error, for every solver", columns,
                                           run_suite};
