// programs.c - selection of the programs of a simulation, and of the number of substeps per
// dispatch.
#include "lib/sim/sim.h"

// Maximum number of guides that a GPU runs at once, however many registers they take.
#define MAX_FEW 2048
// Guides per work group with a thread per guide. GROUP_THREADS of glsl/sim/thread_mapping.glsl.
#define GUIDES_PER_GROUP 8
#define MAX_IN_THREAD 128 // Maximum vertices of a guide that fit into a GPU thread's memory.
#define MAX_MIXED 64 // Maximum vertices of a guide that fit under the mixed scheme.
#define GROUPS_OF_LIST 16 // Work groups that a multiprocessor of a GPU runs at once.
// Assumed number of multiprocessors of a GPU whose driver does not tell.
#define ASSUMED_UNITS 64
// Maximum loop iterations of a thread on a software rasteriser. See loop_budget.c.
#define MAX_ROUNDS 65000
// Loop iterations for parts of a substep with a thread per guide. They suffice for 21 parts of a
// guide of 32 vertices.
#define PART_ROUNDS_OF_THREAD 30000
// Loop iterations for parts of a substep with a work group per guide. They suffice for 71 parts.
#define PART_ROUNDS_OF_GROUP 9000
// Loop iterations for parts of a guide whose bending is implicit. They suffice for 128 parts.
#define PART_ROUNDS_OF_STIFF 18000
// Maximum vertices of a guide whose parts fit into a thread.
#define MAX_SPLIT_IN_THREAD 32

// A work group solves a guide that would be too much for a thread.
bool hair_sim_is_by_thread(const struct hair_sim* sim)
{
    uint32_t max = hair_sim_is_mixed(sim) ? MAX_MIXED : MAX_IN_THREAD;
    if (!sim->gl->software && sim->max_vertices > max) return false;
    return sim->by_thread && (!sim->gl->software || hair_sim_rounds_of_substep(sim, 1) <= MAX_ROUNDS);
}

// Return whether some substeps may be split. See glsl/sim/parts.glsl.
static bool has_parts(const struct hair_sim* sim)
{
    return sim->solver == HAIR_SOLVER_ACCURATE && !hair_sim_is_mixed(sim) && !sim->contacts.listed &&
           !sim->pins.count;
}

// Return whether guides go through two programs of the accurate solver. The second program solves
// the guides that the first leaves. The first only knows SHAKE. Where bending is implicit the first
// knows all methods, and the second splits substeps.
static bool uses_two_passes_by_shake(const struct hair_sim* sim)
{
    bool stiff = hair_sim_is_stiff(sim);
    return stiff ? has_parts(sim) : sim->solver == HAIR_SOLVER_ACCURATE && !hair_sim_is_mixed(sim);
}

// Return how many substeps fit into a dispatch. Those of a software rasteriser have `rounds` loop
// iterations. The second of two programs begins again with the first substep of a dispatch, so that
// other dispatches would round otherwise. A GPU then divides the guides only.
static uint32_t substeps_of(const struct hair_sim* sim, uint32_t rounds)
{
    if (!sim->gl->software)
        return uses_two_passes_by_shake(sim) ? HAIR_STEP_SUBSTEPS : hair_sim_substeps_in_time(sim);
    HAIR_ASSERT(rounds > 0);
    uint32_t max = MAX_ROUNDS / rounds;
    return max < 1 ? 1 : max < HAIR_STEP_SUBSTEPS ? max : HAIR_STEP_SUBSTEPS;
}

// Return whether a thread of the second program solves a guide, and not a work group. Parts of long
// guides need more loop iterations than a thread has.
static bool is_list_by_thread(const struct hair_sim* sim)
{
    bool fits = !has_parts(sim) || sim->max_vertices <= MAX_SPLIT_IN_THREAD;
    return hair_sim_is_by_thread(sim) && fits;
}

