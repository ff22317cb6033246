// prepared.c - rods of all guides, divided into tasks for the application's threads. Each guide is
// computed alone, so the results do not depend on the division.
#include "lib/rod/prepared.h"

#include <math.h>

#define MAX_TASKS 256
#define MIN_GUIDES 16 // Minimum number of guides of a task.

// Work on all guides. Each kind of task uses a part of the members.
struct rod_work {
    const struct hair_rod_source* source;
    const struct hair_rod_borne* borne;
    const hair_physics* physics;
    hair_solver solver;
    int mixed;
    bool is_held;
    double substep;
    const bool* changed; // Guides whose preload is computed. NULL selects all.
    uint32_t* list; // Numbers of these guides for each task, from its first guide on.
    struct hair_rod_borne* new_borne;
    float* new_sags;
    struct hair_rod* new_rod;
    const struct hair_rod* rod;
    hair_vec4 *reduction, *last;
    struct hair_rod_parts parts;
    hair_vec4* packed;
    uint32_t all_rounds; // Rounds of all guides.
    uint32_t each; // Guides of a task.
    struct hair_rods_softened softened[MAX_TASKS];
    bool is_refused[MAX_TASKS]; // True if the host has refused memory.
    bool is_mixed[MAX_TASKS];
    uint32_t rounds[MAX_TASKS];
};

// Run tasks over all guides. Return their number.
static uint32_t divide_guides(struct rod_work* work, hair_task task)
{
    uint32_t count = work->source->count;
    HAIR_ASSERT(count > 0);
    work->each = (count + MAX_TASKS - 1) / MAX_TASKS;
    if (work->each < MIN_GUIDES) work->each = MIN_GUIDES;
    uint32_t tasks = (count + work->each - 1) / work->each;
    hair_run_tasks(work->source->tasks, task, work, tasks);
    return tasks;
}

// Return the guides of a task, and their number.
static const struct hair_guide* guides_of(const struct rod_work* work, uint32_t index, uint32_t* count)
{
    uint32_t first = index * work->each, left = work->source->count - first;
    *count = left < work->each ? left : work->each;
    return work->source->guides + first;
}

// Guides with the same physics, one after the other.
struct physics_run {
    uint32_t first, count;
    const hair_physics* physics;
    hair_physics own; // The physics, if factors have changed those of the group.
};

// Return whether two guides have the same physics.
static bool have_equal_physics(const struct hair_rod_source* source, const struct hair_guide* a,
                               const struct hair_guide* b)
{
    const struct hair_guide_factors* factors = source->factors;
    if (source->groups && a->group != b->group) return false;
    return !factors || hair_factors_are_equal(factors + (a - source->guides), factors + (b - source->guides));
}

// Return the physics of a guide. Those that factors change are in `own`.
static const hair_physics* find_physics(const struct hair_rod_source* source, const hair_physics* physics,
                                        const struct hair_guide* guide, hair_physics* own)
{
    HAIR_ASSERT(guide->group < HAIR_MAX_STRAND_GROUPS);
    const hair_physics* shared = source->groups ? &source->groups[guide->group] : physics;
    if (!source->factors) return shared;
    *own = hair_physics_multiply(shared, source->factors + (guide - source->guides));
    return own;
}

// Advance to the next run among `count` guides. An empty run precedes the first one. Return false
// at the end.
static bool next_run(const struct hair_rod_source* source, const hair_physics* physics,
                     const struct hair_guide* guides, uint32_t count, struct physics_run* run)
{
    uint32_t first = run->first + run->count, end = first;
    if (first >= count) return false;
    while (end < count && have_equal_physics(source, &guides[first], &guides[end])) ++end;
    run->first = first;
    run->count = end - first;
    run->physics = find_physics(source, physics, &guides[first], &run->own);
    return true;
}

// Add the softened guides from guide `first` on.
static void add_softened(struct hair_rods_softened* all, const struct hair_rods_softened* own, uint32_t first)
{
    all->guides += own->guides;
    if (own->factor >= all->factor) return;
    all->worst = first + own->worst;
    all->factor = own->factor;
}

