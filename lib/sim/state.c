// state.c - questions about the state of a simulation, and the bindings of its buffers. Every other
// file of this folder may use these functions.
#include "lib/sim/sim.h"

void hair_scalp_motion_bind(struct hair_sim* sim)
{
    if (hair_scalp_motion_is_on(sim))
        hair_gl_bind_texture(sim->gl, HAIR_UNIT_ROOT_TRANSFORM, sim->scalp_motion.texture);
}

void hair_sim_bind(struct hair_sim* sim)
{
    GLuint storage[] = {sim->guide, sim->rest, sim->state};
    hair_gl_bind_buffers(sim->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GUIDE, 3, storage);
    hair_gl_bind_buffers(sim->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SOLVER_STATS, 1, &sim->solver_stats);
    hair_gl_bind_buffers(sim->gl, GL_UNIFORM_BUFFER, HAIR_BIND_STEP, 1, &sim->step);
    hair_scalp_motion_bind(sim);
}

void hair_sim_bind_rods(struct hair_sim* sim)
{
    GLuint storage[] = {sim->rod, sim->history, sim->material, sim->solver_stats,
                        sim->bend ? sim->bend : sim->reduction};
    hair_gl_bind_buffers(sim->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_ROD, 5, storage);
}

uint32_t hair_sim_contacts(const struct hair_sim* sim)
{
    return sim->rods ? sim->colliders.contacts : sim->colliders.capsules;
}

const struct hair_guide* hair_sim_guides(const struct hair_sim* sim, const struct hair_rest** rest)
{
    const struct hair_lengths* lengths = &sim->lengths;
    if (rest) *rest = !sim->rods ? NULL : lengths->guides ? lengths->rest : sim->rods->groom->rest;
    return !sim->rods ? NULL : lengths->guides ? lengths->guides : sim->rods->groom->guides;
}

bool hair_sim_is_mixed(const struct hair_sim* sim)
{
    return sim->rods && sim->rods->mixed;
}

bool hair_sim_is_stiff(const struct hair_sim* sim)
{
    return sim->rods && sim->rods->stiff;
}

hair_gl_pass hair_sim_reset_pass(const struct hair_sim* sim, int skinned)
{
    hair_gl_pass pass = HAIR_GL_RESET;
    if (sim->rods) pass |= HAIR_GL_WITH(ROD);
    if (hair_sim_is_mixed(sim)) pass |= HAIR_GL_WITH(MIXED);
    if (skinned) pass |= HAIR_GL_WITH(SKINNED);
    return pass;
}

hair_gl_pass hair_sim_rotate_pass(const struct hair_sim* sim)
{
    hair_gl_pass pass = sim->rods ? HAIR_GL_ROTATE_STATE | HAIR_GL_WITH(ROD) : HAIR_GL_ROTATE_STATE;
    return hair_sim_is_mixed(sim) ? pass | HAIR_GL_WITH(MIXED) : pass;
}

uint32_t hair_sim_block_length(const struct hair_sim* sim, double time)
{
    HAIR_ASSERT(sim->substep > 0);
    uint32_t substeps = (uint32_t)(time / sim->substep + 0.5);
    return substeps < 1 ? 1 : substeps;
}

uint32_t hair_sim_block_left(uint32_t done, uint32_t length)
{
    return done < length ? length - done : length;
}

bool hair_scalp_motion_is_on(const struct hair_sim* sim)
{
    return sim->scalp_motion.root_transform != 0;
}

bool hair_targets_are_on(const struct hair_sim* sim)
{
    return sim->targets.target != 0;
}

void hair_targets_bind(struct hair_sim* sim)
{
    struct hair_targets* targets = &sim->targets;
    GLuint storage[] = {targets->position[0], targets->target};
    HAIR_ASSERT(hair_targets_are_on(sim));
    hair_gl_bind_buffers(sim->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_TARGET_POSITION, 2, storage);
    hair_gl_bind_buffers(sim->gl, GL_UNIFORM_BUFFER, HAIR_BIND_TARGET_PARAMS, 1, &targets->params);
}

hair_gl_pass hair_sim_smooth_pass(const struct hair_sim* sim, bool is_skinned, bool has_targets)
{
    hair_gl_pass pass = hair_gl_pass_for(HAIR_GL_SMOOTH, sim->max_vertices);
    if (is_skinned) pass |= HAIR_GL_WITH(SKINNED);
    return has_targets ? pass | HAIR_GL_WITH(TARGETS) : pass;
}

bool hair_sim_may_leave(const struct hair_sim* sim)
{
    return sim->physics.root == HAIR_ROOT_FREE || sim->pins.count || hair_scalp_motion_is_on(sim) ||
           hair_targets_are_on(sim);
}

bool hair_grid_is_on(const struct hair_sim* sim)
{
    return sim->rods &&
           (sim->physics.hair_hair.cohesion > 0 || sim->physics.hair_hair.pressure_stiffness > 0);
}
