// view.c - public calls that prepare a view or read an instance back.
#include "lib/api/api.h"

#include <string.h>

static hair_result ensure_programs(hair_instance* hair, struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    struct hair_gl* gl = &hair->context->gl;
    const struct hair_sim* sim = &hair->sim;
    int colliders = hair_sim_colliders(sim)->count > 0, shows = view->pass == HAIR_PASS_COLLIDERS;
    if (view->pass == HAIR_PASS_GUIDES) return hair_gl_ensure_program(gl, HAIR_GL_GUIDES);
    if (view->pass == HAIR_PASS_WIND)
        return hair_sim_has_wind(sim) ? hair_gl_ensure_program(gl, HAIR_GL_AIR) : HAIR_OK;
    if (hair_wind_coupling_is_on(sim)) hair_field_want_numbers(&hair->field);
    if (colliders && (!shows || view->slice))
        HAIR_TRY(hair_gl_ensure_program(gl, hair_field_pass(&hair->field, HAIR_GL_VOXELISE)));
    if (sim->colliders.meshes)
        HAIR_TRY(hair_gl_ensure_program(gl, hair_field_pass(&hair->field, HAIR_GL_VOXELISE_MESHES)));
    if (shows) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_COLLIDERS));
    if (shows && view->slice) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_SLICE));
    if (shows) return HAIR_OK;
    // Machine code depends on the formats of textures.
    HAIR_TRY(hair_draw_ensure_textures(&hair->renderer, plan));
    hair_draw_bind_plan(&hair->renderer, plan);
    hair_result result = hair_draw_precompile(&hair->renderer, plan, colliders);
    hair_lighting_unbind(hair->renderer.lighting);
    return result;
}

hair_result hair_precompile(hair_instance* hair, const hair_view* view, bool* ready)
{
    HAIR_TRY(hair_check_instance(hair));
    if (!ready) return HAIR_ERROR_ARGUMENT;
    struct hair_gl* gl = &hair->context->gl;
    struct hair_view_copy own;
    if (view) {
        HAIR_TRY(hair_copy_view(hair, view, &own));
        hair_reduce_view(hair, &own);
    }
    HAIR_TRY(hair_check_current(hair->context));
    struct hair_draw_plan plan;
    if (view) {
        hair_gl_read_draw_state(gl);
        hair_make_plan(hair, &own.view, &plan);
    }
    hair_enter_unprofiled(hair);
    hair_gl_begin_async(gl);
    bool may_derive = view && own.view.lod && own.view.lod->guide_pixels > 0;
    hair_result result = hair_sim_ensure_programs(&hair->sim, may_derive);
    if (!result && view) result = ensure_programs(hair, &plan);
    uint32_t pending = hair_gl_end_async(gl);
    result = hair_leave(hair->context, result);
    if (result) return result;
    if (pending > hair->told_pending)
        hair_log(&hair->context->host, HAIR_LOG_INFO, "%s: %u programs are to come before hair is ready",
                 hair->label, pending);
    hair->told_pending = pending;
    *ready = pending == 0;
    return HAIR_OK;
}

// Copy positions to world space. `from` has xyz from the head's origin in the first three floats of
// every `stride`.
static void copy_to_world(const float* from, size_t stride, uint32_t count, const struct hair_pose* head,
                          float* out)
{
    HAIR_ASSERT(stride >= 3);
    for (uint32_t i = 0; i < count; ++i, from += stride, out += 3)
        for (int k = 0; k < 3; ++k) out[k] = (float)(head->position[k] + (double)from[k]);
}

static hair_result read_buffer(hair_instance* hair, GLuint buffer, uint32_t count, size_t stride,
                               const struct hair_pose* head, float* positions)
{
    struct hair_gl* gl = &hair->context->gl;
    float* copy = hair_alloc(&gl->host, count, stride * sizeof *copy);
    if (!copy) return hair_fail_memory(&gl->host, "the vertices to read");
    hair_gl_read(gl, buffer, count * stride * sizeof *copy, copy);
    copy_to_world(copy, stride, count, head, positions);
    hair_free(&gl->host, copy);
    return hair_check_lost(hair->context, HAIR_OK);
}

