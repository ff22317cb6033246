// solver_stats.c - what went wrong in the simulation, and what goes wrong now.
//
// Two passes examine the guides. motion.comp runs when hair_get_solver_stats is called, and
// measures the speed and stretch of guides. energy.comp runs after steps in which nothing does work
// on the guides, if hair_desc.diagnose is set.
//
// A guide is restless if it still moves at the speed v when damping must have calmed it. Let c be
// the damping, t the time, and L the length of the guide. An oscillation decays at least as exp(-c
// t / 2). Overdamped motion with the decay rate s has at most the speed L s exp(-s t). For any s,
// that speed is below v after L / (e v). A guide may move for the sum of both times, which is
// longer than either.
#include "lib/sim/sim.h"

#include <math.h>
#include <string.h>

#define RESTLESS_SPEED 0.02 // m/s. RESTLESS_SPEED of motion.comp.
#define FASTEST_SPEED 100.0 // Upper bound on the speed of hair on a head, m/s.
#define EULERS_NUMBER 2.718281828
#define NEVER 1e30f // s
// Length of a window, s. The slowest oscillations of hair, of 2 Hz, reach their maximum energy in
// it.
#define WINDOW 0.25

void hair_diagnosis_free(struct hair_sim* sim)
{
    struct hair_diagnosis* d = &sim->diagnosis;
    GLuint* buffers[] = {&d->energy, &d->energy_params, &d->found, &d->motion_params};
    for (int i = 0; i < 4; ++i) hair_gl_free_buffer(sim->gl, buffers[i]);
}

void hair_diagnosis_reset(struct hair_sim* sim)
{
    sim->diagnosis.goes_on = 0;
}

// Energy ------------------------------------------------------------------------------------------

static hair_gl_pass energy_pass(const struct hair_sim* sim)
{
    return hair_sim_is_mixed(sim) ? HAIR_GL_ENERGY | HAIR_GL_WITH(MIXED) : HAIR_GL_ENERGY;
}

// Return whether work can be done on a guide from outside. A skinned scalp, targets and other hair
// may do work.
static bool is_driven(const struct hair_sim* sim, int disturbed)
{
    return disturbed || memcmp(&sim->head_at_last_step, &sim->head, sizeof sim->head) != 0 ||
           hair_wind_is_on(&sim->wind) || hair_grid_is_on(sim) || hair_scalp_motion_is_on(sim) ||
           hair_targets_are_on(sim);
}

// Return whether the solver has an energy. Follow-the-leader and redblack move vertices by rules
// that have none.
static bool has_energy(const struct hair_sim* sim)
{
    return sim->solver == HAIR_SOLVER_DIRECT || sim->solver == HAIR_SOLVER_ACCURATE;
}

hair_result hair_diagnosis_ensure(struct hair_sim* sim, int disturbed)
{
    struct hair_diagnosis* d = &sim->diagnosis;
    struct hair_gl* gl = sim->gl;
    d->watches = d->wanted && has_energy(sim) && !is_driven(sim, disturbed);
    if (!d->watches) d->goes_on = 0;
    if (!d->watches) return HAIR_OK;
    HAIR_TRY(hair_gl_ensure_program(gl, energy_pass(sim)));
    if (!d->energy_params)
        HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_DIAGNOSE, "hair energy",
                                 sizeof(struct hair_energy_params), &d->energy_params));
    if (!d->energy)
        HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_DIAGNOSE, "hair energies",
                                 sim->guides * sizeof(struct hair_energy), NULL, &d->energy));
    return HAIR_OK;
}

