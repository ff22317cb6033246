// rods.c - rods of the guides on the GPU, made from the groom and the physics. They are made again
// when the physics change.
#include "lib/sim/sim.h"

#include <string.h>

// Maximum length of a substep that is longer than the solver's own, s. Substeps twice as long lose
// lengths.
#define LONGEST (1.0 / 60)

// Maximum vertices whose rows fit into a work group's memory. See glsl/sim/mixed_rows.glsl.
#define ROWS_IN_GROUP 64

#define UNSEEN 0.25 // Time without a view after which hair counts as unseen, s.

// Divisor of the accurate solver's own substep once there are colliders. From 1.5 on, no substep
// falls back to another method when the head shakes over colliders.
#define CONTACT_MARGIN 1.6

// Return whether the accurate solver does not solve all guides explicitly.
static bool is_stiff(const struct hair_sim* sim, const hair_vec4* packed)
{
    if (sim->solver != HAIR_SOLVER_ACCURATE) return false;
    for (uint32_t i = 0; i < sim->guides; ++i)
        if (packed[2 * (size_t)sim->rods->groom->guides[i].first + 1].w != 0) return true;
    return false;
}

// Return the members of packed rods that the programs read.
static struct hair_rod_parts find_parts(const struct hair_sim* sim, bool is_mixed)
{
    bool is_reduced = !sim->by_thread && sim->solver != HAIR_SOLVER_FOLLOW;
    return (struct hair_rod_parts){.has_factor_euler = !is_mixed,
                                   .has_factor = !is_mixed && !is_reduced,
                                   .has_pins = sim->pins.count > 0};
}

// Create the reduction buffer. The buffer is empty unless work groups run a method with implicit
// systems. A buffer with systems ends with a row of zeros, which shaders read for vertices beyond
// the end of a guide.
static hair_result upload_reduction(struct hair_sim* sim, const hair_vec4* reduction, uint32_t rounds,
                                    struct hair_rod_set* out)
{
    size_t rows = reduction ? (size_t)(rounds + 1) * sim->guide_vertices + 1 : 0;
    out->rounds = reduction ? rounds : out->rounds;
    return hair_gl_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair reduction", rows * sizeof *reduction,
                           reduction, &out->reduction);
}

// Return the multiple of the solver's own substep length for the current rate. Multiples are powers
// of two, so that rods are seldom made again while a level of detail changes. They change by one
// doubling at a time, so that the drawn hair does not leap.
static uint32_t find_substep_scale(const struct hair_sim* sim)
{
    uint32_t substep_scale = 1;
    float rate = fmaxf(sim->physics.substep_rate * fminf(sim->rate_factor, 1 / (float)sim->interval),
                       HAIR_MIN_SUBSTEP_RATE);
    if (sim->unseen >= UNSEEN) rate = fminf(rate, sim->physics.offscreen_substep_rate);
    HAIR_ASSERT(rate > 0);
    while (2 * (float)substep_scale * rate <= 1) substep_scale *= 2;
    if (sim->substep_scale && substep_scale < sim->substep_scale) return sim->substep_scale / 2;
    if (sim->substep_scale && substep_scale > sim->substep_scale) return sim->substep_scale * 2;
    return substep_scale;
}

// Return the rods of the groom if they are for the physics, the solver and the substep of the
// simulation. Otherwise return NULL.
static const struct hair_prepared_rods* find_prepared(const struct hair_sim* sim, int had_contact)
{
    const struct hair_prepared_rods* p = sim->rods->groom->prepared;
    bool is_own = p && p->solver == sim->solver && sim->asked_substep == 0 && !sim->pins.count &&
                  !had_contact && find_substep_scale(sim) == 1 && !hair_sim_groups(sim) &&
                  !sim->lengths.guides;
    return is_own && !hair_rods_differ(&p->physics, &sim->physics) ? p : NULL;
}

