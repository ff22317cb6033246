// accuracy.c - the suite `accuracy`: run time against error, for every solver and setting.
#include "lib/reference/continuum.h"
#include "tools/bench/living.h"
#include "tools/bench/peers.h"
#include "tools/common/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAME (1.0 / 60)
#define LENGTH 0.3 // m
#define MOST_FRAMES 60
#define MOST_SUBSTEPS 4096
#define FINE_SUBSTEPS 512
#define TOLERANCE 1e-7 // of the length: how far halving its substeps may move the reference

static const char* const columns[] = {"case",        "method",      "vertices",
                                      "length",      "substeps",    "iterations",
                                      "strands",     "ms",          "ms_min",
                                      "ms_max",      "runs",        "us_per_strand",
                                      "rms_error",   "rms_mm",      "tip_error",
                                      "max_stretch", "alike",       "reference",
                                      "front",       "measured_by", BENCH_MATERIAL_COLUMNS,
                                      NULL};

// A solver and how finely it is run; substeps 0: as it wants.
struct setting {
    hair_solver solver;
    uint32_t    substeps, iterations;
    bool        quick;
};

static const struct setting settings[] = {
    {HAIR_SOLVER_REDBLACK, 1, 4, true},    {HAIR_SOLVER_REDBLACK, 1, 20, true},
    {HAIR_SOLVER_REDBLACK, 1, 100, false}, {HAIR_SOLVER_FOLLOW, 1, 0, true},
    {HAIR_SOLVER_FOLLOW, 2, 0, false},     {HAIR_SOLVER_FOLLOW, 4, 0, false},
    {HAIR_SOLVER_DIRECT, 2, 0, false},     {HAIR_SOLVER_DIRECT, 3, 0, false},
    {HAIR_SOLVER_DIRECT, 4, 0, true},      {HAIR_SOLVER_DIRECT, 5, 0, false},
    {HAIR_SOLVER_DIRECT, 6, 0, false},     {HAIR_SOLVER_DIRECT, 8, 0, false},
    {HAIR_SOLVER_DIRECT, 16, 0, false},    {HAIR_SOLVER_ACCURATE, 0, 0, false},
    {HAIR_SOLVER_ACCURATE, 16, 0, true},   {HAIR_SOLVER_ACCURATE, 24, 0, false},
    {HAIR_SOLVER_ACCURATE, 32, 0, false},  {HAIR_SOLVER_ACCURATE, 48, 0, false},
    {HAIR_SOLVER_ACCURATE, 64, 0, false},
};
#define SETTINGS (sizeof settings / sizeof *settings)

// A scene in motion and what the reference makes of it.
struct motion {
    const char*                    name;
    struct bench_scene             scene;
    uint32_t                       frames;
    struct hair_reference_rod_pose heads[MOST_FRAMES];
    bool                           moves; // heads are in use
    hair_solid                     solids[2];
    uint32_t                       solid_count;
    uint32_t                       runs;  // the motion has: of contact one for each shoulder, else 1
    double*                        truth; // per run, frame and vertex; NULL: not found yet
    char                           reference[96];
};

static struct bench_scene make_scene(const struct bench* bench, uint32_t vertices, double clamp)
{
    struct bench_scene scene    = bench_scene_default();
    const double       root[3]  = {0.1, 0, 0}; // On a head of this radius.
    const double       along[3] = {cos(clamp), sin(clamp), 0};
    bench_scene_straight(&scene, vertices, LENGTH, root, along);
    scene.strands = bench->options.strands;
    if (!scene.strands) scene.strands = bench->options.quick ? 64 : 1000;
    scene.mapping = bench->options.mapping;
    return scene;
}

// The head yaws by 0.6 sin^2(pi t) while the strand, let go straight, falls.
static void make_shake(const struct bench* bench, uint32_t vertices, struct motion* out)
{
    *out               = (struct motion){.name = "shake", .frames = MOST_FRAMES, .moves = true, .runs = 1};
    out->scene         = make_scene(bench, vertices, -BENCH_PI / 6);
    hair_physics* p    = &out->scene.physics;
    p->damping         = 1;
    p->young           = 3e9f; // E R^2 / (4 rho) is 1.442308e-3 m^4/s^2.
    p->fiber_radius    = 5e-5f;
    p->fiber_density   = 1300;
    const double up[3] = {0, 1, 0}, none[3] = {0, 0, 0};
    for (uint32_t k = 0; k < out->frames; ++k) {
        double sine   = sin(BENCH_PI * (k + 1) * FRAME);
        out->heads[k] = bench_pose(up, 0.6 * sine * sine, none);
    }
}