uint32_t hair_sim_guides_of_list_group(const struct hair_sim* sim)
{
    return is_list_by_thread(sim) ? GUIDES_PER_GROUP : 1;
}

uint32_t hair_sim_part_rounds(const struct hair_sim* sim)
{
    int by_thread = is_list_by_thread(sim);
    uint32_t of_group = hair_sim_is_stiff(sim) ? PART_ROUNDS_OF_STIFF : PART_ROUNDS_OF_GROUP;
    uint32_t max = by_thread ? PART_ROUNDS_OF_THREAD : of_group;
    if (!has_parts(sim)) return 0;
    if (!sim->gl->software) return max;
    uint32_t whole = hair_sim_rounds_of_substep(sim, by_thread);
    return whole >= MAX_ROUNDS ? 0 : max < MAX_ROUNDS - whole ? max : MAX_ROUNDS - whole;
}

// Without parts, both programs run the same number of substeps per dispatch. With parts, the second
// program divides the substeps of the first into several dispatches.
uint32_t hair_sim_substeps_at_once(const struct hair_sim* sim)
{
    int by_thread = hair_sim_is_by_thread(sim);
    bool first = has_parts(sim) && !hair_sim_is_stiff(sim);
    return substeps_of(sim, first ? hair_sim_rounds_of_pass1(sim, by_thread)
                                  : hair_sim_rounds_of_substep(sim, by_thread));
}

// Return whether guides are so few that their work groups wait for the memory of colliders. Such
// work groups cache colliders and read several at once, which is faster. For many guides this would
// be slower, because the registers of the cache reduce the number of guides that run at once.
static bool has_few_guides(const struct hair_sim* sim, int by_thread)
{
    return sim->guides <= MAX_FEW && !by_thread;
}

// Return the solver's pass with only the features in use. `listed` is 1 if colliders are looked up
// in the grid. `bodies` is 1 if some colliders are neither spheres nor capsules.
static hair_gl_pass solver_pass_for(const struct hair_sim* sim, int listed, int bodies, int by_thread)
{
    static const hair_gl_pass row[] = {
        [HAIR_SOLVER_DIRECT] = HAIR_GL_DIRECT,
        [HAIR_SOLVER_ACCURATE] = HAIR_GL_ACCURATE,
        [HAIR_SOLVER_FOLLOW] = HAIR_GL_FOLLOW,
        [HAIR_SOLVER_REDBLACK] = HAIR_GL_REDBLACK,
    };
    HAIR_ASSERT((size_t)sim->solver < sizeof row / sizeof *row);
    hair_gl_pass features = 0;
    if (hair_sim_contacts(sim) > 0) features |= HAIR_GL_WITH(COLLIDERS);
    if (listed) features |= HAIR_GL_WITH(COLLIDER_GRID);
    if (listed && has_few_guides(sim, by_thread)) features |= HAIR_GL_WITH(FEW_GUIDES);
    if (bodies) features |= HAIR_GL_WITH(BODIES);
    if (bodies && sim->colliders.meshes) features |= HAIR_GL_WITH(MESHES);
    if (bodies && sim->colliders.deforming) features |= HAIR_GL_WITH(DEFORMING);
    if (by_thread) features |= HAIR_GL_WITH(THREAD_PER_GUIDE);
    if (hair_grid_is_on(sim)) features |= HAIR_GL_WITH(HAIR_GRID);
    if (sim->pins.count > 0) features |= HAIR_GL_WITH(PINNED);
    if (hair_scalp_motion_is_on(sim)) features |= HAIR_GL_WITH(SKINNED);
    if (hair_wind_is_on(&sim->wind)) features |= HAIR_GL_WITH(WIND);
    if (hair_sim_has_guide_damping(sim)) features |= HAIR_GL_WITH(GROUP_DAMPING);
    if (hair_impulses_are_on(sim)) features |= HAIR_GL_WITH(IMPULSES);
    hair_gl_pass pass = hair_sim_is_mixed(sim)   ? HAIR_GL_MIXED_SOLVER
                        : hair_sim_is_stiff(sim) ? HAIR_GL_ACCURATE_STIFF
                                                 : row[sim->solver];
    return hair_gl_pass_for(hair_gl_add_features(pass, features), sim->max_vertices);
}

