// create.c - creation and destruction of a simulation.
#include "lib/sim/sim.h"

#include <string.h>

#define REDBLACK_SUBSTEP (1.0 / 120)
// Maximum vertices of a guide for a thread per guide. NVIDIA's driver fails to link programs with
// more private memory.
#define MAX_OF_THREAD 128

static void set_up(struct hair_sim* sim, const struct hair_sim_desc* desc)
{
    sim->solver = desc->solver;
    sim->asked_substep = desc->substep;
    sim->rate_factor = 1;
    sim->interval = 1;
    sim->guide_level.wanted = 1;
    sim->by_thread = desc->is_by_thread && desc->solver != HAIR_SOLVER_REDBLACK;
    sim->feedback.wanted = desc->uses_feedback;
    sim->diagnosis.wanted = desc->is_diagnosed;
    sim->snapshots.is_wanted = desc->has_snapshots;
    sim->physics = desc->physics;
    sim->wind = desc->wind;
    sim->head = desc->head;
    sim->contacts.sdf_pool = desc->sdf_pool;
    hair_targets_init(&sim->targets);
    sim->wind_coupling.field = desc->field;
}

static void find_reach(struct hair_sim* sim, const struct hair_groom* groom)
{
    for (uint32_t i = 0; i < sim->guides; ++i) {
        float reach = hair_length(hair_guide_root(groom, i)) + groom->guides[i].arc_length;
        sim->reach = fmaxf(sim->reach, reach);
    }
}

// Count the guides and their vertices, and find everything that depends on their numbers.
static void measure_groom(struct hair_sim* sim, const struct hair_groom* groom)
{
    sim->guides = groom->info.guide_count;
    sim->guide_vertices = groom->info.guide_vertex_count;
    sim->max_vertices = groom->max_vertices;
    sim->smooth_vertices = 2 * (groom->max_vertices - 1) + 1;
    if (sim->max_vertices > MAX_OF_THREAD && !sim->gl->software) sim->by_thread = 0;
    sim->two_pass = hair_sim_may_use_two_passes(sim);
    for (uint32_t i = 0; i < sim->guides; ++i) sim->layout = hair_hash(sim->layout + groom->guides[i].count);
    find_reach(sim, groom);
    sim->wind_state.ball = groom->head_sphere;
    hair_lengths_init(&sim->lengths, groom);
    sim->scalp_motion.root_bindings = hair_root_bindings_retain(groom->root_bindings);
}

// Create the counters, the lists of two programs, and the order of guides.
static hair_result create_solver_stats(struct hair_sim* sim, const struct hair_groom* groom)
{
    sim->guide_order = sim->two_pass ? HAIR_SOLVER_STATS_LISTS + sim->guides : HAIR_SOLVER_STATS_COUNT;
    size_t count = sim->guide_order + (size_t)sim->guides;
    uint32_t* all = hair_alloc(&sim->gl->host, count, sizeof *all);
    if (!all) return hair_fail_memory(&sim->gl->host, "the solver's counters");
    memcpy(all + sim->guide_order, groom->guide_order, sim->guides * sizeof *all);
    hair_result result = hair_gl_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair solver stats",
                                         count * sizeof *all, all, &sim->solver_stats);
    hair_free(&sim->gl->host, all);
    return result;
}

hair_result hair_sim_create(struct hair_sim* sim, struct hair_gl* gl, const struct hair_groom* groom,
                            const struct hair_sim_desc* desc)
{
    HAIR_ASSERT(!sim->gl && 2 <= groom->max_vertices && groom->max_vertices <= HAIR_MAX_GUIDE_VERTICES);
    sim->gl = gl;
    set_up(sim, desc);
    measure_groom(sim, groom);
    size_t state = sim->guide_vertices * sizeof(struct hair_state);
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_SOLVE, "hair guides", sim->guides * sizeof *groom->guides,
                             groom->guides, &sim->guide));
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_SOLVE, "hair rest",
                             sim->guide_vertices * sizeof *groom->rest, groom->rest, &sim->rest));
    // hair_sim_reset() writes all state of a new simulation.
    HAIR_TRY(hair_gl_undefined_storage(gl, HAIR_GL_CATEGORY_SOLVE, "hair state", state, &sim->state));
    HAIR_TRY(create_solver_stats(sim, groom));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_SOLVE, "hair step", sizeof(struct hair_step_params),
                             &sim->step));
    if (sim->solver == HAIR_SOLVER_REDBLACK)
        sim->substep = sim->asked_substep > 0 ? sim->asked_substep : REDBLACK_SUBSTEP;
    else
        HAIR_TRY(hair_sim_create_rods(sim, groom));
    sim->last_substep = sim->substep;
    HAIR_TRY(hair_gl_ensure_program(gl, hair_sim_reset_pass(sim, 0)));
    if (sim->feedback.wanted) HAIR_TRY(hair_feedback_create(sim, groom->guides));
    return hair_sim_ensure_solver(sim);
}

void hair_sim_destroy(struct hair_sim* sim)
{
    if (!sim->gl) return;
    hair_colliders_free(&sim->gl->host, &sim->colliders);
    hair_feedback_free(sim);
    hair_gl_free_buffer(sim->gl, &sim->guide);
    hair_gl_free_buffer(sim->gl, &sim->rest);
    hair_gl_free_buffer(sim->gl, &sim->state);
    hair_gl_free_buffer(sim->gl, &sim->solver_stats);
    hair_gl_free_buffer(sim->gl, &sim->step);
    hair_pins_free(sim);
    hair_contacts_free(sim);
    hair_wind_free_state(&sim->wind_state, sim->gl);
    hair_wind_coupling_free(sim);
    hair_sim_free_rods(sim);
    hair_scalp_motion_free(sim);
    hair_targets_free(sim);
    hair_lengths_free(sim);
    hair_sleep_free(sim);
    hair_diagnosis_free(sim);
    hair_impulses_free(sim);
    hair_snapshots_free(sim);
}
