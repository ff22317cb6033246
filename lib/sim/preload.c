// preload.c - gravity preload of the guides. The preload is computed again when physics or lengths
// change, and only for guides whose length has changed if the physics are the same.
#include "lib/sim/sim.h"

#include <string.h>

struct hair_rod_source hair_sim_rod_source(const struct hair_sim* sim)
{
    const struct hair_rest* rest;
    const struct hair_guide* guides = hair_sim_guides(sim, &rest);
    return (struct hair_rod_source){.host = &sim->gl->host,
                                    .tasks = &sim->rods->groom->tasks,
                                    .guides = guides,
                                    .rest = rest,
                                    .groups = hair_sim_groups(sim),
                                    .factors = sim->rods->groom->guide_factors,
                                    .count = sim->guides,
                                    .vertices = sim->guide_vertices,
                                    .max_vertices = sim->max_vertices};
}

// Gravity preload that is computed.
struct new_preload {
    struct hair_rod_borne* borne;
    float *sags, *fractions;
    bool* changed;
};

static void free_preload(const hair_host* host, struct new_preload* made)
{
    hair_free(host, made->borne);
    hair_free(host, made->sags);
    hair_free(host, made->fractions);
    hair_free(host, made->changed);
}

// Keep the preload of guides whose lengths have not changed. The physics have not changed either.
static void keep_preload(const struct hair_sim* sim, const struct new_preload* made)
{
    const struct hair_rods* rods = sim->rods;
    memcpy(made->borne, rods->borne, sim->guide_vertices * sizeof *made->borne);
    memcpy(made->sags, rods->sags, sim->guides * sizeof *made->sags);
    for (uint32_t i = 0; i < sim->guides; ++i)
        made->changed[i] =
            hair_sim_length_fraction(sim, i) != (rods->borne_fractions ? rods->borne_fractions[i] : 1);
}

static hair_result compute_preload(struct hair_sim* sim, bool keeps, struct new_preload* made)
{
    const hair_host* host = &sim->gl->host;
    const struct hair_rod_source source = hair_sim_rod_source(sim);
    made->borne = hair_alloc_undefined(host, sim->guide_vertices, sizeof *made->borne);
    made->sags = hair_alloc_undefined(host, sim->guides, sizeof *made->sags);
    made->changed = hair_alloc_undefined(host, sim->guides, sizeof *made->changed);
    if (sim->lengths.guides)
        made->fractions = hair_alloc_undefined(host, sim->guides, sizeof *made->fractions);
    if (!made->borne || !made->sags || !made->changed || (sim->lengths.guides && !made->fractions))
        return hair_fail_memory(host, "the guides as rods");
    for (uint32_t i = 0; made->fractions && i < sim->guides; ++i)
        made->fractions[i] = hair_sim_length_fraction(sim, i);
    if (keeps) keep_preload(sim, made);
    return hair_rods_preload_all(&source, &sim->physics, keeps ? made->changed : NULL, made->borne,
                                 made->sags);
}

// Use a preload in place of the present one, which `made` receives.
static void use_preload(struct hair_sim* sim, struct new_preload* made)
{
    struct hair_rods* rods = sim->rods;
    const struct new_preload was = {
        .borne = rods->own_borne, .sags = rods->own_sags, .fractions = rods->borne_fractions};
    rods->own_borne = made->borne, rods->own_sags = made->sags, rods->borne_fractions = made->fractions;
    made->borne = was.borne, made->sags = was.sags, made->fractions = was.fractions;
}

hair_result hair_sim_preload(struct hair_sim* sim)
{
    struct hair_rods* rods = sim->rods;
    const struct hair_prepared_rods* p = rods->groom->prepared;
    const bool keeps = rods->borne && rods->borne_for_groups == sim->groups.version &&
                       !hair_rods_differ(&rods->borne_for, &sim->physics);
    struct new_preload made = {0};
    struct hair_rods_report report;
    if (keeps && rods->borne_for_lengths == sim->lengths.version) return HAIR_OK;
    if (p && !hair_sim_groups(sim) && !sim->lengths.guides && !hair_rods_differ(&p->physics, &sim->physics)) {
        use_preload(sim, &made);
        rods->borne = p->borne, rods->sags = p->sags;
        report = p->report;
    } else {
        hair_result result = compute_preload(sim, keeps, &made);
        if (result) {
            free_preload(&sim->gl->host, &made);
            return result;
        }
        use_preload(sim, &made);
        rods->borne = rods->own_borne, rods->sags = rods->own_sags;
        report = hair_rods_report_of(rods->groom->guides, sim->guides, rods->borne, rods->sags);
    }
    free_preload(&sim->gl->host, &made);
    report.softened = rods->report.softened;
    rods->report = report;
    rods->borne_for = sim->physics;
    rods->borne_for_groups = sim->groups.version;
    rods->borne_for_lengths = sim->lengths.version;
    return HAIR_OK;
}

void hair_sim_free_preload(struct hair_sim* sim)
{
    hair_free(&sim->gl->host, sim->rods->own_borne);
    hair_free(&sim->gl->host, sim->rods->own_sags);
    hair_free(&sim->gl->host, sim->rods->borne_fractions);
}

struct hair_rods_report hair_sim_preload_report(const struct hair_sim* sim)
{
    return sim->rods ? sim->rods->report : hair_rods_report_none();
}
