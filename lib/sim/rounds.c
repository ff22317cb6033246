// rounds.c - how often a software rasteriser goes round the loops of a substep.
//
// llvmpipe leaves every loop of a shader once it has gone round 65,535 times in all its loops
// together, and says nothing. So it is counted at the worst: methods are tried with all their
// steps, and fail; each vertex is in reach of all solids. Of eight guides, each a thread's, all go
// round for as long as one of them does. A loop that nobody enters goes round once. Only rounds
// from solid to solid of a list would be too many so, though there are few as a rule: a thread
// counts those itself, and stops at HAIR_CONTACT_ROUNDS.
#include "lib/sim/sim.h"

#define TRIED 2u // methods, before a last one follows the leader. It may be some guides' second.
#define LOOKS 9u // at lengths, for each of them, and
#define STEPS 8u // between these: MOST_STEPS of glsl/sim/lengths.glsl
#define HEAVY_SWEEPS                                                                                         \
    13 // of following the leader: HEAVY_ROUNDS of glsl/sim/leader.glsl, to and fro, and once more
#define DRAWN_AGAIN 3u // by follow, after contact: CONTACT_ROUNDS of glsl/sim/follow.comp
#define TIED_SWEEPS 18 // likewise, TIED_ROUNDS,
#define TIED_ENDS 30 // and what begins and ends these, for each tie
#define CACHED 16 // of a work group, each time that a vertex looks at solids: see glsl/sim/contact_cache.glsl
#define MOST_LOOKS 20u // at solids of a list: for each method tried, and two of what is led. Each goes
#define TIMES 6u // through it, ROUNDS of glsl/sim/contact_any.glsl, and
#define TIMES_WALKED 2u // to those that are walked through
#define LEAST_LOOKS 4u // of a thread that has no rounds left, each once through
#define HALVINGS 10 // of a work group's vertices, and what ends them: cyclic reduction
#define AT_ONCE 8u // guides, where each is a thread's
#define IDLE 500 // of loops that go over methods and steps, and of those that nobody enters,
#define IDLE_GROUP 250 // more of a work group, and what it sums up

// Of one substep, loops over a strand.
struct loops {
    uint32_t over; // each vertex by itself: a work group goes over all of them at once
    uint32_t rows; // tridiagonal systems: there and back, or a work group's reduction
    uint32_t along; // from vertex to vertex, which is one thread's in any case
    uint32_t ends; // rounds, whatever the strand has
};