// Where shoulders are, and how thick. One strand's luck makes its error half as large again or half as small: so there
// are several. Left out are those over which it may fall either way, so that the reference itself has not converged: its
// error, against half as many substeps, is below 1e-4 of the length for each of these. By 2 cm farther out or in than the
// first it is 2e-3 and 6e-4, by 2 cm out and up 6e-4, of a radius of 0.25 with the same top 3e-3.
static const struct {
    float x, y, radius; // m
} shoulders[] = {
    {0.2f, -0.45f, 0.2f},  {0.2f, -0.43f, 0.2f},  {0.2f, -0.47f, 0.2f},  {0.24f, -0.45f, 0.2f},
    {0.16f, -0.45f, 0.2f}, {0.18f, -0.43f, 0.2f}, {0.22f, -0.47f, 0.2f}, {0.18f, -0.47f, 0.2f},
    {0.2f, -0.35f, 0.1f},  {0.22f, -0.35f, 0.1f},
};
#define SHOULDERS (sizeof shoulders / sizeof *shoulders)

static void set_shoulder(struct motion* motion, uint32_t run)
{
    hair_solid* shoulder  = &motion->solids[1];
    shoulder->position[0] = shoulders[run].x;
    shoulder->position[1] = shoulders[run].y;
    shoulder->size[0]     = shoulders[run].radius;
}

// The same head as a sphere, and a shoulder, over which the strand falls and is drawn. (Against an upright body the tip
// strikes like a whip, and over a ridge along it a strand may fall either way: there any two runs go apart.)
static void make_contact(const struct bench* bench, uint32_t vertices, struct motion* out)
{
    make_shake(bench, vertices, out);
    hair_solid head = hair_solid_default(), shoulder = head;
    head.size[0]         = 0.095f;
    shoulder.shape       = HAIR_SHAPE_CAPSULE; // Its axis along z.
    shoulder.rotation[0] = shoulder.rotation[3] = (float)sqrt(0.5);
    shoulder.size[1]                            = 0.12f;
    out->name                                   = "contact";
    out->solids[0]                              = head;
    out->solids[1]                              = shoulder;
    out->solid_count                            = 2;
    out->runs                                   = SHOULDERS;
    set_shoulder(out, 0);
}

// A chain without bending, let go horizontal: the whip at 0.25 s is what separates solvers.
static void make_swing(const struct bench* bench, uint32_t vertices, struct motion* out)
{
    *out                     = (struct motion){.name = "swing", .frames = 24, .runs = 1};
    out->scene               = make_scene(bench, vertices, 0);
    out->scene.physics.young = 0;
    out->scene.physics.bend  = 0;
}

static bool bring_to_life(struct bench* bench, const struct motion* motion, struct bench_living* out)
{
    if (!bench_live(bench, &motion->scene, out)) return false;
    if (!hair_set_solids(out->hair, motion->solids, motion->solid_count, sizeof *motion->solids)) return true;
    bench_die(out);
    return false;
}

// One strand among solids, of which the reference knows nothing: by the solver with the least error.
static bool run_finely(struct bench* bench, const struct motion* motion, uint32_t substeps, double* positions)
{
    struct motion       fine = *motion;
    struct bench_living living;
    fine.scene.solver  = HAIR_SOLVER_ACCURATE;
    fine.scene.strands = 1;
    fine.scene.substep = FRAME / substeps;
    if (!bring_to_life(bench, &fine, &living)) return false;
    bool whole = true;
    for (uint32_t k = 0; k < fine.frames && whole; ++k)
        whole = bench_step(&living, fine.moves ? fine.heads + k : NULL, FRAME) &&
                bench_read(&living, positions + (size_t)k * 3 * fine.scene.vertices);
    bench_die(&living);
    return whole;
}

static bool find_truth_among_solids(struct bench* bench, struct motion* motion)
{
    size_t  count = (size_t)motion->frames * 3 * motion->scene.vertices;
    double* half  = malloc(count * sizeof *half);
    double  all = 0, worst = 0;
    bool    whole = half != NULL;
    for (uint32_t run = 0; run < motion->runs && whole; ++run) {
        double *truth = motion->truth + run * count, sum = 0;
        set_shoulder(motion, run);
        whole = run_finely(bench, motion, FINE_SUBSTEPS / 2, half) &&
                run_finely(bench, motion, FINE_SUBSTEPS, truth);
        for (size_t i = 0; i < count && whole; ++i) sum += pow(truth[i] - half[i], 2);
        all += sum;
        worst = fmax(worst, sum);
    }
    free(half);
    double scale = 3 / (double)count / (LENGTH * LENGTH);
    snprintf(motion->reference, sizeof motion->reference,
             "accurate, %d substeps, rms %.1e from half as many, at worst %.1e", FINE_SUBSTEPS,
             sqrt(scale * all / motion->runs), sqrt(scale * worst));
    return whole;
}

