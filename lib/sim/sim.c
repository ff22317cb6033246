// sim.c - the accumulator, which divides steps of any length into substeps of one length.
#include "lib/sim/sim.h"

#include <string.h>

#define EARLY 1e-6 // Tolerance of the end of a substep, as a fraction of a substep.

static float fraction_of_step(double from, double dt)
{
    return (float)fmin(fmax(from / dt, -1), 1);
}

// Ensure everything that a step needs. The coming substeps begin `from` seconds into the step, and
// none is longer than `longest`.
static hair_result prepare(struct hair_sim* sim, double from, double dt, double longest)
{
    sim->contacts.any = hair_contacts_are_any(sim);
    sim->contacts.listed = hair_contacts_are_listed(sim);
    HAIR_TRY(hair_pins_write(sim));
    HAIR_TRY(hair_targets_ensure(sim));
    HAIR_TRY(hair_sim_ensure_hair_grid(sim));
    if (sim->rods) HAIR_TRY(hair_wind_ensure(&sim->wind_state, sim->gl, &sim->wind));
    if (sim->contacts.any) HAIR_TRY(hair_contacts_find(sim, dt, fraction_of_step(from, dt), longest));
    HAIR_TRY(hair_impulses_ensure(sim));
    HAIR_TRY(hair_guide_level_ensure(sim));
    return hair_sim_ensure_solver(sim);
}

// Write the wind for `count` substeps of the parameters.
static void write_air(struct hair_sim* sim, const struct hair_step_params* params, uint32_t count)
{
    HAIR_ASSERT(params->substeps == count);
    const struct hair_wind_step now = {.wind = &sim->wind,
                                       .physics = &sim->physics,
                                       .colliders = &sim->colliders,
                                       .step = params,
                                       .head = sim->last_after,
                                       .substeps = count,
                                       .substep = sim->substep};
    hair_wind_write(&sim->wind_state, sim->gl, &now);
}

// Bind the buffers that the solvers read.
static void bind_buffers(struct hair_sim* sim)
{
    if (sim->contacts.any) hair_contacts_bind(sim);
    hair_sim_bind(sim);
    if (sim->rods) hair_sim_bind_rods(sim);
    if (hair_impulses_are_on(sim)) hair_impulses_bind(sim);
}

