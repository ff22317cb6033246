// stability_fuzz.c - Reproducible random scenes, with any shape, setting and motion that the
// library accepts. Strands must stay finite and unstretched.
#include "tools/bench/stability.h"
#include "tools/common/file.h"

#include <math.h>
#include <string.h>

#define SEED 20100601u
#define MIN_VERTICES 17 // minimum number of colliders in a group, large enough for a grid lookup

// SplitMix64 (Steele, Lea, Flood 2014).
static uint64_t draw(uint64_t* state)
{
    uint64_t x = *state += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static double even(uint64_t* state, double low, double high)
{
    return low + (high - low) * (double)(draw(state) >> 11) * 0x1p-53;
}

static uint32_t one_of(uint64_t* state, uint32_t count)
{
    return (uint32_t)(draw(state) % count);
}

// Return a random value, mostly near the usual one, sometimes an extreme, sometimes log-uniform
// over the range.
static float any(uint64_t* state, double usual, double min, double max)
{
    double low = fmax(min, 1e-6 * max);
    switch (one_of(state, 8)) {
    case 0: return (float)min;
    case 1: return (float)max;
    case 2:
    case 3: return (float)fmin(fmax(exp(even(state, log(low), log(max))), min), max);
    default: return (float)fmin(fmax(usual * exp(even(state, -0.7, 0.7)), min), max);
    }
}

static void any_direction(uint64_t* state, double out[3])
{
    double y = even(state, -1, 1), angle = even(state, 0, 2 * BENCH_PI), ring = sqrt(1 - y * y);
    out[0] = ring * cos(angle);
    out[1] = y;
    out[2] = ring * sin(angle);
}

static void any_vector(uint64_t* state, double longest, float out[3])
{
    double direction[3], length = one_of(state, 3) ? longest * even(state, 0, 0.02) : even(state, 0, longest);
    any_direction(state, direction);
    for (int k = 0; k < 3; ++k) out[k] = (float)(length * direction[k]);
}

static void any_physics(uint64_t* state, hair_physics* p, hair_wind* wind)
{
    p->damping = any(state, 4, 0, 1000);
    p->shape.frequency_root = any(state, 4, 0, 30);
    p->shape.frequency_tip = any(state, 1, 0, 30);
    p->redblack.angular_hz = any(state, 8, 0, 30);
    p->redblack.bend = any(state, 0.1, 0, 1);
    p->redblack.iterations = 1 + one_of(state, 30);
    p->collision.margin = any(state, 0.001, 0, 0.1);
    p->fiber.youngs_modulus = any(state, 4e9, 0, 1e12);
    p->fiber.poisson_ratio = any(state, 0.45, 0, 0.5);
    p->fiber.radius = any(state, 4e-5, 1e-6, 1e-3);
    p->fiber.density = any(state, 1300, 1, 1e5);
    p->fiber.flatness = any(state, 0.8, 0.03, 1);
    p->shape.stiffness_root = any(state, 1, 0, 1e4);
    p->shape.stiffness_tip = any(state, 1, 0, 1e4);
    p->shape.gravity_preload = any(state, 1, 0, 1);
    p->root = one_of(state, 4) ? HAIR_ROOT_CLAMPED : (hair_root)one_of(state, 3);
    p->tip_mass = one_of(state, 3) ? 0 : any(state, 1, 0, 1e4);
    p->collision.friction = any(state, 0.3, 0, 10);
    any_vector(state, 1000, p->gravity);
    any_vector(state, 1000, wind->velocity);
    if (one_of(state, 2)) {
        p->gravity[0] = p->gravity[2] = 0;
        p->gravity[1] = -9.81f;
        *wind = hair_wind_default();
    }
}

// Make a strand that is straight, curled, or changes direction at every vertex, with even or uneven
// spacing.
static void any_strand(uint64_t* state, struct bench_scene* scene)
{
    static const uint32_t counts[] = {2, 3, 4, 8, 16, 31, 32, 33, 64, 128, 256};
    double length = exp(even(state, log(0.005), log(1))), curl = one_of(state, 3) ? 0 : even(state, 0, 60);
    double jag = one_of(state, 3) ? 0 : even(state, 0, 2), uneven = one_of(state, 3) ? 0 : even(state, 0, 3);
    double along[3], across[3], at[3] = {even(state, -0.1, 0.1), even(state, -0.1, 0.1), 0.1};
    scene->vertices = counts[one_of(state, one_of(state, 4) ? 8 : 11)];
    any_direction(state, along);
    any_direction(state, across);
    for (uint32_t i = 0; i < scene->vertices; ++i) {
        double other[3], d[3], norm = 0, t = (double)i / scene->vertices;
        double piece = length / scene->vertices * exp(even(state, -uneven, uneven));
        any_direction(state, other);
        for (int k = 0; k < 3; ++k) {
            scene->positions[3 * i + (uint32_t)k] = (float)at[k];
            d[k] = along[k] + sin(curl * t) * across[k] + jag * other[k];
            norm += d[k] * d[k];
        }
        for (int k = 0; k < 3; ++k) at[k] += piece * d[k] / sqrt(norm + 1e-12);
    }
}

static struct bench_scene any_scene(uint64_t* state, const struct bench* bench, hair_solver solver)
{
    struct bench_scene scene = bench_scene_default();
    any_strand(state, &scene);
    any_physics(state, &scene.physics, &scene.wind);
    scene.strands = 1 + one_of(state, 4);
    scene.solver = solver;
    scene.mapping = solver == HAIR_SOLVER_REDBLACK ? HAIR_THREAD_MAPPING_AUTO : bench->options.mapping;
    scene.substep = one_of(state, 3) ? 0 : exp(even(state, log(3e-4), log(0.1)));
    scene.max_dt = one_of(state, 8) ? 0.1 : 1;
    return scene;
}

static hair_collider any_collider(uint64_t* state)
{
    double axis[3], angle = even(state, 0, BENCH_PI);
    hair_collider collider = hair_collider_default();
    collider.shape = one_of(state, 2) ? HAIR_SHAPE_SPHERE : HAIR_SHAPE_CAPSULE;
    any_direction(state, axis);
    for (int k = 0; k < 3; ++k) {
        collider.position[k] = (float)even(state, -0.3, 0.3);
        collider.rotation[k] = (float)(sin(angle / 2) * axis[k]);
    }
    collider.rotation[3] = (float)cos(angle / 2);
    collider.size[0] = any(state, 0.05, 0.001, 1);
    collider.size[1] = any(state, 0.05, 0, 1);
    return collider;
}

// Return a small collider of any shape except collision meshes, for a group where the hair is.
static hair_collider any_small_collider(uint64_t* state)
{
    hair_collider collider = any_collider(state);
    collider.shape = (hair_shape)one_of(state, HAIR_SHAPE_PLANE);
    collider.friction = any(state, 1, 0, 100);
    collider.rounding = one_of(state, 3) ? 0 : (float)even(state, 0, 0.01);
    for (int k = 0; k < 3; ++k) collider.size[k] = (float)exp(even(state, log(0.002), log(0.03)));
    return collider;
}

// Update a group of colliders after the first `few`. They move slowly and sometimes jump.
static void any_hair_grid(uint64_t* state, struct bench_watch* watch, uint32_t few, uint32_t count)
{
    for (uint32_t s = few; s < few + count; ++s) {
        hair_collider* collider = &watch->colliders[s];
        if (s >= watch->collider_count || one_of(state, 16) == 0) *collider = any_small_collider(state);
        for (int k = 0; k < 3; ++k) collider->position[k] += (float)even(state, -0.005, 0.005);
    }
    watch->collider_count = few + count;
}

// Return a random time step, mostly of usual frames. One second is rare, because it takes many
// substeps.
static double any_dt(uint64_t* state)
{
    static const double few[] = {0, 1e-9, 1.0 / 240, 1.0 / 30, 0.1};
    if (one_of(state, 3)) return one_of(state, 2) ? 1.0 / 60 : 1.0 / 120;
    return one_of(state, 32) ? few[one_of(state, one_of(state, 3) ? 4 : 5)] : 1;
}

// Move and turn the head a little, sometimes to another place.
static void any_move(uint64_t* state, struct hair_reference_rod_pose* head)
{
    double axis[3], far = one_of(state, 12) ? 0.02 : 5, turn = one_of(state, 12) ? 0.1 : BENCH_PI;
    any_direction(state, axis);
    double x = even(state, -turn, turn),
           r[4] = {sin(x / 2) * axis[0], sin(x / 2) * axis[1], sin(x / 2) * axis[2], cos(x / 2)};
    double q[4], norm = 0;
    memcpy(q, head->rotation, sizeof q);
    head->rotation[0] = r[3] * q[0] + r[0] * q[3] + r[1] * q[2] - r[2] * q[1];
    head->rotation[1] = r[3] * q[1] - r[0] * q[2] + r[1] * q[3] + r[2] * q[0];
    head->rotation[2] = r[3] * q[2] + r[0] * q[1] - r[1] * q[0] + r[2] * q[3];
    head->rotation[3] = r[3] * q[3] - r[0] * q[0] - r[1] * q[1] - r[2] * q[2];
    for (int k = 0; k < 4; ++k) norm += head->rotation[k] * head->rotation[k];
    for (int k = 0; k < 4; ++k) head->rotation[k] /= sqrt(norm);
    for (int k = 0; k < 3; ++k)
        head->position[k] = fmin(fmax(head->position[k] + even(state, -far, far), -10), 10);
}

// Simulate random steps. One scene of eight has a group of colliders. Its random numbers are
// separate, so that the group does not change the rest of the scene.
static bool any_steps(uint64_t* state, struct bench_watch* watch)
{
    hair_instance* hair = watch->living->hair;
    uint32_t count = 24 + one_of(state, 12), few = 0;
    uint64_t own = ~*state;
    uint32_t hair_grid =
        one_of(&own, 8) ? 0 : MIN_VERTICES + one_of(&own, BENCH_MAX_COLLIDERS - MIN_VERTICES - 4);
    float matrix[16];
    for (uint32_t k = 0; k < count; ++k) {
        if (one_of(state, 2)) any_move(state, &watch->head);
        if (one_of(state, 16) == 0) {
            hair_wind wind = hair_wind_default();
            any_physics(state, &watch->calm, &wind);
            if (hair_set_physics(hair, &watch->calm) || hair_set_wind(hair, &wind)) return false;
        }
        if (one_of(state, 8) == 0) few = one_of(state, 5);
        for (uint32_t s = 0; s < few; ++s)
            if (one_of(state, 2)) watch->colliders[s] = any_collider(state);
        any_hair_grid(&own, watch, few, hair_grid);
        if (one_of(state, 64) == 0 && hair_reset(hair)) return false;
        bench_matrix(&watch->head, matrix);
        if (one_of(state, 32) == 0 && hair_teleport(hair, matrix)) return false;
        if (!bench_watch_step(watch, any_dt(state))) return false;
    }
    return true;
}

// Simulate one random scene. Return false for a scene that the library or the groom refuses.
static bool live_through(struct bench* bench, hair_solver solver, uint32_t number, struct bench_watch* all,
                         hair_solver_stats* solver_stats, uint32_t* worst)
{
    uint64_t state = SEED + (uint64_t)number * 0x100000001b3u;
    struct bench_scene scene = any_scene(&state, bench, solver);
    struct bench_live_scene live;
    struct bench_watch watch;
    if (!bench_live(bench, &scene, &live)) return false;
    hair_collider none = {
        .shape = HAIR_SHAPE_SPHERE, .rotation = {0, 0, 0, 1}, .size = {0.01f, 0}, .scale = 1, .friction = 1};
    bool ok = bench_watch(&live, &watch);
    hair_solver_stats own = hair_solver_stats_default();
    for (int s = 0; s < 4; ++s) watch.colliders[s] = none;
    if (ok && any_steps(&state, &watch) && !hair_get_solver_stats(live.hair, &own)) {
        if (solver != HAIR_SOLVER_REDBLACK && (!watch.finite || watch.stretch > BENCH_MAX_STRETCH))
            hair_complain(
                BENCH_TOOL, "scene %u, %s: %s, stretch %.3g, %u vertices, %u euler, %u follow, %u reset",
                number, bench_solver_name(solver), watch.finite ? "finite" : "not finite", watch.stretch,
                scene.vertices, own.euler_fallbacks, own.follow_fallbacks, own.reset);
        if (all->finite && (!watch.finite || watch.stretch >= all->stretch)) *worst = number;
        all->finite = all->finite && watch.finite;
        all->stretch = fmax(all->stretch, watch.stretch);
        all->speed = fmax(all->speed, watch.speed);
        solver_stats->euler_fallbacks += own.euler_fallbacks;
        solver_stats->parts += own.parts;
        solver_stats->follow_fallbacks += own.follow_fallbacks;
        solver_stats->reset += own.reset;
    } else
        ok = false;
    bench_free_live_scene(&live);
    return ok;
}

static void fuzz(struct bench* bench, hair_solver solver)
{
    const char* method = bench_solver_name(solver);
    if (!bench_begin(bench, "fuzz", method)) return;
    struct bench_watch all = {.finite = true};
    hair_solver_stats solver_stats = hair_solver_stats_default();
    struct bench_scene scene = bench_scene_default();
    uint32_t first = bench->options.scene, worst = first, lived = 0;
    uint32_t count = bench->options.scenes ? bench->options.scenes : bench->options.quick ? 200 : 10000;
    for (uint32_t i = 0; i < count && !bench_was_interrupted(); ++i)
        lived += live_through(bench, solver, first + i, &all, &solver_stats, &worst);
    if (lived <= count / 2) {
        bench_refuse(bench, "fuzz", method);
        return;
    }
    scene.solver = solver;
    scene.mapping = bench->options.mapping;
    struct bench_live_scene live = {.bench = bench, .scene = &scene, .substep = NAN};
    json_t* row = bench_stability_row(&live, "fuzz", &all);
    bench_set_count(row, "euler_fallbacks", solver_stats.euler_fallbacks);
    bench_set_count(row, "parts", solver_stats.parts);
    bench_set_count(row, "follow_fallbacks", solver_stats.follow_fallbacks);
    bench_set_count(row, "reset", solver_stats.reset);
    bench_set_count(row, "scenes", lived);
    bench_set_count(row, "worst_scene", worst);
    static const char* const random[] = {"substep",       "youngs_modulus", "poisson_ratio", "fiber_radius",
                                         "fiber_density", "flatness",       "damping"};
    for (size_t i = 0; i < sizeof random / sizeof *random; ++i) bench_set_null(row, random[i]);
}

void bench_fuzz(struct bench* bench)
{
    for (hair_solver s = HAIR_SOLVER_DIRECT; s <= HAIR_SOLVER_REDBLACK; ++s) fuzz(bench, s);
}
