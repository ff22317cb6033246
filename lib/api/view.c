// view.c - public calls that draw an instance or read it back.
#include "lib/api/api.h"

#include <math.h>
#include <string.h>

#define PARALLEL 1e-3 // Maximum sine of the angle that rounding may leave.

// Return whether depth clearly grows towards a directional light. `towards` is its gradient times
// the direction, and `square` its squared length.
static bool is_opposite(const hair_light* light, double towards, double square)
{
    double length = (double)hair_length(hair_load3(light->direction));
    return towards > 0.5 * length * sqrt(square);
}

// Return whether a light's matrix is orthographic, or in perspective with a depth that grows away
// from the light. An orthographic matrix of a directional light must not have the opposite depth.
// Reversed depth z counts as 1 - z. The depth in perspective must be z = a - b / w, with b above 0,
// in front of the light. Clip space then has a w that grows away from the light, and its depth is
// a w - b.
static int is_seen_from_light(const hair_light* light)
{
    const float* m = light->shadow_matrix;
    double zz = 0, zw = 0, ww = 0, z[4], towards = 0;
    for (int i = 0; i < 4; ++i) {
        double own = (double)m[4 * i + 2], w = (double)m[4 * i + 3];
        z[i] = light->shadow_depth_reversed ? w - own : own;
        if (i == 3) break;
        zz += z[i] * z[i];
        zw += z[i] * w;
        ww += w * w;
        towards += z[i] * (double)light->direction[i];
    }
    if (ww == 0)
        return m[15] == 1 && !(light->kind == HAIR_LIGHT_DIRECTIONAL && is_opposite(light, towards, zz));
    if (light->kind == HAIR_LIGHT_DIRECTIONAL) return 0;
    double a = zw / ww;
    return zw > 0 && zz * ww - zw * zw <= PARALLEL * PARALLEL * zz * ww && a * (double)m[15] > z[3];
}

// Check that the rectangle of a map ends in the texture.
static hair_result check_part(const hair_instance* hair, uint32_t light, const char* name,
                              const float offset[2], const float size[2])
{
    for (int k = 0; k < 2; ++k)
        if (!(offset[k] + size[k] <= 1.0001f))
            return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                             "%s: hair_view.lights[%u].%s ends at %g, beyond the texture, which ends at 1",
                             hair->label, light, name, (double)(offset[k] + size[k]));
    return HAIR_OK;
}

static hair_result check_light(const hair_instance* hair, const hair_light* light, uint32_t i)
{
    const hair_host* host = &hair->context->host;
    if (light->kind != HAIR_LIGHT_POINT && !(hair_length(hair_load3(light->direction)) > 1e-12f))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_view.lights[%u].direction has no direction",
                         hair->label, i);
    if (light->kind == HAIR_LIGHT_SPOT && !(light->inner_angle < light->outer_angle))
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_view.lights[%u].inner_angle is %g, not below its outer_angle, %g",
                         hair->label, i, (double)light->inner_angle, (double)light->outer_angle);
    if (light->hair_shadow_map)
        HAIR_TRY(check_part(hair, i, "hair_shadow_part", light->hair_shadow_part.offset,
                            light->hair_shadow_part.size));
    if (light->opaque_shadow_map)
        HAIR_TRY(check_part(hair, i, "opaque_shadow_part", light->opaque_shadow_part.offset,
                            light->opaque_shadow_part.size));
    if (!(light->hair_shadow_map || light->opaque_shadow_map) || is_seen_from_light(light)) return HAIR_OK;
    return hair_fail(
        host, HAIR_ERROR_ARGUMENT, "%s: hair_view.lights[%u].shadow_matrix is %s", hair->label, i,
        light->kind == HAIR_LIGHT_DIRECTIONAL
            ? "not orthographic with the last row (0, 0, 0, 1) and depth that grows away from the light"
            : "neither orthographic nor in perspective, with depth that grows away from the light");
}

// Structs that a caller's view points to, checked and copied.
struct storage {
    hair_lod lod;
    hair_light light[HAIR_LIGHTS];
};

// Copy and check the lights. They are as far apart as the caller's struct is long.
static hair_result copy_lights(const hair_instance* hair, hair_view* view, hair_light light[HAIR_LIGHTS])
{
    const hair_host* host = &hair->context->host;
    hair_light usual = hair_light_default();
    const char* at = (const char*)view->lights;
    size_t stride = at ? view->lights->header.size : 0;
    HAIR_ASSERT(view->light_count <= HAIR_LIGHTS);
    uint32_t shadows = 0;
    for (uint32_t i = 0; i < view->light_count; ++i) {
        HAIR_TRY(HAIR_COPY_IN(host, hair_light, at ? at + i * stride : (const char*)&usual, &light[i]));
        HAIR_TRY(check_light(hair, &light[i], i));
        shadows += light[i].hair_shadow_map || light[i].opaque_shadow_map;
    }
    view->lights = light;
    if (shadows > HAIR_SHADOW_MAPS)
        return hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "%s: %u of hair_view.lights have a hair_shadow_map or a opaque_shadow_map, not at most %d",
            hair->label, shadows, HAIR_SHADOW_MAPS);
    return HAIR_OK;
}