// The lists of two programs are allocated at creation, so this decision is made then. Direct takes
// two programs only for more guides than twice what a GPU runs at once.
bool hair_sim_may_use_two_passes(const struct hair_sim* sim)
{
    if (sim->solver == HAIR_SOLVER_ACCURATE) return true;
    return sim->solver == HAIR_SOLVER_DIRECT && !sim->by_thread && sim->max_vertices <= 32 &&
           sim->gl->units > 0 && sim->guides > 2 * HAIR_PASS1_GUIDES * (uint32_t)sim->gl->units;
}

static bool has_bodies(const struct hair_sim* sim)
{
    return hair_sim_contacts(sim) > sim->colliders.capsules;
}

static hair_gl_pass pass_now(const struct hair_sim* sim)
{
    int bodies = sim->contacts.any ? sim->contacts.grid.bodies > 0 : has_bodies(sim);
    return solver_pass_for(sim, sim->contacts.listed, bodies, hair_sim_is_by_thread(sim));
}

// Return whether guides go through two programs now. Direct does so only for straight hair among
// few capsules, where two programs are faster. Without capsules two programs are slower. With any
// other feature, programs need more registers than that many guides leave them.
static bool uses_two_passes(const struct hair_sim* sim, hair_gl_pass pass)
{
    if (uses_two_passes_by_shake(sim)) return true;
    return sim->two_pass && pass == hair_gl_pass_for(HAIR_GL_DIRECT | HAIR_GL_WITH(COLLIDERS), 1);
}

// Return the second of the two programs that replace `pass`.
static hair_gl_pass listed_pass(const struct hair_sim* sim, hair_gl_pass pass)
{
    HAIR_ASSERT(uses_two_passes(sim, pass));
    if (!is_list_by_thread(sim)) pass &= ~HAIR_GL_WITH(THREAD_PER_GUIDE);
    return pass | HAIR_GL_WITH(PASS2);
}

// Compile `pass`, or the two programs that replace it.
static hair_result ensure_solver(const struct hair_sim* sim, hair_gl_pass pass)
{
    if (!uses_two_passes(sim, pass)) return hair_gl_ensure_program(sim->gl, pass);
    HAIR_TRY(hair_gl_ensure_program(sim->gl, pass | HAIR_GL_WITH(PASS1)));
    return hair_gl_ensure_program(sim->gl, listed_pass(sim, pass));
}

hair_result hair_sim_ensure_solver(struct hair_sim* sim)
{
    return ensure_solver(sim, pass_now(sim));
}

uint32_t hair_sim_flip_work_list(struct hair_sim* sim)
{
    if (uses_two_passes(sim, pass_now(sim))) sim->list = !sim->list;
    return sim->list;
}

// Run the second program over the guides that the first has listed. A software rasteriser runs a
// work group per part of the list, because loop iterations of a thread are limited. A GPU runs a
// fixed number of work groups, each of which takes several parts. An indirect dispatch of an empty
// list takes 45 us longer on an H100.
static void run_list(struct hair_sim* sim, hair_gl_pass listed, uint32_t list)
{
    struct hair_gl* gl = sim->gl;
    if (gl->software) {
        size_t at = (HAIR_SOLVER_STATS_COUNT + list * HAIR_SOLVER_STATS_LIST) * sizeof(uint32_t);
        hair_gl_run_indirect(gl, listed, hair_gl_find(gl, listed)->program, sim->solver_stats, at);
        return;
    }
    uint32_t each = hair_sim_guides_of_list_group(sim);
    uint32_t all = (hair_guide_simulated(sim) + each - 1) / each;
    uint32_t at_once = GROUPS_OF_LIST * (gl->units > 0 ? (uint32_t)gl->units : ASSUMED_UNITS);
    hair_gl_run(gl, listed, all < at_once ? all : at_once);
}