static uint32_t min_count(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// Return the number of substeps of the next dispatch, of which `left` remain in the step. No block
// of the hair-hair grid or of the fluid ends within a dispatch. Targets hold guides after each
// substep.
static uint32_t next_substeps(const struct hair_sim* sim, uint32_t left)
{
    uint32_t count = hair_targets_are_on(sim) ? 1 : min_count(left, hair_sim_substeps_at_once(sim));
    if (hair_grid_is_on(sim)) count = min_count(count, hair_grid_substeps_left(sim));
    if (hair_wind_coupling_is_on(sim)) count = min_count(count, hair_wind_coupling_substeps_left(sim));
    HAIR_ASSERT(0 < count && count <= left);
    return count;
}

// Update the forces whose block starts with the next substep. Their passes use the solvers' slots.
static void update_forces(struct hair_sim* sim, double dt)
{
    if (hair_grid_is_due(sim)) {
        hair_grid_update(sim);
        bind_buffers(sim);
    }
    if (hair_wind_coupling_is_due(sim)) {
        hair_wind_coupling_update(sim, dt);
        bind_buffers(sim);
    }
}

// Write and upload the next `count` substeps. The first begins `from` seconds into a step of `dt`.
static void write_dispatch(struct hair_sim* sim, struct hair_step_params* params, uint32_t count, double from,
                           double dt)
{
    params->rotation_start = hair_quat_to_vec4(sim->last_after.rotation);
    sim->last_substep = sim->substep;
    hair_sim_write_substeps(sim, params, count, from, dt);
    hair_sim_write_now(sim, params);
    hair_guide_level_write(sim, params, count * sim->substep);
    params->list = hair_sim_flip_work_list(sim);
    hair_sim_upload(sim, params);
}

// Bind the forces that are on, for a dispatch that has been written.
static void bind_forces(struct hair_sim* sim, const struct hair_step_params* params)
{
    if (hair_grid_is_on(sim)) hair_grid_bind(sim);
    if (sim->pins.count) hair_pins_bind(sim);
    if (hair_wind_coupling_is_on(sim)) {
        hair_fluid_bind(&sim->wind_coupling.fluid);
        sim->wind_state.box = hair_wind_coupling_box(sim);
    }
    if (sim->wind_state.params) write_air(sim, params, params->substeps);
}

static void run_solver(struct hair_sim* sim, struct hair_step_params* params)
{
    if (!sim->feedback.wanted || hair_scalp_motion_is_on(sim)) {
        hair_sim_run_solver(sim, params);
        return;
    }
    bool was_recording = hair_gl_run_at_once(sim->gl);
    hair_feedback_run(sim, params);
    hair_gl_record_again(sim->gl, was_recording);
}

// Count substeps in the blocks of forces. The next dispatch continues where this one ended.
static void end_dispatch(struct hair_sim* sim, struct hair_step_params* params, uint32_t count)
{
    if (hair_impulses_are_on(sim)) hair_impulses_end_dispatch(sim);
    if (hair_grid_is_on(sim)) hair_grid_count(sim, count);
    if (hair_wind_coupling_is_on(sim)) hair_wind_coupling_count(sim, count);
    if (hair_targets_are_on(sim)) {
        hair_targets_run(sim);
        bind_buffers(sim);
    }
    params->fraction_start = params->substep[count - 1].displacement.w;
    params->rescale = 1;
}

// Move the roots with a skinned scalp in `total` substeps.
static void move_roots(struct hair_sim* sim, bool again, uint32_t total, double from, double dt)
{
    float before = (float)hair_sim_fraction_at_end(sim, total > 1 ? total - 2 : 0, from, dt);
    float after = (float)hair_sim_fraction_at_end(sim, total > 0 ? total - 1 : 0, from, dt);
    hair_scalp_motion_run(sim, again, total, before, after);
}

// Run `total` substeps. sim->accumulator is already the time that remains after them. `again` is
// true if the step has begun already.
static void advance(struct hair_sim* sim, bool again, uint32_t total, double from, double dt)
{
    struct hair_step_params params = {0};
    sim->next_substep = sim->substep;
    hair_sim_write_physics(sim, &params);
    hair_sim_write_colliders(sim, &params);
    params.fraction_start = fraction_of_step(from, dt);
    if (hair_scalp_motion_is_on(sim)) move_roots(sim, again, total, from, dt);
    if (hair_targets_are_on(sim)) hair_targets_begin_step(sim);
    bind_buffers(sim);
    for (uint32_t done = 0, count; done < total; done += count) {
        count = next_substeps(sim, total - done);
        update_forces(sim, dt);
        write_dispatch(sim, &params, count, from + done * sim->substep, dt);
        bind_forces(sim, &params);
        hair_guide_level_begin(sim);
        run_solver(sim, &params);
        hair_guide_level_end(sim);
        end_dispatch(sim, &params, count);
    }
    if (total == 0) {
        hair_sim_write_now(sim, &params);
        hair_sim_upload(sim, &params);
    }
    if (!hair_grid_is_on(sim)) hair_grid_reset(sim);
    hair_targets_pass_time(sim, total * sim->substep);
}

// Return the number of substeps that fit into a time. The tolerance EARLY makes 2/120 s hold two
// substeps of 1/120 s.
static uint32_t count_substeps(const struct hair_sim* sim, double time)
{
    HAIR_ASSERT(time > -sim->substep);
    return (uint32_t)(time / sim->substep + EARLY);
}

// Free what is no longer used.
static void free_unused(struct hair_sim* sim)
{
    if (!sim->colliders.current.count && sim->contacts.grid.contact) hair_contacts_free(sim);
    if (!hair_grid_is_on(sim) && sim->hair_grid.texture) hair_grid_free(sim);
    if (!hair_wind_coupling_is_on(sim) && sim->wind_coupling.fluid.gl) hair_wind_coupling_free(sim);
}

// Return whether the current substep must be finished at its old length, because only the rate has
// changed. The drawn hair then does not jump.
static bool must_finish_substep(const struct hair_sim* sim)
{
    return hair_sim_is_other_rate(sim) && sim->next_substep > 0 && sim->accumulator > EARLY * sim->substep;
}

// Finish the current substep, which began `from` seconds into the step. Return its end.
static double finish_substep(struct hair_sim* sim, double from, double dt)
{
    double end = from + sim->substep;
    sim->accumulator = fmax(dt - end, 0);
    advance(sim, false, 1, from, dt);
    return end;
}

// Ensure everything that a step needs with the rods of a set. On failure the simulation is as it
// was. If `again`, a substep with the simulation's own rods comes first, and the simulation keeps
// them. Otherwise the set then has the rods that the step replaces.
static hair_result prepare_all(struct hair_sim* sim, struct hair_rod_set* other, bool again, bool disturbed,
                               double dt)
{
    double from = -sim->accumulator, longest = fmax(sim->substep, other->substep);
    hair_sim_swap_rods(sim, other);
    hair_result result = prepare(sim, from, dt, longest);
    if (!result) result = hair_sleep_ensure(sim, disturbed, dt);
    if (!result) result = hair_diagnosis_ensure(sim, disturbed);
    if (result || again) hair_sim_swap_rods(sim, other);
    if (!result && again) result = hair_sim_ensure_solver(sim);
    if (result) return result;
    // Last, because a new fluid has no past.
    result = hair_wind_coupling_ensure(sim);
    if (result && !again) hair_sim_swap_rods(sim, other);
    return result;
}

hair_result hair_sim_step(struct hair_sim* sim, double dt)
{
    HAIR_ASSERT(dt > 0);
    HAIR_TRY(hair_snapshots_update(sim));
    double from = -sim->accumulator;
    bool waits = must_finish_substep(sim), disturbed = hair_sleep_is_disturbed(sim);
    bool again = waits && count_substeps(sim, dt - from) > 0;
    struct hair_rod_set other = {0};
    if (!waits || again) HAIR_TRY(hair_sim_make_rods(sim, &other));
    hair_result result = prepare_all(sim, &other, again, disturbed, dt);
    if (result) {
        hair_sim_free_rod_set(sim, &other);
        return result;
    }
    // Nothing fails from here on, so that a step that fails changes nothing.
    if (!hair_wind_coupling_is_on(sim)) sim->wind_state.box = (hair_vec4){0, 0, 0, 0};
    if (again) {
        from = finish_substep(sim, from, dt);
        hair_sim_swap_rods(sim, &other);
    }
    hair_sim_free_rod_set(sim, &other);
    if (!waits || again) hair_sim_note_contact(sim);
    uint32_t total = count_substeps(sim, dt - from);
    sim->accumulator = fmax(dt - from - total * sim->substep, 0);
    HAIR_ASSERT(sim->accumulator < (1 + EARLY) * sim->substep);
    advance(sim, again, total, from, dt);
    hair_diagnosis_watch(sim, total);
    hair_impulses_end_step(sim);
    sim->head_at_last_step = sim->head;
    hair_colliders_end_step(&sim->colliders);
    hair_sleep_submit_query(sim, disturbed, dt);
    hair_targets_end_step(sim);
    free_unused(sim);
    return HAIR_OK;
}

void hair_sim_pass_time(struct hair_sim* sim, double dt)
{
    uint32_t total = count_substeps(sim, dt + sim->accumulator);
    sim->accumulator = fmax(dt + sim->accumulator - total * sim->substep, 0);
    if (hair_grid_is_on(sim)) hair_grid_count(sim, total);
    hair_colliders_end_step(&sim->colliders);
}

// Discard the past of the head, the colliders and the fluid, as if all had always been at rest.
static void reset_history(struct hair_sim* sim)
{
    sim->last_before = sim->last_after = sim->head_at_last_step = sim->head;
    sim->accumulator = 0;
    sim->last_substep = sim->next_substep = sim->substep;
    hair_grid_reset(sim);
    hair_wind_coupling_reset(sim);
    hair_colliders_end_step(&sim->colliders);
}

static void run_over_vertices(struct hair_sim* sim, hair_gl_pass pass, const struct hair_step_params* params)
{
    hair_sim_upload(sim, params);
    hair_sim_bind(sim);
    if (sim->rods) hair_sim_bind_rods(sim);
    hair_gl_run(sim->gl, pass, (sim->guide_vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

void hair_sim_reset(struct hair_sim* sim)
{
    struct hair_step_params params = {0};
    reset_history(sim);
    hair_sleep_wake(sim);
    sim->had_contact = 0;
    for (int k = 0; k < 3; ++k) sim->wind_state.moved[k] = 0;
    hair_sim_write_physics(sim, &params);
    hair_sim_write_now(sim, &params);
    if (hair_scalp_motion_is_on(sim)) hair_scalp_motion_reset(sim);
    run_over_vertices(sim, hair_sim_reset_pass(sim, hair_scalp_motion_is_on(sim)), &params);
    if (hair_targets_are_on(sim)) hair_targets_reset(sim);
}

// Move all past poses by the rigid motion that moves the head, so that the hair does not swing.
hair_result hair_sim_teleport(struct hair_sim* sim, const struct hair_pose* to)
{
    HAIR_TRY(hair_gl_ensure_program(sim->gl, hair_sim_rotate_pass(sim)));
    struct hair_step_params params = {0};
    struct hair_pose from = sim->head;
    struct hair_pose* moved[] = {&sim->last_before, &sim->last_after, &sim->head_at_last_step, &sim->head};
    hair_quat turn = hair_quat_multiply(to->rotation, hair_quat_conjugate(from.rotation));
    for (int i = 0; i < 4; ++i) {
        hair_vec3 arm = hair_rotate(turn, hair_pose_offset(moved[i], &from));
        moved[i]->rotation = hair_quat_normalize(hair_quat_multiply(turn, moved[i]->rotation));
        moved[i]->position[0] = to->position[0] + (double)arm.x;
        moved[i]->position[1] = to->position[1] + (double)arm.y;
        moved[i]->position[2] = to->position[2] + (double)arm.z;
    }
    hair_pins_teleport(sim, &from, to);
    hair_sleep_wake(sim);
    hair_grid_reset(sim); // The grid's accelerations are for the old rotation of the head.
    hair_colliders_reset(&sim->colliders); // Old positions imply no velocities.
    hair_sim_write_physics(sim, &params);
    params.rotation_before = hair_quat_to_vec4(from.rotation);
    params.rotation_now = hair_quat_to_vec4(to->rotation);
    run_over_vertices(sim, hair_sim_rotate_pass(sim), &params);
    hair_sim_upload_render_state(sim);
    return HAIR_OK;
}
