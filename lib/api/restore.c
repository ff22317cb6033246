// restore.c - the public call that makes everything in a context again after its OpenGL context is
// lost.
//
// The structs of instances keep their addresses, because the application and the rooms refer to
// them. What is lost is copied aside. Everything is then made in place, and what was aside is moved
// back for its destruction, or for good if something fails.
#include "lib/api/api.h"

#include <string.h>

// Everything of a context that refers to OpenGL objects.
struct lost {
    struct hair_gl gl;
    struct hair_sdf_pool sdf_pool;
    struct hair_batch batch;
    hair_instance* instances; // Copies of all instances, in the order of the context.
    uint32_t count;
    struct hair_body_grid* grids; // Grids of all bodies, in the order of the context.
    uint32_t grid_count;
};

// Return the first instance from `member` on. NULL if there is none.
static hair_instance* find_instance(struct hair_context_member* member)
{
    while (member && member->empty != hair_instance_empty) member = member->next;
    return (hair_instance*)member;
}

static hair_instance* find_next(const hair_instance* hair)
{
    return find_instance(hair->member.next);
}

// Return the first body from `member` on. NULL if there is none.
static hair_body* find_body(struct hair_context_member* member)
{
    while (member && member->empty != hair_body_empty) member = member->next;
    return (hair_body*)member;
}

static uint32_t count_members(const hair_context* context, void (*empty)(struct hair_context_member* member))
{
    uint32_t count = 0;
    for (struct hair_context_member* member = context->members; member; member = member->next)
        count += member->empty == empty;
    return count;
}