// Run the second program, in as many dispatches as its loop iterations need.
static void run_pass2(struct hair_sim* sim, hair_gl_pass pass, struct hair_step_params* params)
{
    HAIR_ASSERT(0 < params->substeps && params->substeps <= HAIR_STEP_SUBSTEPS && params->list < 2);
    uint32_t count = params->substeps;
    uint32_t rounds = hair_sim_rounds_of_substep(sim, is_list_by_thread(sim)) + hair_sim_part_rounds(sim);
    uint32_t max = substeps_of(sim, rounds);
    for (uint32_t done = 0; done < count; done += max) {
        params->substep_first = done;
        params->substeps = count - done < max ? count : done + max;
        if (count > max) hair_gl_write_uniform(sim->gl, sim->step, sizeof *params, params);
        run_list(sim, listed_pass(sim, pass), params->list);
    }
    params->substep_first = 0;
    params->substeps = count;
}

// Run a program over the guides, in dispatches that a GPU takes not long for.
static void run_in_time(struct hair_sim* sim, hair_gl_pass pass, uint32_t groups, uint32_t substeps)
{
    if (!sim->gl->software) {
        uint32_t guides = hair_sim_guides_in_time(sim, substeps);
        uint32_t each = hair_sim_is_by_thread(sim) ? GUIDES_PER_GROUP : 1;
        hair_gl_limit_groups(sim->gl, pass, (guides + each - 1) / each);
    }
    hair_gl_run(sim->gl, pass, groups);
}

void hair_sim_run_solver(struct hair_sim* sim, struct hair_step_params* params)
{
    hair_gl_pass pass = pass_now(sim);
    uint32_t guides = hair_guide_simulated(sim),
             by_thread = (guides + GUIDES_PER_GROUP - 1) / GUIDES_PER_GROUP;
    uint32_t groups = hair_sim_is_by_thread(sim) ? by_thread : guides;
    if (uses_two_passes_by_shake(sim)) {
        HAIR_ASSERT(sim->two_pass);
        run_in_time(sim, pass | HAIR_GL_WITH(PASS1), groups, params->substeps);
        run_pass2(sim, pass, params);
    } else if (uses_two_passes(sim, pass)) {
        HAIR_ASSERT(sim->gl->units > 0);
        hair_gl_run(sim->gl, pass | HAIR_GL_WITH(PASS1), (uint32_t)sim->gl->units);
        run_list(sim, listed_pass(sim, pass), params->list);
    } else {
        run_in_time(sim, pass, groups, params->substeps);
    }
}

hair_result hair_sim_ensure_programs(struct hair_sim* sim, bool may_derive)
{
    struct hair_gl* gl = sim->gl;
    if (may_derive) HAIR_TRY(hair_guide_level_ensure_programs(sim));
    int listed = hair_contacts_are_listed(sim), by_thread = hair_sim_is_by_thread(sim);
    HAIR_TRY(ensure_solver(sim, solver_pass_for(sim, listed, has_bodies(sim), by_thread)));
    if (listed && sim->by_thread && gl->software) // The lists of a step decide which.
        HAIR_TRY(hair_gl_ensure_program(gl, solver_pass_for(sim, listed, has_bodies(sim), !by_thread)));
    HAIR_TRY(hair_gl_ensure_program(
        gl, hair_sim_smooth_pass(sim, hair_scalp_motion_is_on(sim), hair_targets_are_on(sim))));
    HAIR_TRY(hair_targets_ensure(sim));
    if (sim->physics.sleep_threshold > 0) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_ACTIVITY));
    if (hair_grid_is_on(sim))
        HAIR_TRY(hair_gl_ensure_programs(gl, HAIR_GL_HAIR_GRID_CLEAR, HAIR_GL_HAIR_GRID_GATHER, 0));
    return hair_wind_coupling_ensure_programs(sim);
}
