// stability.c - Suite `stability`, extreme demands on hair, and whether it survives them and
// recovers.
#include "tools/bench/stability.h"

#include <math.h>
#include <string.h>

#define FRAME (1.0 / 60)

static const char* const columns[] = {"case",
                                      "method",
                                      "vertices",
                                      "finite",
                                      "max_stretch",
                                      "max_speed",
                                      "max_penetration",
                                      "recovered",
                                      "seconds_to_recover",
                                      "euler_fallbacks",
                                      "follow_fallbacks",
                                      "reset",
                                      "parts",
                                      "gaining",
                                      "restless",
                                      "overstretched",
                                      "softest",
                                      "scenes",
                                      "worst_scene",
                                      "guides",
                                      "colliders",
                                      "radius",
                                      "vertices_per_turn",
                                      "root",
                                      "moving_fraction",
                                      "seconds_to_sleep",
                                      "max_energy",
                                      "limit",
                                      "pass",
                                      BENCH_MATERIAL_COLUMNS,
                                      NULL};

void bench_set_solver_stats(json_t* row, const hair_solver_stats* solver_stats)
{
    bench_set_count(row, "euler_fallbacks", solver_stats->euler_fallbacks);
    bench_set_count(row, "follow_fallbacks", solver_stats->follow_fallbacks);
    bench_set_count(row, "reset", solver_stats->reset);
    bench_set_count(row, "parts", solver_stats->parts);
    bench_set_count(row, "gaining", solver_stats->gaining);
    bench_set_count(row, "restless", solver_stats->restless);
    bench_set_count(row, "overstretched", solver_stats->overstretched);
    bench_set_number(row, "softest", (double)solver_stats->softest);
}

// Watching ----------------------------------------------------------------------------------------

static double distance(const double* a, const double* b)
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

// Return the maximum stretch beyond the resolution of floats. The resolution is half of the last
// place of both ends along each axis. It is added for positions in the world and for positions
// relative to the head's origin, which the solver uses. A strand with a free root can be far from
// that origin.
static double stretch_of(const struct bench_watch* watch, const double* positions)
{
    const struct bench_live_scene* live = watch->living;
    double max = 0, farthest[3] = {0}, none[3] = {0}, away = 0;
    for (uint32_t i = 0; i < 3 * live->scene->vertices; ++i)
        farthest[i % 3] = fmax(farthest[i % 3], fabs(positions[i]));
    for (uint32_t i = 0; i < live->scene->vertices; ++i)
        away = fmax(away, distance(positions + 3 * i, watch->head.position));
    double resolved = 1.2e-7 * (distance(farthest, none) + away);
    for (uint32_t i = 0; i + 1 < live->scene->vertices; ++i) {
        double off = fabs(distance(positions + 3 * i, positions + 3 * i + 3) - live->lengths[i]);
        max = fmax(max, (off - resolved) / live->lengths[i]);
    }
    return max;
}

// Return the maximum depth of vertices in spheres. Vertices that the scalp fixes are ignored.
static double depth_of(const struct bench_watch* watch, const double* positions)
{
    const struct bench_scene* scene = watch->living->scene;
    double max = 0;
    for (uint32_t s = 0; s < watch->collider_count; ++s) {
        const hair_collider* collider = &watch->colliders[s];
        const double centre[3] = {(double)collider->position[0], (double)collider->position[1],
                                  (double)collider->position[2]};
        for (uint32_t i = scene->solver == HAIR_SOLVER_REDBLACK ? 2 : 1; i < scene->vertices; ++i)
            max = fmax(max, (double)collider->size[0] - distance(positions + 3 * i, centre));
    }
    return max;
}

static void look(struct bench_watch* watch, const double* now, double passed)
{
    const struct bench_live_scene* live = watch->living;
    uint32_t count = live->scene->vertices;
    watch->finite = watch->finite && bench_are_finite(now, count);
    if (!watch->finite) return;
    watch->stretch = fmax(watch->stretch, stretch_of(watch, now));
    for (uint32_t i = 0; i < count && passed > 0; ++i)
        watch->speed = fmax(watch->speed, distance(now + 3 * i, watch->before + 3 * i) / passed);
    if (watch->spared <= 0) watch->penetration = fmax(watch->penetration, depth_of(watch, now));
}

bool bench_watch(struct bench_live_scene* live, struct bench_watch* out)
{
    *out = (struct bench_watch){
        .living = live, .calm = live->scene->physics, .head = live->scene->head, .finite = true};
    return bench_read(live, out->before);
}

bool bench_watch_step(struct bench_watch* watch, double dt)
{
    struct bench_live_scene* live = watch->living;
    double now[3 * BENCH_MAX_VERTICES];
    // Hair moves in whole substeps, therefore a speed uses the time of the completed substeps.
    double done = floor(watch->time / live->substep + 1e-4);
    if (hair_set_colliders(live->hair, watch->colliders, watch->collider_count, sizeof *watch->colliders))
        return false;
    if (!bench_step(live, &watch->head, dt) || !bench_read(live, now)) return false;
    watch->time += fmin(dt, live->scene->max_dt);
    watch->spared -= dt;
    watch->had_colliders = watch->had_colliders || watch->collider_count > 0;
    look(watch, now, (floor(watch->time / live->substep + 1e-4) - done) * live->substep);
    memcpy(watch->before, now, 3 * sizeof *now * live->scene->vertices);
    return !bench_was_interrupted();
}

