// settings.c - what the application sets between steps, and asks about the last step.
#include "lib/sim/sim.h"

#include <string.h>

void hair_sim_set_physics(struct hair_sim* sim, const hair_physics* physics)
{
    sim->physics = *physics;
    hair_sim_update_groups(sim);
}

void hair_sim_set_wind(struct hair_sim* sim, const hair_wind* wind)
{
    hair_wind_source* sources = sim->wind_state.source;
    size_t size = wind->source_count * sizeof *sources;
    HAIR_ASSERT(wind->source_count <= HAIR_WIND_SOURCES && wind->sources != sources);
    if (size && memcmp(sources, wind->sources, size) != 0) hair_sleep_wake(sim);
    if (size) memcpy(sources, wind->sources, size);
    sim->wind = *wind;
    sim->wind.sources = size ? sources : NULL;
}

void hair_sim_set_head(struct hair_sim* sim, const struct hair_pose* head)
{
    sim->head = *head;
}

hair_result hair_sim_set_colliders(struct hair_sim* sim, const hair_collider* colliders, uint32_t count,
                                   size_t stride)
{
    sim->colliders.home = sim->contacts.sdf_pool;
    return hair_colliders_set(&sim->gl->host, &sim->colliders, colliders, count, stride);
}

const struct hair_collider_list* hair_sim_colliders(const struct hair_sim* sim)
{
    return &sim->colliders.current;
}

bool hair_sim_has_new_colliders(const struct hair_sim* sim)
{
    return sim->colliders.changed != 0;
}

void hair_sim_set_unseen_time(struct hair_sim* sim, double seconds)
{
    HAIR_ASSERT(seconds >= 0);
    sim->unseen = fmin(seconds, 1);
}

void hair_sim_scale_substep_rate(struct hair_sim* sim, float factor)
{
    HAIR_ASSERT(0 < factor && factor <= 1);
    sim->rate_factor = factor;
}

void hair_sim_set_interval(struct hair_sim* sim, uint32_t frames)
{
    sim->interval = frames > 1 ? frames : 1;
}

void hair_sim_set_guide_stride(struct hair_sim* sim, uint32_t stride)
{
    HAIR_ASSERT(0 < stride && stride <= HAIR_MAX_GUIDE_STRIDE && (stride & (stride - 1)) == 0);
    sim->guide_level.wanted = stride;
}

bool hair_sim_has_fixed_roots(const struct hair_sim* sim)
{
    return (sim->physics.root != HAIR_ROOT_FREE || !sim->rods) && !hair_scalp_motion_is_on(sim) &&
           !hair_targets_are_on(sim);
}

bool hair_sim_has_attached_strands(const struct hair_sim* sim)
{
    return sim->rods && !hair_sim_may_leave(sim);
}

bool hair_sim_has_wind(const struct hair_sim* sim)
{
    return sim->wind_state.params != 0;
}

const struct hair_fluid* hair_sim_fluid(const struct hair_sim* sim)
{
    return sim->wind_state.box.w > 0 ? &sim->wind_coupling.fluid : NULL;
}

bool hair_sim_is_diagnosed(const struct hair_sim* sim)
{
    return sim->diagnosis.wanted != 0;
}
