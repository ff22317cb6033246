// live_scene.c - A simulated scene that is stepped, read and timed.
#include "tools/bench/live_scene.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static hair_result make_groom(struct bench_live_scene* live)
{
    const struct bench_scene* scene = live->scene;
    size_t count = scene->strands, floats = 3 * (size_t)scene->vertices;
    float* positions = malloc(count * floats * sizeof *positions);
    uint32_t* vertices = malloc(count * sizeof *vertices);
    hair_result result = HAIR_ERROR_MEMORY;
    if (positions && vertices) {
        for (size_t i = 0; i < count; ++i) {
            memcpy(positions + i * floats, scene->positions, floats * sizeof *positions);
            vertices[i] = scene->vertices;
        }
        hair_groom_desc desc = hair_groom_desc_default();
        desc.host = &live->bench->host;
        desc.positions = positions;
        desc.strand_vertices = vertices;
        desc.strand_count = scene->strands;
        desc.strand_set = HAIR_STRAND_SET_GUIDES;
        desc.guide_vertices = scene->vertices;
        desc.follower_count = 0;
        result = hair_groom_create(&desc, &live->groom);
    }
    free(positions);
    free(vertices);
    return result;
}

// Check that the groom has not repaired or thinned the strands.
static hair_result check_groom(struct bench_live_scene* live)
{
    hair_groom_info info = hair_groom_info_default();
    hair_result result = hair_groom_describe(live->groom, &info);
    if (result) return result;
    const struct bench_scene* scene = live->scene;
    if (info.guide_vertex_count == scene->strands * scene->vertices) return HAIR_OK;
    snprintf(live->bench->sentence, sizeof live->bench->sentence,
             "the groom has %u vertices in %u guides, not %u in %u", info.guide_vertex_count,
             info.guide_count, scene->strands * scene->vertices, scene->strands);
    return HAIR_ERROR_ARGUMENT;
}

static hair_result make_instance(struct bench_live_scene* live)
{
    const struct bench_scene* scene = live->scene;
    hair_desc desc = hair_desc_default();
    desc.label = bench_solver_name(scene->solver);
    desc.solver = scene->solver;
    desc.thread_mapping = scene->mapping;
    desc.substep = (float)scene->substep;
    desc.max_dt = (float)scene->max_dt;
    desc.physics = &scene->physics;
    hair_result result = hair_create(live->bench->context, live->groom, &desc, &live->hair);
    if (!result) result = hair_set_wind(live->hair, &scene->wind);
    if (result) return result;
    // The groom moves vertices that are too close together. Read its positions while the head is at
    // the origin.
    float head[16];
    uint32_t count;
    bench_matrix(&scene->head, head);
    result = hair_read_positions(live->hair, HAIR_READ_GUIDES, live->positions, scene->vertices, &count);
    if (!result) result = hair_set_transform(live->hair, head);
    if (!result) result = hair_reset(live->hair);
    if (result) return result;
    hair_solver_stats solver_stats = hair_solver_stats_default();
    result = hair_get_solver_stats(live->hair, &solver_stats);
    live->substep = (double)solver_stats.substep;
    return result;
}

bool bench_live(struct bench* bench, const struct bench_scene* scene, struct bench_live_scene* out)
{
    *out = (struct bench_live_scene){.bench = bench, .scene = scene};
    snprintf(bench->sentence, sizeof bench->sentence, "out of memory");
    hair_result result = make_groom(out);
    if (!result) result = check_groom(out);
    if (!result) result = make_instance(out);
    out->read = malloc(3 * (size_t)scene->strands * scene->vertices * sizeof *out->read);
    if (result || !out->read) {
        bench_free_live_scene(out);
        return false;
    }
    for (uint32_t i = 0; i + 1 < scene->vertices; ++i) {
        const float* p = out->positions + 3 * i;
        double dx = (double)p[3] - (double)p[0], dy = (double)p[4] - (double)p[1];
        out->lengths[i] = hypot(hypot(dx, dy), (double)p[5] - (double)p[2]);
        out->length += out->lengths[i];
    }
    return true;
}

void bench_free_live_scene(struct bench_live_scene* live)
{
    hair_destroy(live->hair);
    hair_groom_destroy(live->groom);
    free(live->read);
    *live = (struct bench_live_scene){0};
}

bool bench_restart(struct bench_live_scene* live)
{
    float matrix[16];
    bench_matrix(&live->scene->head, matrix);
    return !hair_set_transform(live->hair, matrix) && !hair_reset(live->hair);
}

bool bench_step(struct bench_live_scene* live, const struct hair_reference_rod_pose* head, double dt)
{
    float matrix[16];
    if (head) {
        bench_matrix(head, matrix);
        if (hair_set_transform(live->hair, matrix)) return false;
    }
    return !hair_step(live->hair, (float)dt);
}

bool bench_read(struct bench_live_scene* live, double* positions)
{
    uint32_t count, vertices = live->scene->vertices;
    if (hair_read_positions(live->hair, HAIR_READ_GUIDES, live->read, vertices, &count)) return false;
    for (uint32_t i = 0; i < 3 * vertices; ++i) positions[i] = (double)live->read[i];
    return true;
}

double bench_substeps(const struct bench_live_scene* live)
{
    return round(1000 / (60 * live->substep)) / 1000; // The substep is a float.
}