static hair_result check_sky(const hair_instance* hair, const float* sky)
{
    for (int i = 0; sky && i < 27; ++i)
        if (!(sky[i] >= -1e6f && sky[i] <= 1e6f))
            return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                             "%s: hair_view.sky[%d] is %g, not in [-1e6, 1e6]", hair->label, i,
                             (double)sky[i]);
    return HAIR_OK;
}

static hair_result copy_view(const hair_instance* hair, const hair_view* view, hair_view* own,
                             struct storage* storage)
{
    const hair_host* host = &hair->context->host;
    HAIR_TRY(HAIR_COPY_IN(host, hair_view, view, own));
    if (own->lod) {
        HAIR_TRY(HAIR_COPY_IN(host, hair_lod, own->lod, &storage->lod));
        own->lod = &storage->lod;
    }
    if (own->shader && own->shader->context != hair->context)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_view.shader is of another context",
                         hair->label);
    HAIR_TRY(copy_lights(hair, own, storage->light));
    return check_sky(hair, own->sky);
}

// Check the framebuffer. Drawing into an incomplete one would raise the application's error flag
// and draw nothing.
static hair_result check_framebuffer(const hair_instance* hair)
{
    GLenum status = hair->context->gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_OPENGL,
                     "%s: the bound framebuffer is not complete: status 0x%04X%s", hair->label, status,
                     status == GL_FRAMEBUFFER_UNDEFINED ? ", there is none" : "");
}

// Draw the colliders. Only a slice needs the field, and collision meshes, which shaders read from
// the field's copy.
static hair_result draw_colliders(hair_instance* hair, const hair_view* view)
{
    const struct hair_collider_list* list = hair_sim_colliders(&hair->sim);
    int needed = view->slice != HAIR_SLICE_NONE;
    for (uint32_t i = 0; i < list->count; ++i) needed |= list->collider[i].mesh != NULL;
    if (needed) HAIR_TRY(hair_update_field(hair));
    return hair_draw_colliders(&hair->renderer, &hair->field, list->collider, list->count,
                               &hair->sim.head_at_last_step, view);
}

static hair_result draw_air(hair_instance* hair, const hair_view* view)
{
    const struct hair_sim* sim = &hair->sim;
    if (!hair_sim_has_wind(sim)) return HAIR_OK;
    return hair_draw_air(&hair->renderer, &sim->wind_state, &sim->wind, hair_sim_fluid(sim), &hair->field.box,
                         &sim->head_at_last_step, view);
}

hair_result hair_update_follower_collision(hair_instance* hair)
{
    struct hair_geometry* geometry = &hair->geometry;
    const hair_look* look = &geometry->look;
    if (hair_geometry_has_follower_collision(geometry)) return HAIR_OK;
    bool is_shown = geometry->push_out_weight > 0;
    bool collides =
        is_shown && look->followers.collision != HAIR_FOLLOWER_COLLISION_NONE && geometry->followers;
    bool blocks = look->self_shadow.method == HAIR_SELF_SHADOW_STRANDS;
    hair_geometry_set_blockers(geometry, NULL);
    if (collides || blocks) HAIR_TRY(hair_update_field(hair));
    const struct hair_collider_field* field =
        (collides || blocks) && hair_field_is_near(&hair->field) ? &hair->field : NULL;
    if (is_shown) {
        if (!hair_sim_colliders(&hair->sim)->count) hair_geometry_free_follower_collision(geometry);
        HAIR_TRY(hair_geometry_update_follower_collision(geometry, collides ? field : NULL,
                                                         hair->sim.physics.collision.margin));
    }
    hair_geometry_set_blockers(geometry, field);
    return HAIR_OK;
}

// Tell the renderer how far strands may be from where the groom has them. Culling depends on it.
static void update_attachment(hair_instance* hair)
{
    hair_renderer_set_attachment(&hair->renderer, hair_sim_has_fixed_roots(&hair->sim),
                                 hair_sim_has_attached_strands(&hair->sim));
}

static int is_of_surroundings(const hair_view* view)
{
    return view->pass == HAIR_PASS_COLLIDERS || view->pass == HAIR_PASS_WIND;
}

// Return whether a view shows no hair and may be skipped. Velocities must be drawn in every frame.
static int is_out_of_view(const hair_instance* hair, const hair_view* view)
{
    if (is_of_surroundings(view) || hair_draw_has_motion(view)) return 0;
    return hair_sim_has_attached_strands(&hair->sim) &&
           hair_draw_is_out_of_view(&hair->renderer, &hair->sim.head_at_last_step, view);
}

