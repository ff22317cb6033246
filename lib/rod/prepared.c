// prepared.c - rods of all guides, divided into tasks for the application's threads. Each guide is
// computed alone, so the results do not depend on the division.
#include "lib/rod/prepared.h"

#include <math.h>
#include <string.h>

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
    const struct hair_rods_order* order;
    struct hair_rods_result* result;
    hair_vec4* last; // Final solve of all guides.
    struct hair_division division; // of the guides
    struct hair_rods_softened softened[HAIR_MAX_TASKS];
    double shortest[HAIR_MAX_TASKS]; // Length of a substep, s.
    bool is_refused[HAIR_MAX_TASKS]; // True if the host has refused memory.
    bool is_mixed[HAIR_MAX_TASKS];
    bool has_system[HAIR_MAX_TASKS];
    uint32_t rounds[HAIR_MAX_TASKS];
};

// Run tasks over all guides. Return their number.
static uint32_t divide_guides(struct rod_work* work, hair_task task)
{
    HAIR_ASSERT(work->source->count > 0);
    work->division = hair_divide(work->source->count, MIN_GUIDES);
    hair_run_tasks(work->source->tasks, task, work, work->division.tasks);
    return work->division.tasks;
}

// Return the guides of a task, and their number.
static const struct hair_guide* guides_of(const struct rod_work* work, uint32_t index, uint32_t* count)
{
    uint32_t first = index * work->division.each;
    *count = hair_division_end(&work->division, index) - first;
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

// Return the physics of a guide for hair_rods_preload_list().
static const hair_physics* find_physics_of(const void* user, uint32_t guide, hair_physics* own)
{
    const struct rod_work* work = user;
    return find_physics(work->source, work->physics, work->source->guides + guide, own);
}

static void preload(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count, listed = 0, first = index * work->division.each;
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
    work.list = hair_alloc_undefined(source->host, source->count, sizeof *work.list);
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

static void find_shortest(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    double shortest = INFINITY;
    for (struct physics_run run = {0}; next_run(work->source, work->physics, guides, count, &run);)
        shortest = fmin(shortest, hair_rods_substep(guides + run.first, work->source->rest, work->borne,
                                                    run.count, run.physics, work->solver, work->mixed));
    work->shortest[index] = shortest;
}

double hair_rods_shared_substep(const struct hair_rod_source* source, const struct hair_rod_borne* borne,
                                const hair_physics* physics, hair_solver solver, int mixed)
{
    struct rod_work work = {
        .source = source, .borne = borne, .physics = physics, .solver = solver, .mixed = mixed};
    uint32_t tasks = divide_guides(&work, find_shortest);
    double shortest = INFINITY;
    for (uint32_t i = 0; i < tasks; ++i) shortest = fmin(shortest, work.shortest[i]);
    return shortest;
}

// Return the index of the first pin of a guide with at least the given index.
static uint32_t find_first_pin(const struct hair_rods_order* order, uint32_t guide)
{
    uint32_t low = 0, high = order->pin_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (order->pins[middle].guide < guide)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Write zeros to the rounds of the guides of a task, which are their first touch.
static void clear_reduction(struct rod_work* work, const struct hair_guide* guides, uint32_t count)
{
    const struct hair_rod_source* source = work->source;
    size_t first = guides[0].first, size = guides[count - 1].first + guides[count - 1].count - first;
    for (uint32_t n = 0; n < hair_rods_rounds(source->max_vertices); ++n)
        memset(work->result->reduction + (size_t)n * source->vertices + first, 0, size * sizeof *work->last);
    memset(work->last + first, 0, size * sizeof *work->last);
}

static void add_softness(struct hair_rods_softened* all, double softness, uint32_t guide)
{
    all->guides += softness < 1;
    if (softness >= (double)all->factor) return;
    all->worst = guide;
    all->factor = (float)softness;
}

static void make(uint32_t index, void* data)
{
    struct rod_work* work = data;
    const struct hair_rod_source* source = work->source;
    const struct hair_rods_order* o = work->order;
    struct hair_rod rod[HAIR_MAX_GUIDE_VERTICES];
    uint32_t count, first = index * work->division.each, pin = find_first_pin(o, first), end = pin;
    const struct hair_guide* guides = guides_of(work, index, &count);
    work->softened[index] = (struct hair_rods_softened){.factor = 1};
    work->has_system[index] = false;
    work->rounds[index] = 0;
    if (work->last) clear_reduction(work, guides, count);
    for (uint32_t i = 0; i < count; ++i, pin = end) {
        hair_physics own;
        const hair_physics* physics = find_physics(source, o->physics, &guides[i], &own);
        double softness = hair_rods_write(&guides[i], source->rest, o->borne, physics, o->solver, o->mixed,
                                          o->substep, rod);
        add_softness(&work->softened[index], softness, first + i);
        while (end < o->pin_count && o->pins[end].guide == first + i) ++end;
        if (end > pin)
            hair_rods_pin(&guides[i], source->rest, o->borne, o->pins, pin, end, physics, o->solver, o->mixed,
                          o->substep, rod);
        hair_rods_pack(&guides[i], first + i, source->count, source->vertices, rod, o->parts,
                       work->result->packed);
        if (!work->last || !hair_rods_have_system(rod)) continue;
        uint32_t rounds = hair_rods_write_reduction(&guides[i], rod, source->vertices, o->substep,
                                                    work->result->reduction, work->last);
        work->has_system[index] = true;
        if (rounds > work->rounds[index]) work->rounds[index] = rounds;
    }
}

static void add_final_solve(uint32_t index, void* data)
{
    struct rod_work* work = data;
    uint32_t count;
    const struct hair_guide* guides = guides_of(work, index, &count);
    hair_rods_add_final_solve(guides, count, work->source->vertices, work->result->rounds, work->last,
                              work->result->reduction);
}

// Make the rods in memory that is there. Return whether a guide has an implicit system.
static bool make_rods(struct rod_work* work)
{
    struct hair_rods_result* result = work->result;
    uint32_t tasks = divide_guides(work, make);
    bool has_system = false;
    result->softened = (struct hair_rods_softened){.factor = 1};
    for (uint32_t i = 0; i < tasks; ++i) {
        const struct hair_rods_softened own = work->softened[i];
        has_system |= work->has_system[i];
        if (work->rounds[i] > result->rounds) result->rounds = work->rounds[i];
        result->softened.guides += own.guides;
        if (own.factor >= result->softened.factor) continue;
        result->softened.worst = own.worst;
        result->softened.factor = own.factor;
    }
    if (has_system) divide_guides(work, add_final_solve);
    return has_system;
}

hair_result hair_rods_make_all(const struct hair_rod_source* source, const struct hair_rods_order* order,
                               struct hair_rods_result* out)
{
    const hair_host* host = source->host;
    const bool is_reduced = order->is_reduced && !order->mixed;
    const size_t count = hair_rods_packed_count(source->count, source->vertices, order->parts);
    const size_t rows = (size_t)hair_rods_rounds(source->max_vertices) * source->vertices;
    struct rod_work work = {.source = source, .order = order, .result = out};
    *out = (struct hair_rods_result){.packed = hair_alloc_undefined(host, count, sizeof *out->packed)};
    if (is_reduced) out->reduction = hair_alloc_undefined(host, rows + 1, sizeof *out->reduction);
    if (is_reduced) work.last = hair_alloc_undefined(host, source->vertices, sizeof *work.last);
    bool is_there = out->packed && (!is_reduced || (out->reduction && work.last)), has_system = false;
    if (is_there) {
        out->packed[count - 1] = (hair_vec4){0, 0, 0, 0}; // Pins may leave a rest.
        if (is_reduced) out->reduction[rows] = (hair_vec4){0, 0, 0, 0};
        has_system = make_rods(&work);
    }
    if (!has_system) {
        hair_free(host, out->reduction);
        out->reduction = NULL;
    }
    hair_free(host, work.last);
    if (is_there) return HAIR_OK;
    hair_free(host, out->packed);
    return hair_fail_memory(host, "the guides as rods");
}

static hair_result fill(const struct hair_rod_source* source, struct hair_prepared_rods* p)
{
    const hair_host* host = source->host;
    p->borne = hair_alloc_undefined(host, source->vertices, sizeof *p->borne);
    p->sags = hair_alloc_undefined(host, source->count, sizeof *p->sags);
    if (!p->borne || !p->sags) return hair_fail_memory(host, "the guides as rods");
    HAIR_TRY(hair_rods_preload_all(source, &p->physics, NULL, p->borne, p->sags));
    p->report = hair_rods_report_of(source->guides, source->count, p->borne, p->sags);
    p->mixed = hair_rods_are_any_mixed(source, p->borne, &p->physics, p->solver, false, 0);
    p->substep = hair_rods_shared_substep(source, p->borne, &p->physics, p->solver, p->mixed);
    const struct hair_rods_order order = {.borne = p->borne,
                                          .physics = &p->physics,
                                          .solver = p->solver,
                                          .mixed = p->mixed,
                                          .substep = p->substep,
                                          .parts = {.has_factor_euler = !p->mixed, .has_factor = !p->mixed},
                                          .is_reduced = p->solver != HAIR_SOLVER_FOLLOW};
    struct hair_rods_result made;
    HAIR_TRY(hair_rods_make_all(source, &order, &made));
    p->rod = made.packed;
    p->reduction = made.reduction;
    p->rounds = made.rounds;
    p->report.softened = made.softened;
    return HAIR_OK;
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
