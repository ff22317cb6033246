// instance.c - public calls that create one head of living hair, move it and set what it is like.
#include "lib/api/api.h"
#include "lib/base/crc.h"
#include "lib/gl/capture.h"

#include <string.h>

#define SHORTEST 1e-5f // Minimum substep, s, which bounds the time of a step.

hair_result hair_check_transform(const hair_instance* hair, const char* name, const float* transform,
                                 struct hair_pose* out)
{
    const hair_host* host = &hair->context->host;
    if (!transform) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: %s is NULL", hair->label, name);
    if (!hair_pose_from_matrix(transform, out))
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: %s is not a rigid motion to 1e-3: no scale, no shear, no mirror", hair->label,
                         name);
    for (int i = 0; i < 3; ++i)
        if (!(fabs(out->position[i]) <= 1e9))
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: %s[%d] is %g, not in [-1e9, 1e9]", hair->label,
                             name, 12 + i, out->position[i]);
    return HAIR_OK;
}

void hair_tell_softened(hair_instance* hair)
{
    struct hair_rods_softened now = hair_sim_preload_report(&hair->sim).softened, *told = &hair->told;
    if (now.guides == told->guides && now.worst == told->worst && now.factor == told->factor) return;
    *told = now;
    if (!now.guides) {
        hair_log(&hair->context->host, HAIR_LOG_INFO, "%s: no guide is softened any more", hair->label);
        return;
    }
    hair_log(&hair->context->host, HAIR_LOG_INFO,
             "%s: %u of %u guides are softened to what single precision can solve in substeps of %.3g s; "
             "guide %u most, to %.3g of its stiffness",
             hair->label, now.guides, hair->sim.guides, hair->sim.substep, now.worst, (double)now.factor);
}

// Return a look with its pigment and its wetness applied.
static hair_look resolved(const hair_look* look)
{
    hair_look own = *look;
    hair_look_apply_pigment(&own);
    hair_look_apply_wetness(&own);
    return own;
}

// Find the bounds of the hair in the head's frame.
static void find_hair_bounds(hair_instance* hair, const hair_groom* groom)
{
    hair->longest = hair_find_bounds(groom, hair->bounds);
    HAIR_ASSERT(hair->longest > 0);
}

hair_result hair_instance_create_rooms(hair_instance* hair, const hair_groom* groom,
                                       struct hair_sim_desc* sim)
{
    hair_context* context = hair->context;
    struct hair_gl* gl = &context->gl;
    hair_look look = resolved(&hair->look);
    hair_thread_mapping mapping = hair->creation.thread_mapping;
    sim->is_by_thread =
        mapping == HAIR_THREAD_MAPPING_AUTO ? gl->software : mapping == HAIR_THREAD_MAPPING_THREAD_PER_GUIDE;
    sim->uses_feedback = mapping == HAIR_THREAD_MAPPING_FEEDBACK;
    sim->has_snapshots = context->desc.restorable;
    sim->sdf_pool = &context->sdf_pool;
    sim->field = &hair->field;
    find_hair_bounds(hair, groom);
    hair_field_create(&hair->field, sim->sdf_pool, groom, hair->creation.field_voxel);
    hair->field_detail = (struct hair_field_detail){.voxel = hair->field.box.voxel};
    HAIR_TRY(hair_sim_create(&hair->sim, gl, groom, sim));
    hair->told = hair_rods_report_none().softened;
    hair_tell_softened(hair);
    HAIR_TRY(
        hair_geometry_create(&hair->geometry, gl, groom, &hair->sim, &look, hair->creation.uses_prepass));
    HAIR_TRY(hair_lighting_create(&hair->lighting, gl, groom));
    hair_renderer_create(&hair->renderer, gl, groom, hair->bounds, &hair->geometry, &hair->lighting,
                         &context->batch, &context->fastest);
    // A number of the instance alone, so that no picture depends on other instances.
    hair->renderer.light_age.turn = hair_crc_add(0, sim->head.position, sizeof sim->head.position);
    hair_sim_reset(&hair->sim);
    return HAIR_OK;
}

static hair_result fill_instance(hair_instance* hair, hair_context* context, const hair_groom* groom,
                                 const hair_desc* desc)
{
    const hair_host* host = &context->host;
    hair->max_dt = (double)desc->max_dt;
    hair->creation = (struct hair_creation){.thread_mapping = desc->thread_mapping,
                                            .uses_prepass = desc->hit_method == HAIR_HIT_METHOD_PREPASS,
                                            .field_voxel = desc->field_voxel};
    strncpy(hair->label, desc->label ? desc->label : "hair", sizeof hair->label - 1);
    if (desc->substep > 0 && desc->substep < SHORTEST)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_desc.substep is %g, not 0 or in [%g, 0.1]",
                         hair->label, (double)desc->substep, (double)SHORTEST);
    if (desc->thread_mapping == HAIR_THREAD_MAPPING_FEEDBACK && desc->solver != HAIR_SOLVER_REDBLACK)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_desc.thread_mapping is HAIR_THREAD_MAPPING_FEEDBACK, which only the "
                         "solver redblack has",
                         hair->label);
    struct hair_sim_desc sim = {.solver = desc->solver,
                                .substep = (double)desc->substep,
                                .is_diagnosed = desc->diagnose,
                                .wind = hair_wind_default()};
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(host, hair_physics, desc->physics, &sim.physics));
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(host, hair_look, desc->look, &hair->look));
    HAIR_TRY(hair_check_transform(hair, "hair_desc.transform", desc->transform, &sim.head));
    HAIR_TRY(hair_check_current(context));
    if (desc->thread_mapping == HAIR_THREAD_MAPPING_FEEDBACK)
        HAIR_TRY(hair_gl_check_capture(&context->gl, hair->label));
    hair_enter_unprofiled(hair);
    hair->groom = hair_groom_retain((hair_groom*)groom);
    return hair_leave(context, hair_instance_create_rooms(hair, groom, &sim));
}

