// loop_budget.c - upper bounds on the loop iterations of a substep on a software rasteriser.
//
// llvmpipe leaves every loop of a shader after 65,535 iterations of all its loops together, and
// reports no error. The functions here therefore count the worst case. In the worst case, all steps
// of all methods are tried and fail, and each vertex is in reach of all colliders. With a thread
// per guide, eight guides run together, and iterate for as long as one of them does. A loop that no
// thread enters takes one iteration. The worst case is too many for iterations from collider to
// collider of a list, which are usually few. Threads count those themselves, and stop at
// HAIR_CONTACT_ROUNDS.
#include "lib/sim/sim.h"

// Number of methods tried before follow-the-leader. For some guides the second method is already
// follow-the-leader.
#define TRIED 2u
#define LOOKS 9u // Length checks per method.
// Newton steps between the length checks. MAX_STEPS of glsl/sim/length_constraints.glsl.
#define STEPS 8u
// Sweeps of follow-the-leader with a heavy tip. HEAVY_ROUNDS of glsl/sim/follow_the_leader.glsl, to
// and fro, and one more.
#define HEAVY_SWEEPS 13
// Times that the solver follow draws a strand again after contact. CONTACT_ROUNDS of
// glsl/sim/follow.comp.
#define DRAWN_AGAIN 3u
// Sweeps of follow-the-leader with pins. PINNED_ROUNDS of glsl/sim/follow_the_leader.glsl, to and
// fro, and two more.
#define PINNED_SWEEPS 18
#define PINNED_ENDS 30 // Iterations per pin that begin and end these sweeps.
// Iterations over cached colliders each time that a vertex of a work group tests colliders. See
// glsl/sim/contact_cache.glsl.
#define CACHED 16
// Times that a vertex tests the colliders of a list, for all methods tried and two for
// follow-the-leader.
#define MAX_LOOKS 20u
#define TIMES 6u // Passes through a list per test. ROUNDS of glsl/sim/contact_grid.glsl.
#define TIMES_WALKED 2u // Passes per test through the colliders that need sphere tracing.
#define MIN_LOOKS 4u // Tests, of one pass each, by a thread that has no iterations left.
#define HALVINGS 10 // Iterations of cyclic reduction by a work group, with those that end the loop.
#define AT_ONCE 8u // Guides that run together with a thread per guide.
#define IDLE 500 // Iterations of loops over methods and steps, and of loops that no thread enters.
#define IDLE_GROUP 250 // Further such iterations of a work group, with those of its sums.

// Number of loops over a strand in one substep.
struct loops {
    uint32_t over; // Loops over independent vertices. A work group runs all vertices at once.
    uint32_t rows; // Tridiagonal systems, solved there and back, or reduced by a work group.
    uint32_t along; // Loops from vertex to vertex, which always run on one thread.
    uint32_t ends; // Iterations that do not depend on the number of vertices.
};