static uint32_t lesser(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// STIFFLY of glsl/sim/lengths.glsl.
static uint32_t stiff_steps(const struct hair_sim* sim)
{
    return sim->solver == HAIR_SOLVER_DIRECT ? 1 : hair_sim_is_stiff(sim) ? 3 : 0;
}

// Return how many Newton steps the mixed scheme may take in a substep.
static uint32_t newton_steps(const struct hair_sim* sim, int by_thread)
{
    return by_thread ? HAIR_MIXED_STEPS_BY_THREAD(sim->most_vertices) : HAIR_MIXED_STEPS;
}

// Return the loops of the mixed scheme at the worst, when every attempt at a part of a substep
// takes one Newton step. In a step 14 loops go over the guide in mixed_step.glsl and what it
// includes. Where a part begins and ends 23 do, in mixed.glsl, mixed_chain.glsl, mixed_parts.glsl
// and accept.glsl.
static struct loops loops_of_mixed(const struct hair_sim* sim, int by_thread)
{
    uint32_t most = newton_steps(sim, by_thread), tied = sim->ties.count > 0;
    struct loops loops = {0};
    loops.over = most * (14 + 23 + 3 * tied);
    loops.along = most * 7;
    return loops;
}

// Return the loops of follow-the-leader, but for its drawing: what predicts, meets solids and
// accepts.
static struct loops loops_of_follow(const struct hair_sim* sim)
{
    uint32_t met = hair_sim_contacts(sim) > 0, tied = sim->ties.count > 0;
    return (struct loops){.over = 4 + tied + met * (2 + DRAWN_AGAIN * 4)};
}

// From where predict.glsl says that a strand would go, to lengths.glsl saying that they cannot be
// found.
static struct loops loops_of_methods(const struct hair_sim* sim, int by_thread, int first)
{
    if (sim->solver == HAIR_SOLVER_FOLLOW) return loops_of_follow(sim);
    if (hair_sim_is_mixed(sim)) return loops_of_mixed(sim, by_thread);
    uint32_t tried = first ? 1 : TRIED, predicted = first ? 1 : tried + 1, tied = sim->ties.count > 0;
    uint32_t met = hair_sim_contacts(sim) > 0, stiff = stiff_steps(sim);
    struct loops loops = {0};
    loops.over = predicted * (10 + tied + 3 * met);
    loops.along = predicted * 2;
    loops.over += tried * (LOOKS * (3 + tied + met) + STEPS * 4 + stiff * 3);
    loops.rows += tried * STEPS;
    loops.along += tried * stiff * 2;
    return loops;
}

// What leader.glsl adds. A strand that solids have a hand in is led twice.
static void add_leader(const struct hair_sim* sim, int by_thread, struct loops* loops)
{
    uint32_t met = hair_sim_contacts(sim) > 0;
    uint32_t led = sim->solver == HAIR_SOLVER_FOLLOW ? 1 + met * DRAWN_AGAIN : TRIED * (1 + met);
    uint32_t abreast = by_thread ? lesser(sim->ties.most, AT_ONCE) : 1; // Their spans are where they like.
    loops->over += led * 3;
    if (sim->ties.count) {
        loops->along += led * (TIED_SWEEPS * abreast + 1);
        loops->ends += led * TIED_ENDS * sim->ties.most;
    } else {
        loops->along += led * (sim->physics.tip_mass > 0 ? HEAVY_SWEEPS : 1);
    }
}

// Of a vertex that looks up solids in a list, which is gone through twice for each method and the
// last when it is made.
static uint32_t rounds_of_list(const struct hair_sim* sim, int by_thread)
{
    const struct hair_cells* cells = &sim->contacts.cells;
    uint32_t made = 2 * (TRIED + 1) * cells->longest;
    if (by_thread) return made + LEAST_LOOKS * (cells->longest + cells->rounds + 4);
    return made + MOST_LOOKS * (TIMES * (cells->longest + 2 + CACHED) + TIMES_WALKED * cells->rounds);
}

// Of a vertex, in all tries of a substep.
static uint32_t rounds_of_contact(const struct hair_sim* sim, int by_thread)
{
    uint32_t solids = hair_sim_contacts(sim), others = solids - lesser(sim->solids.capsules, solids);
    if (sim->contacts.any) return rounds_of_list(sim, by_thread);
    // Others are walked through: BODY_STEPS. The mixed scheme looks once in a Newton step, and
    // twice when it leads.
    uint32_t looks = hair_sim_is_mixed(sim) ? newton_steps(sim, by_thread) + 4 : 44;
    return solids ? looks * (solids + 10 + 12 * others) : 0;
}

static uint32_t rounds_of_rod(const struct hair_sim* sim, int by_thread, int first)
{
    uint32_t around = sim->most_vertices + 1; // A loop goes round once more to find that it is at its end.
    uint32_t each = rounds_of_contact(sim, by_thread);
    uint32_t at_root = sim->contacts.any ? sim->contacts.cells.longest : 2 * (hair_sim_contacts(sim) + 1);
    uint32_t look = (TRIED + 1) * at_root; // Of few solids also by guide.
    uint32_t spare = sim->contacts.any ? AT_ONCE * HAIR_CONTACT_ROUNDS : 0;
    struct loops loops = loops_of_methods(sim, by_thread, first);
    if (!first) add_leader(sim, by_thread, &loops);
    loops.over += 4; // It is loaded, taken for true or put back, and stored.
    if (hair_wind_is_on(&sim->wind)) each += 4 * (HAIR_WIND_BALLS + HAIR_WIND_SOURCES + 2);
    if (by_thread)
        return around * (loops.over + 2 * loops.rows + loops.along + each) + loops.ends + look + spare + IDLE;
    return 2 * loops.over + HALVINGS * loops.rows + around * loops.along + loops.ends + each + look + IDLE +
           IDLE_GROUP;
}

uint32_t hair_sim_rounds_of_substep(const struct hair_sim* sim, int by_thread)
{
    uint32_t solids = hair_sim_contacts(sim);
    if (sim->rods) return rounds_of_rod(sim, by_thread, 0);
    return sim->physics.iterations * (10 + solids) + 2 * solids + 20;
}

uint32_t hair_sim_rounds_of_first(const struct hair_sim* sim, int by_thread)
{
    return rounds_of_rod(sim, by_thread, 1);
}