json_t* bench_stability_row(struct bench_live_scene* live, const char* name, const struct bench_watch* watch)
{
    bool rod = live->scene->solver != HAIR_SOLVER_REDBLACK;
    json_t* row = bench_rows_add(&live->bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", bench_solver_name(live->scene->solver));
    bench_set_flag(row, "finite", watch->finite);
    bench_set_number(row, "max_stretch", watch->finite ? watch->stretch : NAN);
    bench_set_number(row, "max_speed", watch->finite ? watch->speed : NAN);
    if (watch->had_colliders) bench_set_number(row, "max_penetration", watch->penetration);
    bench_set_flag(row, "pass", watch->finite && (!rod || watch->stretch <= BENCH_MAX_STRETCH));
    bench_set_material(row, live);
    return row;
}

// Recovering --------------------------------------------------------------------------------------

// Compute the rod's rest positions in the world after the stress. Return false if they are unknown.
static bool find_rest(const struct bench_watch* watch, double* positions)
{
    struct bench_scene scene = *watch->living->scene;
    if (scene.solver == HAIR_SOLVER_REDBLACK) return false; // redblack has no material
    memcpy(scene.positions, watch->living->positions, sizeof scene.positions);
    scene.physics = watch->calm;
    scene.head = watch->head;
    struct hair_reference_rod* rod = bench_reference(&scene);
    if (!rod) return false;
    bool found = hair_reference_rod_rest(rod).converged;
    hair_reference_rod_positions(rod, positions);
    hair_reference_rod_destroy(rod);
    return found;
}

// Simulate six seconds without stress. `seconds` is the time after which all vertices stay within a
// hundredth of the length of their rest positions. It is infinite if they do not within that time.
static bool recover(struct bench_watch* watch, const double* rest, double* seconds)
{
    struct bench_live_scene* live = watch->living;
    watch->collider_count = 0;
    *seconds = 0;
    if (hair_set_physics(live->hair, &watch->calm) || hair_set_wind(live->hair, NULL)) return false;
    for (int k = 1; k <= 360; ++k) {
        if (!bench_watch_step(watch, FRAME)) return false;
        double max = 0;
        for (uint32_t i = 0; i < live->scene->vertices; ++i) {
            double off = distance(watch->before + 3 * i, rest + 3 * i);
            if (!(off <= max)) max = off;
        }
        if (!(max <= 0.01 * live->length)) *seconds = k < 360 ? (k + 1) * FRAME : INFINITY;
    }
    return true;
}

static void add_row(struct bench_watch* watch, const char* name, const double* rest)
{
    struct bench_live_scene* live = watch->living;
    hair_solver_stats solver_stats = hair_solver_stats_default();
    double seconds = NAN;
    if (hair_get_solver_stats(live->hair, &solver_stats) || (rest && !recover(watch, rest, &seconds))) {
        bench_refuse(live->bench, name, bench_solver_name(live->scene->solver));
        return;
    }
    json_t* row = bench_stability_row(live, name, watch);
    bench_set_count(row, "vertices", live->scene->vertices);
    bench_set_solver_stats(row, &solver_stats);
    if (!rest) return;
    bool recovered = seconds <= 3;
    bench_set_flag(row, "recovered", recovered);
    bench_set_number(row, "seconds_to_recover", seconds);
    if (!recovered) bench_set_flag(row, "pass", false);
}

static struct bench_scene make_scene(const struct bench* bench, hair_solver solver)
{
    const double root[3] = {0.1, 0, 0}, along[3] = {cos(BENCH_PI / 6), -sin(BENCH_PI / 6), 0};
    struct bench_scene scene = bench_scene_default();
    bench_scene_straight(&scene, 32, 0.3, root, along);
    scene.solver = solver;
    scene.mapping = solver == HAIR_SOLVER_REDBLACK ? HAIR_THREAD_MAPPING_AUTO : bench->options.mapping;
    scene.substep = solver == HAIR_SOLVER_REDBLACK ? FRAME : 0;
    scene.physics.damping = 4;
    scene.physics.collision.margin = 0.001f;
    scene.physics.fiber.youngs_modulus = 3e9f;
    scene.physics.fiber.radius = 5e-5f;
    return scene;
}

static void measure(struct bench* bench, const struct bench_stress* stress, hair_solver solver)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, stress->name, method)) return;
    double rest[3 * BENCH_MAX_VERTICES];
    struct bench_scene scene = make_scene(bench, solver);
    struct bench_live_scene live;
    struct bench_watch watch;
    if (stress->prepare) stress->prepare(&scene);
    if (!bench_live(bench, &scene, &live)) {
        bench_refuse(bench, stress->name, method);
        return;
    }
    if (bench_watch(&live, &watch) && stress->run(&watch))
        add_row(&watch, stress->name, find_rest(&watch, rest) ? rest : NULL);
    else
        bench_refuse(bench, stress->name, method);
    bench_free_live_scene(&live);
}

static void run_suite(struct bench* bench)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    for (const struct bench_stress* stress = bench_stresses; stress->name; ++stress)
        for (int s = 0; s < (stress->rods ? 3 : 4); ++s) measure(bench, stress, solvers[s]);
    bench_rest_haircuts(bench);
    bench_rest_curls(bench);
    bench_rest_contacts(bench);
    bench_fuzz(bench);
}

const struct bench_suite bench_stability = {
    "stability", "what no scene should ask of hair, and whether it bears it", columns, run_suite};