// Return the physics of a guide for hair_rods_preload_list().
static const hair_physics* find_physics_of(const void* user, uint32_t guide, hair_physics* own)
{
    const struct rod_work* work = user;
    return find_physics(work->source, work->physics, work->source->guides + guide, own);
}

static void preload(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count, listed = 0, first = index * work->each;
    guides_of(work, index, &count);
    for (uint32_t i = first; i < first + count; ++i)
        if (!work->changed || work->changed[i]) work->list[first + listed++] = i;
    // Callbacks of the host may be called on the calling thread only.
    const hair_host* host = work->source->tasks->run ? NULL : work->source->host;
    const struct hair_rods_preload desc = {.host = host,
                                           .guides = work->source->guides,
                                           .rest = work->source->rest,
                                           .list = work->list + first,
                                           .count = listed,
                                           .find_physics = find_physics_of,
                                           .user = work,
                                           .out = work->new_borne,
                                           .sags = work->new_sags};
    work->is_refused[index] = hair_rods_preload_list(&desc) != HAIR_OK;
}

hair_result hair_rods_preload_all(const struct hair_rod_source* source, const hair_physics* physics,
                                  const bool* changed, struct hair_rod_borne* out, float* sags)
{
    struct rod_work work = {
        .source = source, .physics = physics, .changed = changed, .new_borne = out, .new_sags = sags};
    work.list = hair_alloc(source->host, source->count, sizeof *work.list);
    bool is_refused = !work.list;
    uint32_t tasks = work.list ? divide_guides(&work, preload) : 0;
    for (uint32_t i = 0; i < tasks; ++i) is_refused |= work.is_refused[i];
    hair_free(source->host, work.list);
    return is_refused ? hair_fail_memory(source->host, "the gravity preload of guides") : HAIR_OK;
}

struct hair_rods_report hair_rods_report_of(const struct hair_guide* guides, uint32_t count,
                                            const struct hair_rod_borne* borne, const float* sags)
{
    struct hair_rods_report report = hair_rods_report_none();
    for (uint32_t i = 0; i < count; ++i) {
        double stiffen = borne[guides[i].first].stiffen;
        report.stiffened += stiffen > 1;
        report.stiffest = fmaxf(report.stiffest, (float)stiffen);
        report.sagging += sags[i] >= 0;
        report.farthest_sag = fmaxf(report.farthest_sag, sags[i]);
    }
    return report;
}

static const hair_physics* find_only_physics(const void* user, uint32_t guide, hair_physics* own)
{
    (void)guide;
    (void)own;
    return user;
}

hair_result hair_rods_preload_gravity(const hair_host* host, const struct hair_guide* guides,
                                      const struct hair_rest* rest, uint32_t count,
                                      const hair_physics* physics, struct hair_rod_borne* out,
                                      struct hair_rods_report* report)
{
    const hair_host whole = hair_host_or_default(host);
    struct hair_rods_preload desc = {.host = host,
                                     .guides = guides,
                                     .rest = rest,
                                     .count = count,
                                     .find_physics = find_only_physics,
                                     .user = physics,
                                     .out = out};
    desc.sags = hair_alloc(&whole, count, sizeof *desc.sags);
    if (!desc.sags) return HAIR_ERROR_MEMORY;
    hair_result result = hair_rods_preload_list(&desc);
    if (!result) *report = hair_rods_report_of(guides, count, out, desc.sags);
    hair_free(&whole, desc.sags);
    return result;
}

static void find_mixed(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    work->is_mixed[index] = false;
    for (struct physics_run run = {0}; next_run(work->source, work->physics, guides, count, &run);)
        if (hair_rods_are_mixed(guides + run.first, work->source->rest, work->borne, run.count, run.physics,
                                work->solver, work->is_held, work->substep))
            work->is_mixed[index] = true;
}

bool hair_rods_are_any_mixed(const struct hair_rod_source* source, const struct hair_rod_borne* borne,
                             const hair_physics* physics, hair_solver solver, bool is_held, double substep)
{
    struct rod_work work = {.source = source,
                            .borne = borne,
                            .physics = physics,
                            .solver = solver,
                            .is_held = is_held,
                            .substep = substep};
    if (solver != HAIR_SOLVER_DIRECT && solver != HAIR_SOLVER_ACCURATE) return false;
    uint32_t tasks = divide_guides(&work, find_mixed);
    for (uint32_t i = 0; i < tasks; ++i)
        if (work.is_mixed[i]) return true;
    return false;
}

