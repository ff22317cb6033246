// group_physics.c - public calls that set and get the physics of groups of strands.
#include "lib/api/api.h"

#include <string.h>

hair_result hair_check_group(const hair_instance* hair, uint32_t group)
{
    if (group < HAIR_MAX_STRAND_GROUPS) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: group is %u, not in [0, %d]",
                     hair->label, group, HAIR_MAX_STRAND_GROUPS - 1);
}

// Check that the physics of a group differ from those of the instance only in members that can
// differ by group.
static hair_result check_shared_members(const hair_instance* hair, uint32_t group,
                                        const hair_physics* physics)
{
    const hair_host* host = &hair->context->host;
    const struct hair_schema schema = hair_schema_of_hair_physics();
    hair_physics shared = hair->sim.physics;
    hair_sim_copy_group_members(physics, &shared);
    for (uint32_t i = 0; i < schema.count; ++i) {
        const hair_member* m = &schema.member[i];
        char own[512], all[512];
        if (memcmp((const char*)physics + m->offset, (const char*)&shared + m->offset, m->size * m->count) ==
            0)
            continue;
        HAIR_TRY(hair_get_member(host, HAIR_STRUCT_PHYSICS, physics, sizeof *physics, m->name, own,
                                 sizeof own, NULL));
        HAIR_TRY(hair_get_member(host, HAIR_STRUCT_PHYSICS, &shared, sizeof shared, m->name, all, sizeof all,
                                 NULL));
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_physics.%s is %s for group %u but %s for the instance, and this member "
                         "cannot differ by group",
                         hair->label, m->name, own, group, all);
    }
    return HAIR_OK;
}

hair_result hair_set_group_physics(hair_instance* hair, uint32_t group, const hair_physics* physics)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    hair_physics own;
    HAIR_TRY(hair_check_group(hair, group));
    if (physics) HAIR_TRY(HAIR_COPY_IN(host, hair_physics, physics, &own));
    if (!hair->sim.rods)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: the physics of groups cannot differ with the solver redblack", hair->label);
    if (physics) HAIR_TRY(check_shared_members(hair, group, &own));
    return hair_sim_set_group_physics(&hair->sim, group, physics ? &own : NULL);
}

hair_result hair_get_group_physics(const hair_instance* hair, uint32_t group, hair_physics* out)
{
    HAIR_TRY(hair_check_instance(hair));
    HAIR_TRY(hair_check_group(hair, group));
    const hair_physics* groups = hair_sim_groups(&hair->sim);
    const hair_physics* own = groups ? &groups[group] : &hair->sim.physics;
    return HAIR_COPY_OUT(&hair->context->host, hair_physics, own, out);
}