bool bench_settle(struct bench_live_scene* live, double* positions)
{
    double before[3 * BENCH_MAX_VERTICES];
    for (int k = 0; k < 60; ++k) {
        for (int i = 0; i < 30; ++i)
            if (!bench_step(live, NULL, 1.0 / 60)) return false;
        if (k) memcpy(before, positions, 3 * sizeof *before * live->scene->vertices);
        if (!bench_read(live, positions) || bench_was_interrupted()) return false;
        double max = 0;
        for (uint32_t i = 0; i < 3 * live->scene->vertices && k; ++i)
            max = fmax(max, fabs(positions[i] - before[i]));
        if (k && max < 1e-6 * live->length) return true;
    }
    return true;
}

bool bench_strands_are_alike(struct bench_live_scene* live)
{
    const struct bench_scene* scene = live->scene;
    uint32_t count, all = scene->strands * scene->vertices;
    size_t size = 3 * (size_t)scene->vertices;
    if (hair_read_positions(live->hair, HAIR_READ_GUIDES, live->read, all, &count)) return false;
    for (uint32_t i = 1; i < scene->strands; ++i)
        if (memcmp(live->read, live->read + i * size, size * sizeof *live->read)) return false;
    return true;
}

double bench_stretch(const struct bench_live_scene* live, const double* positions)
{
    double max = 0;
    for (uint32_t i = 0; i + 1 < live->scene->vertices; ++i) {
        const double* p = positions + 3 * i;
        double length = hypot(hypot(p[3] - p[0], p[4] - p[1]), p[5] - p[2]);
        double error = fabs(length / live->lengths[i] - 1);
        if (!(error <= max)) max = error; // NaN too
    }
    return max;
}

bool bench_are_finite(const double* positions, uint32_t vertices)
{
    for (uint32_t i = 0; i < 3 * vertices; ++i)
        if (!isfinite(positions[i])) return false;
    return true;
}

// Timing ------------------------------------------------------------------------------------------

// Return the GPU time in ms of all passes since `before`, and set `before` to now.
static double passes_since(hair_context* context, hair_timing before[BENCH_MAX_PASSES])
{
    hair_timing now[BENCH_MAX_PASSES];
    uint32_t count = hair_get_timings(context, now, BENCH_MAX_PASSES);
    double ms = 0;
    for (uint32_t i = 0; i < count && i < BENCH_MAX_PASSES; ++i) {
        ms += now[i].total_ms - before[i].total_ms;
        before[i] = now[i];
    }
    return ms;
}

// Simulate frames. On hardware, the driver's timers measure each frame, because waiting between
// frames takes time that is not the GPU's.
static bool run_frames(struct bench_live_scene* live, uint32_t frames,
                       const struct hair_reference_rod_pose* heads, double dt, double* ms)
{
    bool software = live->bench->software;
    hair_timing before[BENCH_MAX_PASSES] = {{0}};
    glFinish();
    passes_since(live->bench->context, before);
    double start = hair_now(), passes = 0;
    for (uint32_t k = 0; k < frames; ++k) {
        if (!bench_step(live, heads ? heads + k : NULL, dt)) return false;
        if (software) continue;
        glFinish();
        passes += passes_since(live->bench->context, before);
    }
    glFinish();
    *ms = (software ? hair_now() - start : passes) / frames;
    return true;
}

static bool run_once(struct bench_live_scene* live, uint32_t frames,
                     const struct hair_reference_rod_pose* heads, double dt, double* ms)
{
    return !bench_was_interrupted() && bench_restart(live) && run_frames(live, frames, heads, dt, ms);
}

// Simulate frames for a while, because an idle GPU is slower at first.
static bool warm_up(struct bench_live_scene* live, double dt)
{
    enum { WARM = 300, AT_ONCE = 20 }; // ms, frames
    if (live->bench->software) return true;
    for (double start = hair_now(); hair_now() - start < WARM; glFinish())
        for (int i = 0; i < AT_ONCE; ++i)
            if (!bench_step(live, NULL, dt)) return false;
    return true;
}

bool bench_time(struct bench_live_scene* live, uint32_t frames, const struct hair_reference_rod_pose* heads,
                double dt, struct bench_times* out)
{
    enum { MAX_RUNS = 15 };
    double ms[MAX_RUNS], passed = 0, enough = live->bench->options.quick ? 200 : 2000;
    uint32_t runs = 0;
    if (!warm_up(live, dt)) return false;
    for (double start = hair_now(); bench_times_want_more(runs, MAX_RUNS, passed, enough);
         passed = hair_now() - start)
        if (!run_once(live, frames, heads, dt, &ms[runs++])) return false;
    *out = bench_times_of(ms, runs);
    return true;
}

void bench_set_material(json_t* row, const struct bench_live_scene* live)
{
    static const char* const mappings[] = {"auto", "workgroup_per_guide", "thread_per_guide"};
    const struct bench_scene* scene = live->scene;
    const hair_physics* p = &scene->physics;
    bool rod = scene->solver != HAIR_SOLVER_REDBLACK;
    bench_set_text(row, "solver", bench_solver_name(scene->solver));
    bench_set_text(row, "thread_mapping", mappings[scene->mapping]);
    bench_set_number(row, "substep", live->substep);
    bench_set_number(row, "damping", (double)p->damping);
    if (!rod) return; // redblack has no material
    bench_set_number(row, "youngs_modulus", (double)p->fiber.youngs_modulus);
    bench_set_number(row, "poisson_ratio", (double)p->fiber.poisson_ratio);
    bench_set_number(row, "fiber_radius", (double)p->fiber.radius);
    bench_set_number(row, "fiber_density", (double)p->fiber.density);
    bench_set_number(row, "flatness", (double)p->fiber.flatness);
}