static bool find_truth(struct bench* bench, struct motion* motion)
{
    if (motion->truth) return true;
    size_t count  = (size_t)motion->runs * motion->frames * 3 * motion->scene.vertices;
    motion->truth = malloc(count * sizeof *motion->truth);
    if (motion->truth && motion->solid_count) return find_truth_among_solids(bench, motion);
    struct hair_reference_rod* rod = bench_reference(&motion->scene);
    if (!motion->truth || !rod) {
        hair_reference_rod_destroy(rod);
        return false;
    }
    struct hair_reference_rod_report report =
        hair_reference_rod_converge(rod, motion->frames, motion->moves ? motion->heads : NULL, FRAME, 128,
                                    MOST_SUBSTEPS, TOLERANCE * LENGTH, motion->truth);
    hair_reference_rod_destroy(rod);
    snprintf(motion->reference, sizeof motion->reference, "rod, double, %u substeps, converged to %.1e",
             report.substeps, report.change / LENGTH);
    return true;
}

struct error {
    double squares, stretch;
};

// All frames, against the truth.
static bool run_frames(struct bench_living* living, const struct motion* motion, const double* truth,
                       struct error* out)
{
    uint32_t size = 3 * motion->scene.vertices;
    double   positions[3 * BENCH_MOST_VERTICES];
    for (uint32_t k = 0; k < motion->frames; ++k, truth += size) {
        if (!bench_step(living, motion->moves ? motion->heads + k : NULL, FRAME)) return false;
        if (!bench_read(living, positions)) return false;
        double stretch = bench_stretch(living, positions);
        for (uint32_t i = 0; i < size; ++i) out->squares += pow(positions[i] - truth[i], 2);
        if (!(stretch <= out->stretch)) out->stretch = stretch;
    }
    return true;
}

// All runs, the first at last, so that it is the one to be timed.
static bool run_all(struct bench_living* living, struct motion* motion, struct error* out)
{
    size_t count = (size_t)motion->frames * 3 * motion->scene.vertices;
    bool   whole = true;
    *out         = (struct error){0};
    for (uint32_t run = motion->runs; run-- > 0 && whole;) {
        if (motion->solid_count) set_shoulder(motion, run);
        whole = bench_restart(living) &&
                !hair_set_solids(living->hair, motion->solids, motion->solid_count, sizeof *motion->solids) &&
                run_frames(living, motion, motion->truth + run * count, out);
    }
    return whole;
}

static void add_row(const struct motion* motion, struct bench_living* living, const struct error* error,
                    const struct bench_times* times, const struct setting* setting)
{
    const struct bench_scene* scene = &motion->scene;
    double                    rms   = sqrt(error->squares / motion->runs / motion->frames / scene->vertices);
    json_t*                   row   = bench_rows_add(&living->bench->rows);
    bench_set_text(row, "case", motion->name);
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", scene->vertices);
    bench_set_number(row, "length", LENGTH);
    bench_set_number(row, "substeps", bench_substeps(living));
    if (setting->iterations) bench_set_count(row, "iterations", setting->iterations);
    bench_set_count(row, "strands", scene->strands);
    bench_set_number(row, "ms", times->ms);
    bench_set_number(row, "ms_min", times->ms_min);
    bench_set_number(row, "ms_max", times->ms_max);
    bench_set_count(row, "runs", times->runs);
    bench_set_number(row, "us_per_strand", 1000 * times->ms / scene->strands);
    bench_set_number(row, "rms_error", rms / LENGTH);
    bench_set_number(row, "rms_mm", 1000 * rms);
    bench_set_number(row, "max_stretch", error->stretch);
    bench_set_flag(row, "alike", bench_strands_are_alike(living));
    bench_set_text(row, "reference", motion->reference);
    bench_set_text(row, "measured_by", "here");
    bench_set_material(row, living);
}

// What the solver wants, made to divide a frame: strands are read where the last substep left them.
static bool settle_substep(struct bench* bench, struct motion* motion)
{
    struct bench_living living;
    motion->scene.substep = 0;
    if (!bring_to_life(bench, motion, &living)) return false;
    hair_health health = hair_health_default(); // Among solids it is shorter from the first step on.
    if (bench_step(&living, NULL, FRAME) && !hair_get_health(living.hair, &health))
        living.substep = (double)health.substep;
    motion->scene.substep = FRAME / ceil(FRAME / living.substep - 1e-3);
    bench_die(&living);
    return true;
}

