// stability_curl.c - Cases `rest curl RADIUS`, coils in their rest shape without gravity that are
// disturbed briefly.
#include "tools/bench/coil.h"
#include "tools/bench/stability.h"

#include <math.h>
#include <string.h>

#define TURNS 5
#define SECONDS 10.0
#define NUDGE 0.05 // s
#define NUDGE_GRAVITY 0.2f // m/s^2, gives 10 mm/s at the end, soft coils recover slowly from more
#define MAX_ENERGY 1.01

struct curl {
    struct bench_live_scene living;
    struct hair_reference_rod* rod; // NULL for follow and redblack, which have no energy
    hair_physics calm;
    double time;
    double start; // energy after the nudge, J
    double max_energy; // J
    double max_speed; // in the last half second, m/s
    double at[3][3 * BENCH_MAX_VERTICES];
    bool finite;
};

// Return the energy without that of the centre of mass, whose motion is free for a free coil.
static double find_energy(struct curl* curl, double h)
{
    uint32_t vertices = curl->living.scene->vertices;
    double velocities[3 * BENCH_MAX_VERTICES], masses[BENCH_MAX_VERTICES], momentum[3] = {0}, mass = 0;
    for (uint32_t i = 0; i < 3 * vertices; ++i) velocities[i] = (curl->at[2][i] - curl->at[0][i]) / (2 * h);
    hair_reference_rod_set_state(curl->rod, curl->at[1], velocities);
    hair_reference_rod_masses(curl->rod, masses);
    struct hair_reference_rod_energy energy = hair_reference_rod_energy_of(curl->rod);
    for (uint32_t i = 0; i < vertices; ++i) mass += masses[i];
    for (uint32_t i = 0; i < 3 * vertices; ++i) momentum[i % 3] += masses[i / 3] * velocities[i];
    double squares = pow(momentum[0], 2) + pow(momentum[1], 2) + pow(momentum[2], 2);
    bool is_free = curl->living.scene->physics.root == HAIR_ROOT_FREE;
    return energy.kinetic + energy.elastic - (is_free ? squares / (2 * mass) : 0);
}

static double find_speed(const struct curl* curl, double h)
{
    double max = 0;
    for (uint32_t i = 0; i < curl->living.scene->vertices; ++i) {
        double squares = 0;
        for (uint32_t k = 3 * i; k < 3 * i + 3; ++k) squares += pow(curl->at[2][k] - curl->at[1][k], 2);
        double speed = sqrt(squares) / h;
        if (!(speed <= max)) max = speed;
    }
    return max;
}

// Simulate a frame. Read the positions after its last three substeps.
static bool step_frame(struct curl* curl)
{
    struct bench_live_scene* live = &curl->living;
    double h = live->substep, count = fmax(round(1 / (60 * h)), 2);
    if (!bench_step(live, NULL, (count - 2) * h) || !bench_read(live, curl->at[0])) return false;
    for (int k = 1; k < 3; ++k)
        if (!bench_step(live, NULL, h) || !bench_read(live, curl->at[k])) return false;
    curl->time += count * h;
    for (int k = 0; k < 3; ++k)
        curl->finite = curl->finite && bench_are_finite(curl->at[k], live->scene->vertices);
    return !bench_was_interrupted();
}

static bool nudge(struct curl* curl)
{
    struct bench_live_scene* live = &curl->living;
    hair_physics push = curl->calm;
    push.root = HAIR_ROOT_CLAMPED; // a free coil would only fall
    push.gravity[0] = push.gravity[2] = NUDGE_GRAVITY;
    double h = live->substep, count = ceil(NUDGE / h);
    return !hair_set_physics(live->hair, &push) && bench_step(live, &live->scene->head, count * h) &&
           !hair_set_physics(live->hair, &curl->calm) && bench_step(live, &live->scene->head, h);
}

static bool run(struct curl* curl)
{
    if (!nudge(curl)) return false;
    for (bool first = true; curl->time < SECONDS && curl->finite; first = false) {
        if (!step_frame(curl)) return false;
        if (!curl->finite) break;
        double energy = curl->rod ? find_energy(curl, curl->living.substep) : 0;
        if (first) curl->start = energy;
        curl->max_energy = fmax(curl->max_energy, energy);
        if (curl->time > SECONDS - 0.5)
            curl->max_speed = fmax(curl->max_speed, find_speed(curl, curl->living.substep));
    }
    return true;
}

