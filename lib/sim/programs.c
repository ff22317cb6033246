// programs.c - which programs a simulation runs, and how much of it at once.
#include "lib/sim/sim.h"

#define MOST_FEW 2048     // guides: so many a GPU has under way at once, whatever registers they take
#define MOST_ROUNDS 65000 // that a software rasteriser may go in one thread: see rounds.c

// Where a thread would have too much to do, it is a work group's.
int hair_sim_is_by_thread(const struct hair_sim* sim)
{
    return sim->by_thread && (!sim->gl->software || hair_sim_rounds_of_substep(sim, 1) <= MOST_ROUNDS);
}

uint32_t hair_sim_substeps_at_once(const struct hair_sim* sim)
{
    if (!sim->gl->software) return HAIR_STEP_SUBSTEPS;
    uint32_t most = MOST_ROUNDS / hair_sim_rounds_of_substep(sim, hair_sim_is_by_thread(sim));
    return most < 1 ? 1 : most < HAIR_STEP_SUBSTEPS ? most : HAIR_STEP_SUBSTEPS;
}

// Guides whose work groups wait for the solids that they look up, and so keep them at hand and read several at once: of 1,024
// on an H200 a body of a thousand balls takes 1.9 times what one of ten capsules does. Of 10,201, without either, 2.3 times;
// with them more, for they take registers that others want.
static int has_few_guides(const struct hair_sim* sim, int by_thread)
{
    return sim->guides <= MOST_FEW && !by_thread;
}

// Compiled with what there is, and with nothing else. `any` number of solids, among them `bodies`.
static hair_gl_pass solver_pass_for(const struct hair_sim* sim, int any, int bodies, int by_thread)
{
    static const hair_gl_pass row[] = {
        [HAIR_SOLVER_DIRECT]   = HAIR_GL_DIRECT,
        [HAIR_SOLVER_ACCURATE] = HAIR_GL_ACCURATE,
        [HAIR_SOLVER_FOLLOW]   = HAIR_GL_FOLLOW,
        [HAIR_SOLVER_REDBLACK] = HAIR_GL_REDBLACK,
    };
    hair_gl_pass features = 0;
    if (any || hair_sim_contacts(sim) > 0) features |= HAIR_GL_WITH(SOLIDS);
    if (any) features |= HAIR_GL_WITH(ANY);
    if (any && has_few_guides(sim, by_thread)) features |= HAIR_GL_WITH(FEW);
    if (bodies) features |= HAIR_GL_WITH(BODIES);
    if (hair_sim_is_curved(sim)) features |= HAIR_GL_WITH(CURVED);
    if (by_thread) features |= HAIR_GL_WITH(THREAD);
    if (hair_crowd_is_on(sim)) features |= HAIR_GL_WITH(CROWD);
    if (sim->ties.count > 0) features |= HAIR_GL_WITH(TIED);
    if (hair_skin_is_on(sim)) features |= HAIR_GL_WITH(SKINNED);
    if (hair_wind_is_on(&sim->wind)) features |= HAIR_GL_WITH(WIND);
    hair_gl_pass pass = hair_sim_is_stiff(sim) ? HAIR_GL_ACCURATE_STIFF : row[sim->solver];
    return hair_gl_pass_for(hair_gl_with(pass, features), sim->most_vertices);
}

static int has_bodies(const struct hair_sim* sim)
{
    return hair_sim_contacts(sim) > sim->solids.capsules;
}

hair_gl_pass hair_sim_solver_pass(const struct hair_sim* sim)
{
    int any    = sim->contacts.any;
    int bodies = any ? sim->contacts.cells.bodies > 0 : has_bodies(sim);
    return solver_pass_for(sim, any, bodies, hair_sim_is_by_thread(sim));
}

hair_gl_pass hair_sim_reset_pass(const struct hair_sim* sim, int skinned)
{
    hair_gl_pass pass = HAIR_GL_RESET;
    if (sim->rods) pass |= HAIR_GL_WITH(ROD);
    if (skinned) pass |= HAIR_GL_WITH(SKINNED);
    return pass;
}

hair_gl_pass hair_sim_turn_pass(const struct hair_sim* sim)
{
    return sim->rods ? HAIR_GL_TURN | HAIR_GL_WITH(ROD) : HAIR_GL_TURN;
}

hair_result hair_sim_need_programs(struct hair_sim* sim)
{
    struct hair_gl* gl  = sim->gl;
    int             any = hair_contacts_are_any(sim), by_thread = hair_sim_is_by_thread(sim);
    hair_gl_pass    smooth = hair_skin_is_on(sim) ? HAIR_GL_SMOOTH | HAIR_GL_WITH(SKINNED) : HAIR_GL_SMOOTH;
    hair_result     result = hair_gl_need(gl, solver_pass_for(sim, any, has_bodies(sim), by_thread));
    if (!result && any && sim->by_thread && gl->software) // Lists say which, from step to step.
        result = hair_gl_need(gl, solver_pass_for(sim, any, has_bodies(sim), !by_thread));
    if (!result) result = hair_gl_need(gl, hair_gl_pass_for(smooth, sim->most_vertices));
    if (!result && sim->physics.sleep > 0) result = hair_gl_need(gl, HAIR_GL_STIR);
    if (!result && hair_crowd_is_on(sim))
        result = hair_gl_need_rows(gl, HAIR_GL_CROWD_CLEAR, HAIR_GL_CROWD_GATHER, 0);
    return result ? result : hair_blow_need_programs(sim);
}