// Return whether the mixed scheme solves the guides.
static bool are_mixed(const struct hair_sim* sim, bool had_contact)
{
    struct hair_rod_source source = hair_sim_rod_source(sim);
    return hair_rods_are_any_mixed(&source, sim->rods->borne, &sim->physics, sim->solver,
                                   had_contact || sim->pins.count > 0, sim->asked_substep);
}

// Return the size of forces and turns, in bytes. Include the rows if they do not fit into the
// memory of a work group.
static size_t bend_size(const struct hair_sim* sim)
{
    size_t each = sim->max_vertices > ROWS_IN_GROUP ? 3 + HAIR_MIXED_ROW_VECTORS : 3;
    return each * sim->guide_vertices * sizeof(hair_vec4);
}

// Return the length of a substep, s. `substep_scale` is its multiple of the solver's own length.
static double find_substep(const struct hair_sim* sim, int mixed, int had_contact, uint32_t substep_scale)
{
    double substep = sim->asked_substep;
    if (substep == 0) {
        struct hair_rod_source source = hair_sim_rod_source(sim);
        substep = hair_rods_shared_substep(&source, sim->rods->borne, &sim->physics, sim->solver, mixed);
        // Impacts can destabilise explicit bending that is near its limit.
        if (had_contact && sim->solver == HAIR_SOLVER_ACCURATE && !mixed) substep /= CONTACT_MARGIN;
    }
    if (substep_scale > 1) substep = fmax(substep, fmin(substep * substep_scale, LONGEST));
    HAIR_ASSERT(substep > 0);
    return substep;
}

// Upload packed rods to the buffers of a set. The set has the simulation's buffer of forces and
// turns where there is one.
static hair_result upload_rods(struct hair_sim* sim, const hair_vec4* packed, size_t count,
                               struct hair_rod_set* out)
{
    out->stiff = is_stiff(sim, packed);
    HAIR_TRY(hair_gl_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair rods", count * sizeof *packed, packed,
                             &out->rod));
    if (out->mixed) out->bend = sim->bend;
    if (!out->mixed || out->bend) return HAIR_OK;
    // hair_sim_reset() writes forces and turns of a new simulation, but no rows.
    if (!sim->rod && sim->max_vertices <= ROWS_IN_GROUP)
        return hair_gl_undefined_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair bend", bend_size(sim),
                                         &out->bend);
    return hair_gl_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair bend", bend_size(sim), NULL, &out->bend);
}

void hair_sim_free_rod_set(struct hair_sim* sim, const struct hair_rod_set* set)
{
    GLuint rod = set->rod, reduction = set->reduction, bend = set->bend == sim->bend ? 0 : set->bend;
    hair_gl_free_buffer(sim->gl, &rod);
    hair_gl_free_buffer(sim->gl, &reduction);
    hair_gl_free_buffer(sim->gl, &bend);
}

void hair_sim_swap_rods(struct hair_sim* sim, struct hair_rod_set* set)
{
    struct hair_rods* rods = sim->rods;
    if (!set->rod) return;
    const struct hair_rod_set now = *set;
    *set = (struct hair_rod_set){.rod = sim->rod,
                                 .reduction = sim->reduction,
                                 .bend = sim->bend,
                                 .rounds = sim->rounds,
                                 .mixed = rods->mixed,
                                 .stiff = rods->stiff,
                                 .had_contact = rods->had_contact,
                                 .made_for = rods->made_for,
                                 .made_for_groups = rods->made_for_groups,
                                 .made_for_lengths = rods->made_for_lengths,
                                 .softened = rods->report.softened,
                                 .pinned = rods->pinned,
                                 .substep_scale = rods->substep_scale,
                                 .last_scale = sim->substep_scale,
                                 .substep = sim->substep};
    sim->rod = now.rod;
    sim->reduction = now.reduction;
    sim->bend = now.bend;
    sim->rounds = now.rounds;
    sim->substep = now.substep;
    rods->mixed = now.mixed;
    rods->stiff = now.stiff;
    rods->had_contact = now.had_contact;
    rods->made_for = now.made_for;
    rods->made_for_groups = now.made_for_groups;
    rods->made_for_lengths = now.made_for_lengths;
    rods->report.softened = now.softened;
    rods->pinned = now.pinned;
    rods->substep_scale = now.substep_scale;
    sim->substep_scale = now.last_scale;
}