static void add_row(struct curl* curl, const char* name, double radius, uint32_t each)
{
    static const char* const roots[] = {"clamped", "hinged", "free"};
    struct bench_live_scene* live = &curl->living;
    const struct bench_scene* scene = live->scene;
    hair_solver_stats solver_stats = hair_solver_stats_default();
    json_t* row = bench_rows_add(&live->bench->rows);
    bool damped = scene->physics.damping > 0, pass = curl->finite;
    double ratio = curl->max_energy / curl->start;
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", scene->vertices);
    bench_set_flag(row, "finite", curl->finite);
    bench_set_number(row, "radius", radius);
    bench_set_count(row, "vertices_per_turn", each);
    bench_set_text(row, "root", roots[scene->physics.root]);
    bench_set_number(row, "max_speed", curl->finite ? curl->max_speed : NAN);
    if (curl->rod) bench_set_number(row, "max_energy", curl->finite ? ratio : NAN);
    if (curl->rod) pass = pass && ratio <= MAX_ENERGY;
    if (damped) bench_set_number(row, "limit", bench_rest_limit(scene->solver));
    if (damped) pass = pass && curl->max_speed <= bench_rest_limit(scene->solver);
    bench_set_flag(row, "pass", pass);
    if (!hair_get_solver_stats(live->hair, &solver_stats)) { bench_set_solver_stats(row, &solver_stats); }
    bench_set_material(row, live);
}

static struct bench_scene make_scene(const struct bench* bench, hair_solver solver, double radius,
                                     uint32_t each)
{
    struct bench_coil coil = {radius, 4 * radius, TURNS, TURNS * each + 1};
    struct bench_scene scene = bench_scene_default();
    bench_scene_coil(&scene, &coil);
    scene.solver = solver;
    scene.mapping = solver == HAIR_SOLVER_REDBLACK ? HAIR_THREAD_MAPPING_AUTO : bench->options.mapping;
    scene.physics.gravity[1] = 0;
    if (solver == HAIR_SOLVER_REDBLACK)
        scene.physics.redblack.angular_hz = hair_physics_default().redblack.angular_hz;
    return scene;
}

static void measure(struct bench* bench, double radius, uint32_t each, hair_solver solver, int variant)
{
    char name[32];
    const char* method = bench_solver_name(solver);
    snprintf(name, sizeof name, "rest curl %g", 1000 * radius);
    if (!bench_begin(bench, name, method)) return;
    struct curl curl = {.finite = true};
    struct bench_scene scene = make_scene(bench, solver, radius, each);
    scene.physics.root = variant % 2 ? HAIR_ROOT_FREE : HAIR_ROOT_CLAMPED;
    scene.physics.damping = variant / 2 ? 4 : 0;
    curl.calm = scene.physics;
    if (!bench_live(bench, &scene, &curl.living)) {
        bench_refuse(bench, name, method);
        return;
    }
    if (bench_rest_must_sleep(solver)) curl.rod = bench_reference(&scene);
    if (run(&curl))
        add_row(&curl, name, radius, each);
    else
        bench_refuse(bench, name, method);
    hair_reference_rod_destroy(curl.rod);
    bench_free_live_scene(&curl.living);
}

void bench_rest_curls(struct bench* bench)
{
    static const double radii[] = {0.002, 0.003, 0.0045, 0.006, 0.008, 0.012, 0.02};
    static const uint32_t each[] = {6, 12, 20};
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    bool quick = bench->options.quick;
    for (size_t r = quick ? 3 : 0; r < (quick ? 4 : sizeof radii / sizeof *radii); ++r)
        for (int s = 0; s < 4; ++s)
            for (int k = quick ? 1 : 0; k < (quick ? 2 : 3); ++k)
                // Skip free roots of redblack, which always fixes its root.
                for (int variant = 0; variant < (quick ? 1 : 4); ++variant)
                    if (solvers[s] != HAIR_SOLVER_REDBLACK || variant % 2 == 0)
                        measure(bench, radii[r], each[k], solvers[s], variant);
}