static uint32_t lesser(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// Return STIFFLY of glsl/sim/length_constraints.glsl.
static uint32_t stiff_steps(const struct hair_sim* sim)
{
    return sim->solver == HAIR_SOLVER_DIRECT ? 1 : hair_sim_is_stiff(sim) ? 3 : 0;
}

// Return how many Newton steps the mixed scheme may take in a substep.
static uint32_t newton_steps(const struct hair_sim* sim, int by_thread)
{
    return by_thread ? HAIR_MIXED_STEPS_BY_THREAD(sim->max_vertices) : HAIR_MIXED_STEPS;
}

// Return the loops of the mixed scheme in the worst case, when every attempt at a part of a substep
// takes one Newton step. A step has 14 loops over the guide in mixed_step.glsl and what it
// includes. The begin and end of a part have 23, in mixed.glsl, mixed_chain.glsl, mixed_parts.glsl
// and finish_substep.glsl.
static struct loops loops_of_mixed(const struct hair_sim* sim, int by_thread)
{
    uint32_t max = newton_steps(sim, by_thread), pinned = sim->pins.count > 0;
    struct loops loops = {0};
    loops.over = max * (14 + 23 + 3 * pinned);
    loops.along = max * 7;
    return loops;
}

// Return the loops of follow-the-leader that predict, handle colliders and accept. Loops that draw
// the strand are not included.
static struct loops loops_of_follow(const struct hair_sim* sim)
{
    uint32_t met = hair_sim_contacts(sim) > 0, pinned = sim->pins.count > 0;
    return (struct loops){.over = 4 + pinned + met * (2 + DRAWN_AGAIN * 4)};
}

// Return the loops of all methods, from predict.glsl until length_constraints.glsl fails to find
// the lengths. `first` is 1 for a program that only tries the solver's own method.
static struct loops loops_of_methods(const struct hair_sim* sim, int by_thread, int first)
{
    if (sim->solver == HAIR_SOLVER_FOLLOW) return loops_of_follow(sim);
    if (hair_sim_is_mixed(sim)) return loops_of_mixed(sim, by_thread);
    uint32_t tried = first ? 1 : TRIED, predicted = first ? 1 : tried + 1, pinned = sim->pins.count > 0;
    uint32_t met = hair_sim_contacts(sim) > 0, stiff = stiff_steps(sim);
    struct loops loops = {0};
    loops.over = predicted * (10 + pinned + 3 * met);
    loops.along = predicted * 2;
    loops.over += tried * (LOOKS * (3 + pinned + met) + STEPS * 4 + stiff * 3 + 1);
    loops.rows += tried * STEPS;
    loops.along += tried * stiff * 2;
    return loops;
}

// Add the loops of follow_the_leader.glsl. A strand that touches colliders follows the leader
// twice.
static void add_leader(const struct hair_sim* sim, int by_thread, struct loops* loops)
{
    uint32_t met = hair_sim_contacts(sim) > 0;
    uint32_t led = sim->solver == HAIR_SOLVER_FOLLOW ? 1 + met * DRAWN_AGAIN : TRIED * (1 + met);
    // Guides that run together may have their pins at different vertices.
    uint32_t abreast = by_thread ? lesser(sim->pins.max_per_guide, AT_ONCE) : 1;
    loops->over += led * 3;
    if (sim->pins.count) {
        loops->along += led * (PINNED_SWEEPS * abreast + 1);
        loops->ends += led * PINNED_ENDS * sim->pins.max_per_guide;
    } else {
        loops->along += led * (hair_sim_max_physics(sim).tip_mass > 0 ? HEAVY_SWEEPS : 1);
    }
}

// Return the iterations of a vertex that looks up colliders in a list. Making the list goes through
// it twice for each method tried, and for follow-the-leader.
static uint32_t rounds_of_list(const struct hair_sim* sim, int by_thread)
{
    const struct hair_collider_grid* cells = &sim->contacts.grid;
    HAIR_ASSERT(sim->contacts.listed);
    uint32_t made = 2 * (TRIED + 1) * cells->longest;
    if (by_thread) return made + MIN_LOOKS * (cells->longest + cells->rounds + 4);
    return made + MAX_LOOKS * (TIMES * (cells->longest + 2 + CACHED) + TIMES_WALKED * cells->rounds);
}

// Return the iterations of a vertex over colliders, in all attempts of a substep.
static uint32_t rounds_of_contact(const struct hair_sim* sim, int by_thread)
{
    uint32_t colliders = hair_sim_contacts(sim),
             others = colliders - lesser(sim->colliders.capsules, colliders);
    if (sim->contacts.listed) return rounds_of_list(sim, by_thread);
    // Other colliders need sphere tracing of BODY_STEPS steps. The mixed scheme tests colliders
    // once per Newton step, and twice when it follows the leader.
    uint32_t looks = hair_sim_is_mixed(sim) ? newton_steps(sim, by_thread) + 4 : 44;
    return colliders ? looks * (colliders + 10 + 12 * others) : 0;
}

static uint32_t rounds_of_rod(const struct hair_sim* sim, int by_thread, int first)
{
    HAIR_ASSERT(sim->rods);
    uint32_t around = sim->max_vertices + 1; // The last iteration finds the end.
    uint32_t each = rounds_of_contact(sim, by_thread);
    uint32_t at_root = sim->contacts.listed ? sim->contacts.grid.longest : 2 * (hair_sim_contacts(sim) + 1);
    uint32_t look = (TRIED + 1) * at_root; // Few colliders are also tested once per guide.
    uint32_t spare = sim->contacts.listed ? AT_ONCE * HAIR_CONTACT_ROUNDS : 0;
    struct loops loops = loops_of_methods(sim, by_thread, first);
    if (!first) add_leader(sim, by_thread, &loops);
    loops.over += 6; // The guide is loaded, accepted or reset, and stored. Its turns begin.
    // The impulses of each part of a substep are added up.
    if (hair_impulses_are_on(sim)) loops.over += hair_sim_is_mixed(sim) ? newton_steps(sim, by_thread) : 1;
    loops.over += hair_sim_is_stiff(sim); // The first of two programs asks whether it touches.
    if (hair_wind_is_on(&sim->wind)) each += 4 * (HAIR_WIND_BALLS + HAIR_WIND_SOURCES + 2);
    if (by_thread)
        return around * (loops.over + 2 * loops.rows + loops.along + each) + loops.ends + look + spare + IDLE;
    return 2 * loops.over + HALVINGS * loops.rows + around * loops.along + loops.ends + each + look + IDLE +
           IDLE_GROUP;
}

uint32_t hair_sim_rounds_of_substep(const struct hair_sim* sim, int by_thread)
{
    uint32_t colliders = hair_sim_contacts(sim);
    if (sim->rods) return rounds_of_rod(sim, by_thread, 0);
    return sim->physics.redblack.iterations * (10 + colliders) + 2 * colliders + 20;
}

uint32_t hair_sim_rounds_of_pass1(const struct hair_sim* sim, int by_thread)
{
    return rounds_of_rod(sim, by_thread, 1);
}