double hair_rods_shared_substep(const struct hair_rod_source* source, const struct hair_rod_borne* borne,
                                const hair_physics* physics, hair_solver solver, int mixed)
{
    double shortest = INFINITY;
    for (struct physics_run run = {0}; next_run(source, physics, source->guides, source->count, &run);)
        shortest = fmin(shortest, hair_rods_substep(source->guides + run.first, source->rest, borne,
                                                    run.count, run.physics, solver, mixed));
    return shortest;
}

static void write(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    work->softened[index] = (struct hair_rods_softened){.factor = 1};
    for (struct physics_run run = {0}; next_run(work->source, work->physics, guides, count, &run);) {
        struct hair_rods_softened own =
            hair_rods_write(guides + run.first, work->source->rest, work->borne, run.count, run.physics,
                            work->solver, work->mixed, work->substep, work->new_rod);
        add_softened(&work->softened[index], &own, run.first);
    }
}

struct hair_rods_softened hair_rods_write_all(const struct hair_rod_source* source,
                                              const struct hair_rod_borne* borne, const hair_physics* physics,
                                              hair_solver solver, int mixed, double substep,
                                              struct hair_rod* out)
{
    struct rod_work work = {.source = source,
                            .borne = borne,
                            .physics = physics,
                            .solver = solver,
                            .mixed = mixed,
                            .substep = substep,
                            .new_rod = out};
    uint32_t tasks = divide_guides(&work, write);
    struct hair_rods_softened all = {.factor = 1};
    for (uint32_t i = 0; i < tasks; ++i) add_softened(&all, &work.softened[i], i * work.each);
    return all;
}

void hair_rods_pin_all(const struct hair_rod_source* source, const struct hair_rod_borne* borne,
                       const struct hair_resolved_pin* resolved_pin, uint32_t count,
                       const hair_physics* physics, hair_solver solver, int mixed, double substep,
                       struct hair_rod* out)
{
    for (uint32_t first = 0, end = 0; first < count; first = end) {
        const struct hair_guide* guide = source->guides + resolved_pin[first].guide;
        hair_physics own;
        while (end < count && resolved_pin[end].guide == resolved_pin[first].guide) ++end;
        hair_rods_pin(guide, source->rest, borne, resolved_pin, first, end,
                      find_physics(source, physics, guide, &own), solver, mixed, substep, out);
    }
}

static void reduce(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    work->rounds[index] = hair_rods_write_reduction(guides, count, work->rod, work->source->vertices,
                                                    work->substep, work->reduction, work->last);
}

static void add_final_solve(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    hair_rods_add_final_solve(guides, count, work->source->vertices, work->all_rounds, work->last,
                              work->reduction);
}

// Compute the reduction into zeros. Return the number of rounds before the final solve.
static uint32_t reduce_into(const struct hair_rod_source* source, const struct hair_rod* rod, double substep,
                            hair_vec4* reduction, hair_vec4* last)
{
    struct rod_work work = {
        .source = source, .rod = rod, .substep = substep, .reduction = reduction, .last = last};
    uint32_t tasks = divide_guides(&work, reduce);
    for (uint32_t i = 0; i < tasks; ++i)
        if (work.rounds[i] > work.all_rounds) work.all_rounds = work.rounds[i];
    divide_guides(&work, add_final_solve);
    return work.all_rounds;
}

static bool has_system(const struct hair_rod_source* source, const struct hair_rod* rod)
{
    for (uint32_t i = 0; i < source->count; ++i)
        if (rod[source->guides[i].first].factor.x > 0) return true;
    return false;
}