// Enter the context, and prepare the followers to be read in full detail.
static hair_result enter_to_read(hair_instance* hair)
{
    hair_enter_unprofiled(hair);
    hair_geometry_ensure_guides(&hair->geometry, &hair->sim);
    hair_draw_select_lod(&hair->renderer, &hair->sim.head_at_last_step, NULL);
    return hair_update_follower_collision(hair);
}

hair_result hair_read_nearby_vertices(hair_instance* hair, const struct hair_cutter* cutter,
                                      struct hair_nearby_vertices* out)
{
    hair_result result = enter_to_read(hair);
    if (!result) result = hair_geometry_read_nearby(&hair->geometry, hair->groom, cutter, out);
    return hair_leave(hair->context, result);
}

static hair_result read_followers(hair_instance* hair, uint32_t count, float* positions)
{
    hair_vec4* vertices = NULL;
    hair_result result = enter_to_read(hair);
    if (!result) result = hair_draw_read_vertices(&hair->renderer, &vertices);
    result = hair_leave(hair->context, result);
    if (!result && vertices) copy_to_world(&vertices->x, 4, count, &hair->sim.head_at_last_step, positions);
    hair_free(&hair->context->host, vertices);
    return result;
}

static hair_result read_smooth(hair_instance* hair, uint32_t count, float* positions)
{
    hair_enter_unprofiled(hair);
    hair_geometry_ensure_guides(&hair->geometry, &hair->sim);
    HAIR_TRY(hair_leave(hair->context, HAIR_OK));
    return read_buffer(hair, hair_geometry_smoothed_positions(&hair->geometry), count, 4,
                       &hair->sim.head_at_last_step, positions);
}

hair_result hair_read_positions(hair_instance* hair, hair_read_source what, float* positions,
                                uint32_t capacity, uint32_t* count)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    if (!count) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: count is NULL", hair->label);
    if (!positions && capacity)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: positions is NULL but capacity is %u", hair->label,
                         capacity);
    HAIR_TRY(hair_check_current(hair->context));

    const struct hair_sim* sim = &hair->sim;
    uint64_t all = 0;
    switch (what) {
    case HAIR_READ_GUIDES: all = sim->guide_vertices; break;
    case HAIR_READ_SMOOTH: all = hair_geometry_count_smoothed(&hair->geometry); break;
    case HAIR_READ_FOLLOWERS: all = hair_geometry_count_vertices(&hair->geometry); break;
    default:
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: source is %d, not in [0, %d]", hair->label,
                         (int)what, HAIR_READ_FOLLOWERS);
    }
    if (all > UINT32_MAX)
        return hair_fail(host, HAIR_ERROR_MEMORY, "%s: %llu vertices are too many to read", hair->label,
                         (unsigned long long)all);
    *count = (uint32_t)all;
    uint32_t number = *count < capacity ? *count : capacity;
    HAIR_ASSERT(number <= *count);
    if (number == 0) return HAIR_OK;
    HAIR_TRY(hair_catch_up(&hair, 1));
    hair_sim_set_unseen_time(&hair->sim, 0);
    if (what == HAIR_READ_FOLLOWERS) return read_followers(hair, number, positions);
    if (what == HAIR_READ_SMOOTH) return read_smooth(hair, number, positions);
    HAIR_TRY(read_buffer(hair, sim->state, number, sizeof(struct hair_state) / sizeof(float),
                         &sim->last_after, positions));
    hair_lengths_move_lost(sim, positions, number);
    return HAIR_OK;
}

hair_result hair_get_solver_stats(hair_instance* hair, hair_solver_stats* out)
{
    HAIR_TRY(hair_check_instance(hair));
    HAIR_TRY(hair_check_current(hair->context));
    hair_solver_stats own = hair_solver_stats_default();
    hair_enter_unprofiled(hair);
    HAIR_TRY(hair_leave(hair->context, hair_sim_solver_stats(&hair->sim, &own)));
    return HAIR_COPY_OUT(&hair->context->host, hair_solver_stats, &own, out);
}