// Make rods that the groom has not prepared.
static hair_result write_rods(struct hair_sim* sim, int had_contact, struct hair_rod_set* out)
{
    const struct hair_rod_source source = hair_sim_rod_source(sim);
    out->mixed = are_mixed(sim, had_contact);
    out->substep = find_substep(sim, out->mixed, had_contact, out->substep_scale);
    const struct hair_rods_order order = {.borne = sim->rods->borne,
                                          .physics = &sim->physics,
                                          .solver = sim->solver,
                                          .mixed = out->mixed,
                                          .substep = out->substep,
                                          .pins = sim->pins.resolved_pin,
                                          .pin_count = sim->pins.count,
                                          .parts = find_parts(sim, out->mixed),
                                          .is_reduced = !sim->by_thread && sim->solver != HAIR_SOLVER_FOLLOW};
    struct hair_rods_result made;
    HAIR_TRY(hair_rods_make_all(&source, &order, &made));
    out->softened = made.softened;
    hair_result result = upload_reduction(sim, made.reduction, made.rounds, out);
    size_t count = hair_rods_packed_count(sim->guides, sim->guide_vertices, order.parts);
    if (!result) result = upload_rods(sim, made.packed, count, out);
    hair_free(source.host, made.reduction);
    hair_free(source.host, made.packed);
    return result;
}

// Upload the rods of the groom.
static hair_result take_rods(struct hair_sim* sim, const struct hair_prepared_rods* prepared,
                             struct hair_rod_set* out)
{
    out->mixed = prepared->mixed;
    out->substep = prepared->substep;
    out->softened = prepared->report.softened;
    bool has_reduction = !sim->by_thread && prepared->reduction;
    HAIR_TRY(upload_reduction(sim, has_reduction ? prepared->reduction : NULL, prepared->rounds, out));
    struct hair_rod_parts parts = find_parts(sim, prepared->mixed);
    HAIR_ASSERT(!parts.has_pins);
    return upload_rods(sim, prepared->rod, hair_rods_packed_count(sim->guides, sim->guide_vertices, parts),
                       out);
}

// Make all that depends on physics, in new buffers. Dispatches in progress keep the old buffers.
static hair_result create(struct hair_sim* sim, int had_contact, struct hair_rod_set* out)
{
    HAIR_TRY(hair_sim_preload(sim));
    const struct hair_prepared_rods* prepared = find_prepared(sim, had_contact);
    *out = (struct hair_rod_set){.had_contact = had_contact,
                                 .made_for = sim->physics,
                                 .made_for_groups = sim->groups.version,
                                 .made_for_lengths = sim->lengths.version,
                                 .pinned = sim->pins.vertex_hash,
                                 .substep_scale = find_substep_scale(sim)};
    out->last_scale = out->substep_scale;
    hair_result result = prepared ? take_rods(sim, prepared, out) : write_rods(sim, had_contact, out);
    if (result) {
        hair_sim_free_rod_set(sim, out);
        *out = (struct hair_rod_set){0};
    }
    return result;
}

static hair_result make_rod_buffers(struct hair_sim* sim)
{
    size_t vertices = sim->guide_vertices;
    HAIR_TRY(hair_gl_undefined_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair history",
                                       vertices * sizeof(struct hair_history), &sim->history));
    return hair_gl_undefined_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair material",
                                     vertices * sizeof(hair_vec4), &sim->material);
}

