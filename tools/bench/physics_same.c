// physics_same.c - The same hair at other frame rates and with other numbers of vertices. The rest
// position of the tip and the frequency of its swing must agree.
#include "tools/bench/frequency.h"
#include "tools/bench/physics.h"

#include <math.h>

#define LENGTH 0.1 // m
#define SECONDS 6
#define MAX_RATE 240 // Hz
#define NUDGE 1.02 // factor of gravity that starts the swing

struct seen {
    double sag; // H/W
    double frequency; // Hz
};

// Measure the sag and the swing. The strand comes to rest under slightly stronger gravity. Then
// gravity is restored, and damping is removed. The direction from the root to the tip oscillates.
static bool look(struct bench_live_scene* live, hair_physics physics, uint32_t rate, const double modes[2],
                 struct seen* out)
{
    double positions[3 * BENCH_MAX_VERTICES], samples[SECONDS * MAX_RATE], tip = 0;
    uint32_t last = 3 * (live->scene->vertices - 1), count = SECONDS * rate;
    physics.gravity[1] *= (float)NUDGE;
    // Part 0 measures the rest position, part 1 comes to rest under stronger gravity.
    for (int part = 0; part < 2; ++part) {
        if (part && hair_set_physics(live->hair, &physics)) return false;
        for (uint32_t k = 0; k < 4 * rate; ++k)
            if (!bench_step(live, NULL, 1.0 / rate)) return false;
        if (!bench_read(live, positions) || bench_was_interrupted()) return false;
        if (part == 0) out->sag = -positions[last + 1] / positions[last];
        if (part == 0) tip = atan2(positions[last + 1], positions[last]);
    }
    physics = live->scene->physics;
    physics.damping = 0;
    if (hair_set_physics(live->hair, &physics)) return false;
    for (uint32_t k = 0; k < count; ++k) {
        if (!bench_read(live, positions)) return false;
        samples[k] = atan2(positions[last + 1], positions[last]) - tip;
        if (!bench_step(live, NULL, 1.0 / rate)) return false;
    }
    out->frequency =
        bench_frequency(samples, count, 1.0 / rate, 0.8 * modes[0], 1.2 * modes[1]) / (2 * BENCH_PI);
    return true;
}

static void add_rows(struct bench_live_scene* live, const char* name, double gamma, uint32_t rate,
                     const struct seen* seen, const struct seen* standard, const char* const references[2])
{
    for (int i = 0; i < 2; ++i) {
        json_t* row = bench_physics_row(live, name, i ? standard->frequency : standard->sag,
                                        i ? seen->frequency : seen->sag, 0.01, references[i]);
        bench_set_number(row, "gamma", gamma);
        bench_set_number(row, "rate", rate);
        if (i) bench_set_count(row, "mode", 1);
    }
}

// Measure one variant. The first one measured sets `standard`, which the others are compared with.
static void measure(struct bench* bench, const char* name, hair_solver solver, double gamma,
                    uint32_t vertices, uint32_t rate, struct seen* standard, const char* const references[2])
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, name, method)) return;
    const double root[3] = {0, 0, 0}, along[3] = {1, 0, 0};
    struct bench_live_scene live;
    struct bench_scene scene = bench_scene_default();
    struct seen seen;
    double modes[2]; // in the plane and across it, in ascending order
    bench_scene_straight(&scene, vertices, LENGTH, root, along);
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    scene.physics.fiber.radius = 1e-4f;
    scene.physics.damping = 15;
    bench_scene_set_gamma(&scene, LENGTH, gamma);
    struct hair_reference_rod* rod = bench_reference(&scene);
    if (!rod || !hair_reference_rod_rest(rod).converged || hair_reference_rod_modes(rod, 2, modes) < 2 ||
        !bench_live(bench, &scene, &live)) {
        bench_refuse(bench, name, method);
        hair_reference_rod_destroy(rod);
        return;
    }
    if (look(&live, scene.physics, rate, modes, &seen)) {
        if (standard->sag == 0) *standard = seen;
        add_rows(&live, name, gamma, rate, &seen, standard, references);
    } else
        bench_refuse(bench, name, method);
    bench_free_live_scene(&live);
    hair_reference_rod_destroy(rod);
}

static const double gammas[] = {10, 50};

void bench_frame_rates(struct bench* bench)
{
    static const char* const references[] = {"H/W at 60 Hz", "swing at 60 Hz, Hz"};
    static const uint32_t rates[] = {60, 30, 120, 240};
    for (int s = 0; s < BENCH_RODS && !bench->options.quick; ++s)
        for (int g = 0; g < 2; ++g) {
            struct seen standard = {0, 0};
            for (int i = 0; i < 4; ++i)
                measure(bench, "frame_rate", bench_rod_solvers[s], gammas[g], 32, rates[i], &standard,
                        references);
        }
}

void bench_vertex_counts(struct bench* bench)
{
    static const char* const references[] = {"H/W of 64 vertices", "swing of 64 vertices, Hz"};
    static const uint32_t vertices[] = {64, 32, 16};
    for (int s = 0; s < BENCH_RODS && !bench->options.quick; ++s)
        for (int g = 0; g < 2; ++g) {
            struct seen standard = {0, 0};
            for (int i = 0; i < 3; ++i)
                measure(bench, "vertex_count", bench_rod_solvers[s], gammas[g], vertices[i], 60, &standard,
                        references);
        }
}