hair_result hair_rods_reduce_all(const struct hair_rod_source* source, const struct hair_rod* rod,
                                 double substep, uint32_t* rounds, hair_vec4** out)
{
    const hair_host* host = source->host;
    *out = NULL;
    if (!has_system(source, rod)) return HAIR_OK;
    size_t count = (size_t)hair_rods_rounds(source->max_vertices) * source->vertices;
    hair_vec4* reduction = hair_alloc(host, count + 1, sizeof *reduction);
    hair_vec4* last = hair_alloc(host, source->vertices, sizeof *last);
    bool is_there = reduction && last;
    if (is_there) {
        *rounds = reduce_into(source, rod, substep, reduction, last);
        HAIR_ASSERT(*rounds < hair_rods_rounds(source->max_vertices));
        *out = reduction;
    } else {
        hair_free(host, reduction);
    }
    hair_free(host, last);
    return is_there ? HAIR_OK : hair_fail_memory(host, "the implicit systems of guides");
}

static void pack_task(uint32_t index, void* data)
{
    struct rod_work* work = data;
    const struct hair_rod_source* source = work->source;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    hair_rods_pack(guides, index * work->each, count, source->count, source->vertices, work->rod, work->parts,
                   work->packed);
}

hair_result hair_rods_pack_all(const struct hair_rod_source* source, const struct hair_rod* rod,
                               struct hair_rod_parts parts, size_t* count, hair_vec4** out)
{
    *count = hair_rods_packed_count(source->count, source->vertices, parts);
    *out = hair_alloc(source->host, *count, sizeof **out);
    if (!*out) return hair_fail_memory(source->host, "the guides as rods");
    struct rod_work work = {.source = source, .rod = rod, .parts = parts, .packed = *out};
    divide_guides(&work, pack_task);
    return HAIR_OK;
}

// Write, reduce and pack the rods, whose memory is `rod`.
static hair_result fill_rods(const struct hair_rod_source* source, struct hair_prepared_rods* p,
                             struct hair_rod* rod)
{
    struct hair_rod_parts parts = {.has_factor_euler = !p->mixed, .has_factor = !p->mixed};
    size_t count;
    p->report.softened =
        hair_rods_write_all(source, p->borne, &p->physics, p->solver, p->mixed, p->substep, rod);
    HAIR_TRY(hair_rods_pack_all(source, rod, parts, &count, &p->rod));
    if (p->solver == HAIR_SOLVER_FOLLOW) return HAIR_OK;
    return hair_rods_reduce_all(source, rod, p->substep, &p->rounds, &p->reduction);
}

static hair_result fill(const struct hair_rod_source* source, struct hair_prepared_rods* p)
{
    const hair_host* host = source->host;
    p->borne = hair_alloc(host, source->vertices, sizeof *p->borne);
    p->sags = hair_alloc(host, source->count, sizeof *p->sags);
    if (!p->borne || !p->sags) return hair_fail_memory(host, "the guides as rods");
    HAIR_TRY(hair_rods_preload_all(source, &p->physics, NULL, p->borne, p->sags));
    p->report = hair_rods_report_of(source->guides, source->count, p->borne, p->sags);
    p->mixed = hair_rods_are_any_mixed(source, p->borne, &p->physics, p->solver, false, 0);
    p->substep = hair_rods_shared_substep(source, p->borne, &p->physics, p->solver, p->mixed);
    struct hair_rod* rod = hair_alloc(host, source->vertices, sizeof *rod);
    if (!rod) return hair_fail_memory(host, "the guides as rods");
    hair_result result = fill_rods(source, p, rod);
    hair_free(host, rod);
    return result;
}

hair_result hair_prepared_rods_create(const struct hair_rod_source* source, const hair_physics* physics,
                                      hair_solver solver, struct hair_prepared_rods** out)
{
    struct hair_prepared_rods* prepared = hair_alloc(source->host, 1, sizeof *prepared);
    if (!prepared) return hair_fail_memory(source->host, "the guides as rods");
    prepared->physics = *physics;
    prepared->solver = solver;
    hair_result result = fill(source, prepared);
    if (result)
        hair_prepared_rods_free(source->host, prepared);
    else
        *out = prepared;
    return result;
}

void hair_prepared_rods_free(const hair_host* host, struct hair_prepared_rods* prepared)
{
    if (!prepared) return;
    hair_free(host, prepared->borne);
    hair_free(host, prepared->rod);
    hair_free(host, prepared->sags);
    hair_free(host, prepared->reduction);
    hair_free(host, prepared);
}
