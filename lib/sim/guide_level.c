// guide_level.c - the level of detail of guides. glsl/sim/derive_guides.comp has the passes.
#include "lib/sim/sim.h"

// Time in which derived guides lose 63 % of the difference from their parents, s. Hair that
// changes its level does not leap then.
#define BLEND_TIME 0.25

uint32_t hair_guide_stride(const struct hair_sim* sim)
{
    bool may_derive = hair_sim_has_attached_strands(sim) && !hair_impulses_are_on(sim);
    return may_derive ? sim->guide_level.wanted : 1;
}

uint32_t hair_guide_simulated(const struct hair_sim* sim)
{
    uint32_t stride = hair_guide_stride(sim);
    return (sim->guides + stride - 1) / stride;
}

void hair_guide_level_write(const struct hair_sim* sim, struct hair_step_params* params, double time)
{
    params->guide_stride = hair_guide_stride(sim);
    params->simulated = hair_guide_simulated(sim);
    params->guide_order = sim->guide_order;
    params->guide_keep = (float)exp(-time / BLEND_TIME);
}

static hair_gl_pass derive_pass(const struct hair_sim* sim, hair_gl_pass pass)
{
    return hair_sim_is_mixed(sim) ? pass | HAIR_GL_WITH(MIXED) : pass;
}

hair_result hair_guide_level_ensure_programs(struct hair_sim* sim)
{
    HAIR_TRY(hair_gl_ensure_program(sim->gl, derive_pass(sim, HAIR_GL_DERIVE_BEGIN)));
    return hair_gl_ensure_program(sim->gl, derive_pass(sim, HAIR_GL_DERIVE_GUIDES));
}

hair_result hair_guide_level_ensure(struct hair_sim* sim)
{
    return hair_guide_stride(sim) > 1 ? hair_guide_level_ensure_programs(sim) : HAIR_OK;
}

static void run(struct hair_sim* sim, hair_gl_pass pass)
{
    uint32_t derived = sim->guides - hair_guide_simulated(sim);
    if (derived) hair_gl_run(sim->gl, derive_pass(sim, pass), derived);
}

void hair_guide_level_begin(struct hair_sim* sim)
{
    uint32_t stride = hair_guide_stride(sim), last = sim->guide_level.last;
    sim->guide_level.last = stride;
    if (stride != last) run(sim, HAIR_GL_DERIVE_BEGIN);
}

void hair_guide_level_end(struct hair_sim* sim)
{
    run(sim, HAIR_GL_DERIVE_GUIDES);
}