void hair_instance_empty(struct hair_context_member* member)
{
    hair_instance* hair = (hair_instance*)member;
    hair_gl_profiler_free(&hair->context->gl, &hair->profiler);
    hair_renderer_destroy(&hair->renderer);
    hair_lighting_destroy(&hair->lighting);
    hair_geometry_destroy(&hair->geometry);
    hair_sim_destroy(&hair->sim);
    // Last, because the pool drops the distances to a destroyed body once no collider has its mesh.
    hair_field_destroy(&hair->field);
    hair_groom_release(hair->groom);
    hair->groom = NULL;
    hair_free(&hair->context->host, hair->group_looks);
    hair->group_looks = NULL;
    for (int i = 0; i < HAIR_GL_CATEGORIES; ++i) HAIR_ASSERT(hair->memory.bytes[i] == 0);
}

static void release(hair_instance* hair)
{
    hair_host host = hair->context->host;
    hair_context_remove(hair->context, &hair->member);
    hair_free(&host, hair);
}

hair_result hair_create(hair_context* context, const hair_groom* groom, const hair_desc* desc,
                        hair_instance** out)
{
    HAIR_TRY(hair_check_context(context));
    const hair_host* host = &context->host;
    hair_desc own;
    HAIR_TRY(HAIR_COPY_IN(host, hair_desc, desc, &own));
    if (!groom) return hair_fail(host, HAIR_ERROR_ARGUMENT, "groom is NULL");
    if (!out) return hair_fail(host, HAIR_ERROR_ARGUMENT, "out is NULL");
    hair_instance* hair = hair_alloc(host, 1, sizeof *hair);
    if (!hair) return hair_fail_memory(host, "an instance");
    hair->context = context;
    hair_context_add(context, &hair->member, hair_instance_empty);
    hair_result result = fill_instance(hair, context, groom, &own);
    if (result) {
        release(hair);
        return result;
    }
    *out = hair;
    return HAIR_OK;
}

void hair_destroy(hair_instance* hair)
{
    if (!hair) return;
    hair_context_tell_left(hair->context);
    release(hair);
}

hair_result hair_set_physics(hair_instance* hair, const hair_physics* physics)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_physics own;
    HAIR_TRY(HAIR_COPY_IN(&hair->context->host, hair_physics, physics, &own));
    if (own.collision.margin != hair->sim.physics.collision.margin) hair_geometry_invalidate(&hair->geometry);
    hair_sim_set_physics(&hair->sim, &own);
    return HAIR_OK;
}

hair_result hair_get_physics(const hair_instance* hair, hair_physics* out)
{
    HAIR_TRY(hair_check_instance(hair));
    return HAIR_COPY_OUT(&hair->context->host, hair_physics, &hair->sim.physics, out);
}

hair_result hair_set_look(hair_instance* hair, const hair_look* look)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_look own;
    HAIR_TRY(HAIR_COPY_IN(&hair->context->host, hair_look, look, &own));
    hair->look = own;
    own = resolved(&own);
    if (memcmp(&own, &hair->geometry.look, sizeof own) != 0) hair_draw_forget_vertices(&hair->renderer);
    hair_geometry_set_look(&hair->geometry, &own);
    return HAIR_OK;
}

hair_result hair_get_look(const hair_instance* hair, hair_look* out)
{
    HAIR_TRY(hair_check_instance(hair));
    return HAIR_COPY_OUT(&hair->context->host, hair_look, &hair->look, out);
}

hair_result hair_set_transform(hair_instance* hair, const float transform[16])
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_pose pose;
    HAIR_TRY(hair_check_transform(hair, "transform", transform, &pose));
    hair_sim_set_head(&hair->sim, &pose);
    return HAIR_OK;
}

hair_result hair_get_transform(const hair_instance* hair, float transform[16])
{
    HAIR_TRY(hair_check_instance(hair));
    if (!transform)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: transform is NULL", hair->label);
    hair_pose_to_matrix(&hair->sim.head, transform);
    return HAIR_OK;
}

hair_result hair_set_colliders(hair_instance* hair, const hair_collider* colliders, uint32_t count,
                               size_t stride)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    hair_result result = hair_sim_set_colliders(&hair->sim, colliders, count, stride);
    uint32_t contacts = hair_sim_contacts(&hair->sim);
    if (hair_sim_has_new_colliders(&hair->sim)) hair_geometry_invalidate(&hair->geometry);
    if (!result && !hair->sim.rods && count > contacts && !hair->has_left_out) {
        hair->has_left_out = 1;
        hair_log(
            host, HAIR_LOG_WARNING,
            "%s: of %u colliders guides collide with %u: the nearest %d, and none but spheres and capsules",
            hair->label, count, contacts, HAIR_STEP_COLLIDERS);
    }
    return result;
}