void hair_diagnosis_watch(struct hair_sim* sim, uint32_t substeps)
{
    struct hair_diagnosis* d = &sim->diagnosis;
    struct hair_gl* gl = sim->gl;
    if (!d->watches || substeps == 0) return;
    HAIR_ASSERT(d->energy && d->energy_params && sim->rods);
    int begins = !d->goes_on || d->substep != sim->substep;
    d->time = (begins ? 0 : d->time) + substeps * sim->substep;
    int ends = d->time >= WINDOW;
    struct hair_energy_params params = {.begins = (hair_uint)begins,
                                        .ends = (hair_uint)ends,
                                        .time = (float)(substeps * sim->substep),
                                        .rate = (float)(1 / sim->substep)};
    hair_gl_write_uniform(gl, d->energy_params, sizeof params, &params);
    hair_sim_bind(sim);
    hair_sim_bind_rods(sim);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_ENERGY_PARAMS, 1, &d->energy_params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_ENERGY, 1, &d->energy);
    hair_gl_run(gl, energy_pass(sim), (sim->guides + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    d->goes_on = 1;
    d->substep = sim->substep;
    if (ends) d->time = 0;
}

// Motion ------------------------------------------------------------------------------------------

// Return the time for which nothing has driven the hair, s. Return a negative value if something
// drives the hair, or if the hair need not come to rest.
static float calm_of(const struct hair_sim* sim)
{
    int rests = sim->physics.root != HAIR_ROOT_FREE && !hair_wind_is_on(&sim->wind);
    return rests && !sim->sleep.asleep ? (float)sim->sleep.quiet_time : -1;
}

static struct hair_motion_params motion_params(const struct hair_sim* sim)
{
    hair_quat turn =
        hair_quat_multiply(sim->last_after.rotation, hair_quat_conjugate(sim->last_before.rotation));
    hair_vec3 moved = hair_pose_offset(&sim->last_after, &sim->last_before);
    HAIR_ASSERT(sim->last_substep > 0);
    double rate = sim->sleep.asleep ? 0 : 1 / sim->last_substep, damping = (double)hair_sim_min_damping(sim);
    double wait = damping > 0 ? 2 / damping * log(FASTEST_SPEED / RESTLESS_SPEED) : INFINITY;
    return (struct hair_motion_params){.turn = {turn.x, turn.y, turn.z, turn.w},
                                       .moved = {moved.x, moved.y, moved.z, (float)rate},
                                       .guides = sim->guides,
                                       .calm = calm_of(sim),
                                       .wait = fminf((float)wait, NEVER),
                                       .creep = (float)(1 / (EULERS_NUMBER * RESTLESS_SPEED))};
}

static hair_result find_motion(struct hair_sim* sim, uint32_t found[HAIR_FOUND_COUNT])
{
    struct hair_diagnosis* d = &sim->diagnosis;
    struct hair_gl* gl = sim->gl;
    struct hair_motion_params params = motion_params(sim);
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_MOTION_OF_GUIDES));
    if (!d->motion_params)
        HAIR_TRY(
            hair_gl_uniform(gl, HAIR_GL_CATEGORY_DIAGNOSE, "hair motion", sizeof params, &d->motion_params));
    if (!d->found)
        HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_DIAGNOSE, "hair motion found",
                                 HAIR_FOUND_COUNT * sizeof *found, NULL, &d->found));
    hair_gl_write_uniform(gl, d->motion_params, sizeof params, &params);
    hair_gl_clear_buffer(gl, d->found);
    hair_sim_bind(sim);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_MOTION_PARAMS, 1, &d->motion_params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_FOUND, 1, &d->found);
    hair_gl_run(gl, HAIR_GL_MOTION_OF_GUIDES, (sim->guides + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_read(gl, d->found, HAIR_FOUND_COUNT * sizeof *found, found);
    return HAIR_OK;
}

// Report ------------------------------------------------------------------------------------------

static float float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

hair_result hair_sim_solver_stats(struct hair_sim* sim, hair_solver_stats* solver_stats)
{
    uint32_t count[HAIR_SOLVER_STATS_COUNT] = {0}, found[HAIR_FOUND_COUNT] = {0};
    struct hair_rods_report held = hair_sim_preload_report(sim);
    HAIR_TRY(find_motion(sim, found));
    hair_gl_read(sim->gl, sim->solver_stats, sizeof count, count);
    solver_stats->euler_fallbacks = count[HAIR_SOLVER_STATS_EULER_FALLBACKS];
    solver_stats->follow_fallbacks = count[HAIR_SOLVER_STATS_FOLLOW_FALLBACKS];
    solver_stats->reset = count[HAIR_SOLVER_STATS_RESET];
    solver_stats->overextended = count[HAIR_SOLVER_STATS_OVEREXTENDED];
    solver_stats->parts = count[HAIR_SOLVER_STATS_PARTS];
    solver_stats->gaining = count[HAIR_SOLVER_STATS_GAINING];
    solver_stats->restless = found[HAIR_FOUND_RESTLESS];
    solver_stats->overstretched = found[HAIR_FOUND_OVERSTRETCHED];
    solver_stats->fastest = float_of_bits(found[HAIR_FOUND_FASTEST]);
    solver_stats->stretch = float_of_bits(found[HAIR_FOUND_STRETCH]);
    solver_stats->substep = (float)sim->substep;
    solver_stats->stiffened = held.stiffened;
    solver_stats->max_stiffening = held.stiffest;
    solver_stats->sagging = held.sagging;
    solver_stats->farthest_sag = held.farthest_sag;
    solver_stats->softened = held.softened.guides;
    solver_stats->softest = held.softened.factor;
    return HAIR_OK;
}