// Apply what the application has set since the creation of an instance that is lost.
static hair_result apply_settings(hair_instance* hair, hair_instance* lost)
{
    const struct hair_pins* pins = &lost->sim.pins;
    struct hair_resolved_pin* own = NULL;
    hair_wind wind = lost->sim.wind;
    wind.sources = lost->sim.wind_state.source;
    wind.texture = 0; // The name means another object in another OpenGL context.
    hair_sim_set_wind(&hair->sim, &wind);
    for (uint32_t g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        if (lost->sim.groups.own >> g & 1)
            HAIR_TRY(hair_sim_set_group_physics(&hair->sim, g, &lost->sim.groups.physics[g]));
    if (lost->group_looks) HAIR_TRY(hair_instance_set_group_looks(hair, lost->group_looks));
    HAIR_TRY(hair_targets_set_blend(&hair->sim, &lost->sim.targets.blend, lost->sim.targets.guide_weights));
    // The state is checked as bytes of a file are. A state that is refused leaves the hair at rest.
    hair_result result = hair_snapshots_load(&hair->sim, &lost->sim.snapshots);
    if (result && result != HAIR_ERROR_FILE) return result;
    HAIR_TRY(hair_sim_copy_lengths(&hair->sim, &lost->sim.lengths));
    HAIR_TRY(hair_colliders_copy(&hair->context->host, &hair->sim.colliders, &lost->sim.colliders));
    hair_sim_set_head(&hair->sim, &lost->sim.head);
    if (pins->count) {
        own = hair_alloc(&hair->context->host, pins->count, sizeof *own);
        if (!own) return hair_fail_memory(&hair->context->host, "the pins");
        memcpy(own, pins->resolved_pin, pins->count * sizeof *own);
    }
    hair_pins_adopt(&hair->sim, own, pins->count);
    hair_impulses_set(&hair->sim, lost->sim.impulses.strands);
    return hair_scalp_skin_copy(&hair->context->gl, &lost->sim.scalp_motion.skin,
                                hair_scalp_motion_vertex_count(&hair->sim), &hair->sim.scalp_motion.skin);
}

// Make the rooms of an instance again, in place of those that are lost.
static hair_result make_again(hair_instance* hair, hair_instance* lost)
{
    struct hair_sim_desc sim = {.solver = lost->sim.solver,
                                .substep = lost->sim.asked_substep,
                                .is_diagnosed = hair_sim_is_diagnosed(&lost->sim),
                                .physics = lost->sim.physics,
                                .head = lost->sim.head,
                                .wind = hair_wind_default()};
    *hair = (hair_instance){.member = lost->member,
                            .context = lost->context,
                            .max_dt = lost->max_dt,
                            .creation = lost->creation,
                            .groom = hair_groom_retain(lost->groom),
                            .has_slowed = lost->has_slowed,
                            .has_left_out = lost->has_left_out,
                            .look = lost->look};
    memcpy(hair->label, lost->label, sizeof hair->label);
    hair_enter_unprofiled(hair);
    hair_result result = hair_instance_create_rooms(hair, hair->groom, &sim);
    if (!result) result = apply_settings(hair, lost);
    return hair_leave(hair->context, result);
}

// Make the grids of all bodies again. Instances read them from their first step on.
static hair_result make_bodies_again(hair_context* context, struct lost* lost)
{
    hair_body* body = find_body(context->members);
    for (uint32_t i = 0; body; body = find_body(body->member.next)) {
        lost->grids[i++] = body->grid;
        body->grid = (struct hair_body_grid){0};
    }
    for (body = find_body(context->members); body; body = find_body(body->member.next))
        HAIR_TRY(hair_body_create_grid(body));
    return HAIR_OK;
}

// Free the grids of all bodies, and put `grids` in their place.
static void replace_grids(hair_context* context, const struct hair_body_grid* grids)
{
    hair_body* body = find_body(context->members);
    for (uint32_t i = 0; body; body = find_body(body->member.next)) {
        hair_body_grid_destroy(&body->grid);
        body->grid = grids[i++];
    }
}

// Empty the first `count` instances, whose rooms are of the current OpenGL context, and put back
// everything that was lost.
static void undo(hair_context* context, const struct lost* lost, uint32_t count)
{
    hair_instance* hair = find_instance(context->members);
    for (uint32_t i = 0; i < lost->count; ++i, hair = find_next(hair)) {
        if (i < count) hair_instance_empty(&hair->member);
        *hair = lost->instances[i];
    }
    replace_grids(context, lost->grids);
    hair_sdf_pool_free(&context->sdf_pool);
    hair_batch_free(&context->batch);
    hair_gl_destroy(&context->gl);
    context->gl = lost->gl;
    context->sdf_pool = lost->sdf_pool;
    context->batch = lost->batch;
}

static hair_result make_all_again(hair_context* context, struct lost* lost)
{
    hair_instance* hair = find_instance(context->members);
    for (uint32_t i = 0; i < lost->count; ++i, hair = find_next(hair)) lost->instances[i] = *hair;
    hair_result result = make_bodies_again(context, lost);
    if (result) {
        undo(context, lost, 0);
        return result;
    }
    hair = find_instance(context->members);
    for (uint32_t i = 0; i < lost->count; ++i, hair = find_next(hair)) {
        result = make_again(hair, &lost->instances[i]);
        if (!result) continue;
        undo(context, lost, i + 1);
        return result;
    }
    return HAIR_OK;
}

// Free everything that was lost, but keep the snapshots. No OpenGL is called.
static void free_lost(hair_context* context, struct lost* lost)
{
    struct hair_gl gl = context->gl;
    struct hair_sdf_pool sdf_pool = context->sdf_pool;
    struct hair_batch batch = context->batch;
    hair_instance* hair = find_instance(context->members);
    context->gl = lost->gl;
    context->sdf_pool = lost->sdf_pool;
    context->batch = lost->batch;
    hair_gl_ignore_deletions(&context->gl);
    hair_body* body = find_body(context->members);
    for (uint32_t i = 0; body; body = find_body(body->member.next)) hair_body_grid_destroy(&lost->grids[i++]);
    for (uint32_t i = 0; i < lost->count; ++i, hair = find_next(hair)) {
        hair_snapshots_move(&hair->sim.snapshots, &lost->instances[i].sim.snapshots);
        hair_instance made = *hair;
        *hair = lost->instances[i];
        hair_instance_empty(&hair->member);
        *hair = made;
    }
    for (struct hair_context_member* member = context->members; member; member = member->next)
        if (member->empty != hair_instance_empty && member->empty != hair_body_empty)
            hair_gl_free_shader_programs(&context->gl, &((hair_shader*)member)->gl);
    hair_sdf_pool_free(&context->sdf_pool);
    hair_batch_free(&context->batch);
    hair_gl_destroy(&context->gl);
    context->gl = gl;
    context->sdf_pool = sdf_pool;
    context->batch = batch;
}

// Make the library's own objects in the OpenGL context that is current now.
static hair_result make_gl(const hair_context* context, struct hair_gl* out)
{
    const struct hair_gl* was = &context->gl;
    hair_context_desc desc = context->desc;
    desc.cache = was->cache.get ? &was->cache : NULL;
    desc.glsl_dir = was->glsl_dir;
    HAIR_TRY(hair_gl_create(out, &context->host, &desc));
    hair_gl_memory_set_limit(out, was->memory.limit);
    return HAIR_OK;
}

hair_result hair_context_restore(hair_context* context)
{
    HAIR_TRY(hair_check_context(context));
    const hair_host* host = &context->host;
    if (!context->desc.restorable)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_context_desc.restorable was false");
    struct lost lost = {.count = count_members(context, hair_instance_empty),
                        .grid_count = count_members(context, hair_body_empty)};
    struct hair_gl made;
    lost.instances = hair_alloc(host, lost.count ? lost.count : 1, sizeof *lost.instances);
    lost.grids = hair_alloc(host, lost.grid_count ? lost.grid_count : 1, sizeof *lost.grids);
    hair_result result = lost.instances && lost.grids ? make_gl(context, &made)
                                                      : hair_fail_memory(host, "the instances to restore");
    if (!result) {
        lost.gl = context->gl;
        lost.sdf_pool = context->sdf_pool;
        lost.batch = context->batch;
        context->gl = made;
        hair_sdf_pool_init(&context->sdf_pool, &context->gl);
        hair_batch_init(&context->batch, &context->gl);
        result = make_all_again(context, &lost);
        if (!result) {
            hair_fastest_find(&context->gl, &context->fastest);
            hair_gl_frame_timer_forget(&context->budget.timer);
            free_lost(context, &lost);
        }
    }
    hair_free(host, lost.instances);
    hair_free(host, lost.grids);
    return result;
}
