// time_budget.c - how many guides and substeps a dispatch of a GPU computes.
//
// An operating system resets a GPU that takes too long for a dispatch. The costs here are those
// that `hair-bench dispatch` measured on an H100. A dispatch has fewer guides first, because a
// dispatch of fewer substeps loads and stores the guides more often. Too few guides would leave
// parts of the GPU idle, so then a dispatch has fewer substeps.
#include "lib/sim/sim.h"

#define FULL 65536 // Vertices that keep all multiprocessors of a GPU busy.
#define LONG 56 // Vertices of a guide from which on the cost of a vertex grows with their square.
#define SHORT 32 // Maximum vertices of a guide that fits into a subgroup.
// Ratios of the cost among colliders that are looked up in the grid to that without.
#define GRID_COST 2
#define MANY_COST 15
// Vertices of the guides beyond which a vertex costs twice as much, because caches hold few.
#define LARGE (1u << 20)

static bool has_many_colliders(const struct hair_sim* sim)
{
    return sim->contacts.any && hair_sim_colliders(sim)->count >= HAIR_MANY_COLLIDERS;
}

// Return the time of a vertex in a substep of the solver, ns.
static double cost_of_short(const struct hair_sim* sim)
{
    bool accurate = sim->solver == HAIR_SOLVER_ACCURATE;
    if (sim->solver == HAIR_SOLVER_FOLLOW) return 1.2;
    if (sim->solver == HAIR_SOLVER_REDBLACK) return 1.25;
    if (hair_sim_is_mixed(sim)) return accurate ? 0.9 : 1.43;
    bool fits = sim->max_vertices <= SHORT && !hair_sim_is_stiff(sim);
    return accurate ? (fits ? 0.025 : 0.135) : (fits ? 0.1 : 0.2);
}

// Return the same with the guides' length and the colliders.
static double cost_of_vertex(const struct hair_sim* sim)
{
    double ratio = (double)sim->max_vertices / LONG, cost = cost_of_short(sim);
    if (ratio > 1 && sim->solver != HAIR_SOLVER_REDBLACK) cost *= ratio * ratio;
    if (sim->guide_vertices > LARGE) cost *= 2;
    if (has_many_colliders(sim)) return MANY_COST * cost;
    return sim->contacts.any ? GRID_COST * cost : cost;
}

// Return how many vertices a dispatch can move by a substep in its time.
static double vertices_in_time(const struct hair_sim* sim)
{
    HAIR_ASSERT(!sim->gl->software && sim->gl->dispatch_ms > 0);
    return 1e6 * sim->gl->dispatch_ms / cost_of_vertex(sim);
}

uint32_t hair_sim_substeps_in_time(const struct hair_sim* sim)
{
    if (has_many_colliders(sim)) return 1;
    uint32_t vertices = sim->guide_vertices < FULL ? sim->guide_vertices : FULL;
    double substeps = vertices_in_time(sim) / vertices;
    return substeps < 1 ? 1 : substeps < HAIR_STEP_SUBSTEPS ? (uint32_t)substeps : HAIR_STEP_SUBSTEPS;
}

uint32_t hair_sim_guides_in_time(const struct hair_sim* sim, uint32_t substeps)
{
    HAIR_ASSERT(substeps > 0 && sim->max_vertices > 0);
    double guides = vertices_in_time(sim) / ((double)substeps * sim->max_vertices);
    return guides < 1 ? 1 : guides < sim->guides ? (uint32_t)guides : sim->guides;
}