static void measure(struct bench* bench, struct motion* motion, const struct setting* setting)
{
    const char* method = bench_solver_name(setting->solver);
    if (!bench_begin(bench, motion->name, method)) return;
    struct bench_scene* scene = &motion->scene;
    struct bench_living living;
    struct error        error;
    struct bench_times  times;
    scene->solver             = setting->solver;
    scene->physics.iterations = setting->iterations ? setting->iterations : 1;
    scene->substep            = setting->substeps ? FRAME / setting->substeps : 0;
    scene->mapping = setting->solver == HAIR_SOLVER_REDBLACK ? HAIR_MAPPING_AUTO : bench->options.mapping;
    if ((!setting->substeps && !settle_substep(bench, motion)) || !bring_to_life(bench, motion, &living)) {
        bench_refuse(bench, motion->name, method);
        return;
    }
    if (find_truth(bench, motion) && run_all(&living, motion, &error) &&
        bench_time(&living, motion->frames, motion->moves ? motion->heads : NULL, FRAME, &times))
        add_row(motion, &living, &error, &times, setting);
    else
        bench_refuse(bench, motion->name, method);
    bench_die(&living);
}

static void measure_all(struct bench* bench, struct motion* motion)
{
    for (size_t i = 0; i < SETTINGS; ++i)
        if (settings[i].quick || !bench->options.quick) measure(bench, motion, &settings[i]);
    free(motion->truth);
}

// Real hair at rest -----------------------------------------------------------------------------------------

static void add_static_row(struct bench_living* living, const double* positions)
{
    const struct bench_scene* scene   = living->scene;
    struct bench_section      section = bench_section_of(&scene->physics);
    double                    length  = living->length;
    double                    gamma = section.line_density * BENCH_GRAVITY * pow(length, 3) / section.bend[0];
    struct hair_reference_elastica rest = hair_reference_elastica(gamma, 0, 0);
    const double*                  tip  = positions + 3 * (scene->vertices - 1);
    double  error = hypot(hypot(tip[0] / length - rest.across, tip[1] / length + rest.down), tip[2] / length);
    json_t* row   = bench_rows_add(&living->bench->rows);
    bench_set_text(row, "case", "static");
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", scene->vertices);
    bench_set_number(row, "length", length);
    bench_set_number(row, "substeps", bench_substeps(living));
    if (scene->solver == HAIR_SOLVER_REDBLACK) bench_set_count(row, "iterations", scene->physics.iterations);
    bench_set_number(row, "tip_error", error);
    bench_set_number(row, "max_stretch", bench_stretch(living, positions));
    bench_set_text(row, "reference", "elastica");
    bench_set_text(row, "measured_by", "here");
    bench_set_material(row, living);
}

static void measure_static(struct bench* bench, hair_solver solver, double length)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "static", method)) return;
    double              positions[3 * BENCH_MOST_VERTICES] = {0};
    const double        root[3] = {0, 0, 0}, along[3] = {1, 0, 0};
    struct bench_living living;
    struct bench_scene  scene = bench_scene_default();
    bench_scene_straight(&scene, 32, length, root, along);
    scene.solver                = solver;
    scene.mapping               = bench->options.mapping;
    scene.physics.young         = 4e9f;
    scene.physics.fiber_radius  = 4e-5f;
    scene.physics.fiber_density = 1300;
    scene.physics.damping       = 10;
    if (solver == HAIR_SOLVER_REDBLACK) {
        scene.mapping = HAIR_MAPPING_AUTO;
        scene.substep = FRAME;
    }
    if (!bench_live(bench, &scene, &living)) {
        bench_refuse(bench, "static", method);
        return;
    }
    if (bench_settle(&living, positions))
        add_static_row(&living, positions);
    else
        bench_refuse(bench, "static", method);
    bench_die(&living);
}

static void run_suite(struct bench* bench)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    static const double      lengths[] = {0.05, 0.1, 0.3};
    struct motion            motion;
    for (uint32_t vertices = 16; vertices <= (bench->options.quick ? 16 : 64); vertices *= 2) {
        make_shake(bench, vertices, &motion);
        measure_all(bench, &motion);
    }
    make_swing(bench, bench->options.quick ? 16 : 32, &motion);
    measure_all(bench, &motion);
    make_contact(bench, 32, &motion);
    if (!bench->options.quick) measure_all(bench, &motion);
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < (bench->options.quick ? 1 : 3); ++k)
            measure_static(bench, solvers[i], lengths[k]);
    if (bench->planning || json_array_size(bench->rows.rows) == 0) return;
    if (!bench->options.only_method) bench_add_peers(bench);
    bench_mark_front(bench->rows.rows, "ms", "rms_error");
}

const struct bench_suite bench_accuracy = {"accuracy", "run time against error, for every solver", columns,
                                           run_suite};