hair_result hair_sim_create_rods(struct hair_sim* sim, const struct hair_groom* groom)
{
    const hair_host* host = &sim->gl->host;
    HAIR_ASSERT(!sim->rods);
    sim->rods = hair_alloc(host, 1, sizeof *sim->rods);
    if (!sim->rods) return hair_fail_memory(host, "the guides as rods");
    struct hair_rods* rods = sim->rods;
    rods->groom = hair_groom_retain((hair_groom*)groom);
    HAIR_TRY(make_rod_buffers(sim));
    struct hair_rod_set first;
    HAIR_TRY(create(sim, 0, &first));
    hair_sim_swap_rods(sim, &first);
    return hair_sim_ensure_hair_grid(sim);
}

// Return whether the presence of colliders has changed the accurate solver's own substep, or the
// scheme of direct.
static bool is_first_contact(const struct hair_sim* sim, int had_contact)
{
    const struct hair_rods* rods = sim->rods;
    if (had_contact == rods->had_contact) return false;
    if (sim->solver == HAIR_SOLVER_ACCURATE) return sim->asked_substep == 0;
    return sim->solver == HAIR_SOLVER_DIRECT && hair_rods_are_long(rods->groom->guides, sim->guides);
}

// Return whether the rods are for the present physics of all groups, and the present lengths.
static bool are_for_physics(const struct hair_sim* sim)
{
    return sim->rods->made_for_groups == sim->groups.version &&
           sim->rods->made_for_lengths == sim->lengths.version &&
           !hair_rods_differ(&sim->rods->made_for, &sim->physics);
}

static bool had_contact_now(const struct hair_sim* sim)
{
    return sim->had_contact || hair_sim_contacts(sim) > 0;
}

bool hair_sim_is_other_rate(const struct hair_sim* sim)
{
    const struct hair_rods* rods = sim->rods;
    if (!rods || rods->substep_scale == find_substep_scale(sim)) return false;
    return sim->pins.vertex_hash == rods->pinned && !is_first_contact(sim, had_contact_now(sim)) &&
           are_for_physics(sim);
}

hair_result hair_sim_make_rods(struct hair_sim* sim, struct hair_rod_set* out)
{
    const struct hair_rods* rods = sim->rods;
    *out = (struct hair_rod_set){0};
    if (!rods) return HAIR_OK;
    int had_contact = had_contact_now(sim);
    int other = rods->substep_scale != find_substep_scale(sim) || is_first_contact(sim, had_contact) ||
                sim->pins.vertex_hash != rods->pinned || !are_for_physics(sim);
    return other ? create(sim, had_contact, out) : HAIR_OK;
}

void hair_sim_note_contact(struct hair_sim* sim)
{
    if (sim->rods) sim->had_contact = had_contact_now(sim);
}

void hair_sim_free_rods(struct hair_sim* sim)
{
    if (!sim->rods) return;
    const hair_host* host = &sim->gl->host;
    hair_gl_free_buffer(sim->gl, &sim->rod);
    hair_gl_free_buffer(sim->gl, &sim->history);
    hair_gl_free_buffer(sim->gl, &sim->material);
    hair_gl_free_buffer(sim->gl, &sim->reduction);
    hair_gl_free_buffer(sim->gl, &sim->bend);
    hair_grid_free(sim);
    hair_sim_free_preload(sim);
    hair_free(host, sim->groups.physics);
    hair_groom_release(sim->rods->groom);
    hair_free(host, sim->rods);
}

void hair_sim_write_rods(const struct hair_sim* sim, struct hair_step_params* params)
{
    const hair_physics* physics = &sim->physics;
    HAIR_ASSERT(sim->substep > 0 && sim->last_substep > 0);
    double h = sim->substep, c = (double)physics->damping;
    double ratio[3];
    hair_rods_ratios(physics, ratio);
    params->ratio = (hair_vec4){(float)ratio[0], (float)ratio[1], (float)ratio[2], 0};
    params->kick = (float)(c * h > 1e-6 ? -expm1(-c * h) / c * h : h * h);
    params->damping = physics->damping;
    params->friction = physics->collision.friction;
    params->rescale = (float)(h / sim->last_substep);
    params->rounds = sim->rounds;
    params->part_rounds = hair_sim_part_rounds(sim);
    params->list_guides = hair_sim_guides_of_list_group(sim);
}
