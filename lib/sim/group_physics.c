// group_physics.c - physics of groups of strands. Only damping and the numbers of which rods are
// made can differ by group. Everything else is a parameter of all guides. The groom's factors of
// each guide multiply the physics of its group.
#include "lib/sim/sim.h"

void hair_sim_copy_group_members(const hair_physics* from, hair_physics* to)
{
    to->damping = from->damping;
    to->fiber.youngs_modulus = from->fiber.youngs_modulus;
    to->shape = from->shape;
    to->tip_mass = from->tip_mass;
}

const hair_physics* hair_sim_groups(const struct hair_sim* sim)
{
    return sim->groups.version ? sim->groups.physics : NULL;
}

// Return the groom if its guides have factors. Solvers without rods ignore them.
static const struct hair_groom* groom_with_factors(const struct hair_sim* sim)
{
    const struct hair_groom* groom = sim->rods ? sim->rods->groom : NULL;
    return groom && groom->guide_factors ? groom : NULL;
}

hair_physics hair_sim_max_physics(const struct hair_sim* sim)
{
    const hair_physics* groups = hair_sim_groups(sim);
    const struct hair_groom* groom = groom_with_factors(sim);
    hair_physics max = sim->physics;
    for (int g = 0; groups && g < HAIR_MAX_STRAND_GROUPS; ++g) {
        max.shape.frequency_root = fmaxf(max.shape.frequency_root, groups[g].shape.frequency_root);
        max.shape.frequency_tip = fmaxf(max.shape.frequency_tip, groups[g].shape.frequency_tip);
        max.tip_mass = fmaxf(max.tip_mass, groups[g].tip_mass);
    }
    return groom ? hair_physics_multiply(&max, &groom->max_factors) : max;
}

bool hair_sim_has_guide_damping(const struct hair_sim* sim)
{
    const hair_physics* groups = hair_sim_groups(sim);
    const struct hair_groom* groom = groom_with_factors(sim);
    if (groom && (groom->min_factors.damping != 1 || groom->max_factors.damping != 1)) return true;
    for (int g = 0; groups && g < HAIR_MAX_STRAND_GROUPS; ++g)
        if (groups[g].damping != sim->physics.damping) return true;
    return false;
}

float hair_sim_min_damping(const struct hair_sim* sim)
{
    const hair_physics* groups = hair_sim_groups(sim);
    const struct hair_groom* groom = groom_with_factors(sim);
    float min = sim->physics.damping;
    for (int g = 0; groups && g < HAIR_MAX_STRAND_GROUPS; ++g) min = fminf(min, groups[g].damping);
    return groom ? min * groom->min_factors.damping : min;
}

// Compute the physics of all groups again. `physics` are new ones of `group`, or NULL.
static void recompute_groups(struct hair_sim* sim, uint32_t group, const hair_physics* physics)
{
    struct hair_group_physics* groups = &sim->groups;
    bool differs = false, has_changed = false;
    for (uint32_t g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) {
        hair_physics now = sim->physics;
        const hair_physics* own = physics && g == group ? physics : &groups->physics[g];
        if (groups->own >> g & 1) hair_sim_copy_group_members(own, &now);
        has_changed |= hair_rods_differ(&now, &groups->physics[g]);
        differs |= hair_rods_differ(&now, &sim->physics);
        groups->physics[g] = now;
    }
    if (!has_changed && differs == (groups->version != 0)) return;
    groups->version = differs ? ++groups->last_version : 0;
    hair_sleep_wake(sim);
}

void hair_sim_update_groups(struct hair_sim* sim)
{
    if (sim->groups.physics) recompute_groups(sim, 0, NULL);
}

hair_result hair_sim_set_group_physics(struct hair_sim* sim, uint32_t group, const hair_physics* physics)
{
    struct hair_group_physics* groups = &sim->groups;
    HAIR_ASSERT(group < HAIR_MAX_STRAND_GROUPS && sim->rods);
    if (!groups->physics) {
        if (!physics) return HAIR_OK;
        groups->physics = hair_alloc(&sim->gl->host, HAIR_MAX_STRAND_GROUPS, sizeof *groups->physics);
        if (!groups->physics) return hair_fail_memory(&sim->gl->host, "the physics of groups");
        for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) groups->physics[g] = sim->physics;
    }
    groups->own = (groups->own & ~(1u << group)) | (uint32_t)(physics != NULL) << group;
    recompute_groups(sim, group, physics);
    return HAIR_OK;
}