// Record the request of a view. Return whether it is to be drawn.
static int is_to_be_drawn(hair_instance* hair, const struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    struct hair_frame_requests* requests = hair_current_requests(hair);
    if (is_of_surroundings(view) || view->pass == HAIR_PASS_GUIDES) return !is_out_of_view(hair, view);
    int kind = view->pass == HAIR_PASS_OPACITY ? 2 : view->pass == HAIR_PASS_DEPTH;
    HAIR_ASSERT(0 <= kind && kind < 3);
    int unseen = is_out_of_view(hair, view);
    ++requests->views[kind];
    requests->unseen[kind] += (uint32_t)unseen;
    requests->strand_list |= !unseen && plan->has_strand_list;
    requests->vertex_cache |= !unseen && plan->vertices == HAIR_VERTICES_CACHED;
    requests->occlusion |= !unseen && hair_draw_uses_occlusion(view);
    return !unseen && hair_geometry_shows_followers(&hair->geometry);
}

static void make_plan(const hair_instance* hair, const hair_view* view, struct hair_draw_plan* out)
{
    hair_draw_make_plan(&hair->renderer, view, view->shader ? &view->shader->gl : NULL, out);
}

hair_result hair_draw(hair_instance* hair, const hair_view* view)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_context* context = hair->context;
    hair_view own;
    struct storage storage;
    HAIR_TRY(copy_view(hair, view, &own, &storage));
    HAIR_TRY(hair_check_current(context));
    hair_result result = hair_check_view_textures(hair, &own);
    if (!result) result = check_framebuffer(hair);
    if (result) return hair_check_lost(context, result);
    struct hair_draw_plan plan;
    make_plan(hair, &own, &plan);
    if (!is_to_be_drawn(hair, &plan)) return HAIR_OK;
    hair_enter(hair);
    hair_draw_free_unused(&hair->renderer, hair->profiler.number);
    if (is_of_surroundings(&own)) {
        result = own.pass == HAIR_PASS_COLLIDERS ? draw_colliders(hair, &own) : draw_air(hair, &own);
    } else {
        hair_geometry_ensure_guides(&hair->geometry, &hair->sim);
        hair_draw_select_lod(&hair->renderer, &hair->sim.head_at_last_step, &plan);
        if (own.pass != HAIR_PASS_GUIDES && hair_geometry_shows_followers(&hair->geometry))
            result = hair_update_follower_collision(hair);
        update_attachment(hair);
        if (!result) result = hair_draw_run(&hair->renderer, &hair->sim.head_at_last_step, &plan);
        if (result == HAIR_ERROR_MEMORY && hair_draw_avoid_cache(&hair->renderer, &plan)) {
            make_plan(hair, &own, &plan);
            hair_draw_select_lod(&hair->renderer, &hair->sim.head_at_last_step, &plan);
            result = hair_draw_run(&hair->renderer, &hair->sim.head_at_last_step, &plan);
        }
    }
    result = hair_leave(context, result);
    if (!result) hair_sim_set_unseen_time(&hair->sim, 0);
    return result;
}

static hair_result ensure_programs(hair_instance* hair, struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    struct hair_gl* gl = &hair->context->gl;
    const struct hair_sim* sim = &hair->sim;
    int colliders = hair_sim_colliders(sim)->count > 0, shows = view->pass == HAIR_PASS_COLLIDERS;
    if (view->pass == HAIR_PASS_GUIDES) return hair_gl_ensure_program(gl, HAIR_GL_GUIDES);
    if (view->pass == HAIR_PASS_WIND)
        return hair_sim_has_wind(sim) ? hair_gl_ensure_program(gl, HAIR_GL_AIR) : HAIR_OK;
    if (colliders && (!shows || view->slice)) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_VOXELISE));
    if (sim->colliders.meshes) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_VOXELISE_MESHES));
    if (shows) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_COLLIDERS));
    if (shows && view->slice) HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_SLICE));
    if (shows) return HAIR_OK;
    hair_draw_bind_plan(&hair->renderer, plan); // Machine code depends on the formats of textures.
    hair_result result = hair_draw_precompile(&hair->renderer, plan, colliders);
    hair_lighting_unbind(hair->renderer.lighting);
    return result;
}

hair_result hair_precompile(hair_instance* hair, const hair_view* view, bool* ready)
{
    HAIR_TRY(hair_check_instance(hair));
    if (!ready) return HAIR_ERROR_ARGUMENT;
    struct hair_gl* gl = &hair->context->gl;
    hair_view own;
    struct storage storage;
    if (view) HAIR_TRY(copy_view(hair, view, &own, &storage));
    HAIR_TRY(hair_check_current(hair->context));
    struct hair_draw_plan plan;
    if (view) make_plan(hair, &own, &plan);
    hair_enter_unprofiled(hair);
    hair_gl_begin_async(gl);
    hair_result result = hair_sim_ensure_programs(&hair->sim);
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
