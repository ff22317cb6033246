// view.c - looking at an instance: drawn, or read back.
#include "lib/api/api.h"

#include <string.h>

static hair_result check_view(const hair_instance* hair, const hair_view* view)
{
    const hair_host* host = &hair->context->host;
    if (view->shader && view->shader->context != hair->context)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_view.shader is of another context",
                         hair->label);
    hair_vec3 to = hair_load3(view->light_to);
    if (!(hair_length(to) > 1e-12f))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_view.light_to has no direction", hair->label);
    const float* m = view->shadow_matrix;
    if (view->shadow_texture && (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1))
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_view.shadow_matrix is not orthographic: its last row is not (0, 0, 0, 1)",
                         hair->label);
    return HAIR_OK;
}

// Drawing into an incomplete one would raise the host's error flag and draw nothing.
static hair_result check_framebuffer(const hair_instance* hair)
{
    GLenum status = hair->context->gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_OPENGL,
                     "%s: the bound framebuffer is not complete: status 0x%04X%s", hair->label, status,
                     status == GL_FRAMEBUFFER_UNDEFINED ? ", there is none" : "");
}

// Binding what is no texture would raise the host's error flag; one of another target would stay bound.
static hair_result check_shadow(const hair_instance* hair, const hair_view* view)
{
    const struct hair_gl* gl     = &hair->context->gl;
    GLint                 target = 0;
    if (!view->shadow_texture || view->pass != HAIR_PASS_COLOR) return HAIR_OK;
    if (gl->IsTexture(view->shadow_texture))
        gl->GetTextureParameteriv(view->shadow_texture, GL_TEXTURE_TARGET, &target);
    if (target == GL_TEXTURE_2D) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT, "%s: hair_view.shadow_texture is %u, not a 2D texture",
                     hair->label, view->shadow_texture);
}

// Only a slice needs the field, and forms, which shaders read from where the field has put them.
static hair_result draw_solids(hair_instance* hair, const hair_view* view)
{
    const struct hair_solid_list* list   = &hair->sim.solids.now;
    int                           needed = view->slice != HAIR_SLICE_NONE;
    for (uint32_t i = 0; i < list->count; ++i) needed |= list->solid[i].form != NULL;
    hair_result result = needed ? hair_update_field(hair) : HAIR_OK;
    if (!result)
        result =
            hair_draw_solids(&hair->draw, &hair->field, list->solid, list->count, &hair->sim.at_step, view);
    return result;
}

// Followers that are inside solids are found and led out before they are looked at.
static hair_result meet_solids(hair_instance* hair)
{
    struct hair_draw* draw = &hair->draw;
    if (hair_draw_has_met_solids(draw, &hair->smooth)) return HAIR_OK;
    int         wanted = draw->look.collision != HAIR_COLLISION_NONE && draw->followers;
    hair_result result = wanted ? hair_update_field(hair) : HAIR_OK;
    if (result) return result;
    int near = wanted && hair_field_is_near(&hair->field);
    return hair_draw_meet_solids(draw, &hair->smooth, near ? &hair->field : NULL, hair->sim.physics.margin);
}

static void make_ready(hair_instance* hair)
{
    hair_smooth_need(&hair->smooth, &hair->sim);
    hair_draw_seat(&hair->draw, &hair->smooth, &hair->sim);
}

// No strand of which a guide's root is held gets farther from there than it is long. The solver redblack stretches it; what
// is tied, or rides on a scalp that is skinned, is where that has it. Velocities want to be asked for in every frame.
static int is_out_of_view(const hair_instance* hair, const hair_view* view)
{
    const struct hair_sim* sim = &hair->sim;
    if (view->pass == HAIR_PASS_SOLIDS || view->pass == HAIR_PASS_MOTION) return 0;
    if (!sim->rods || sim->physics.root == HAIR_ROOT_FREE || sim->ties.count || hair_skin_is_on(sim))
        return 0;
    return hair_draw_is_out_of_view(&hair->draw, &sim->at_step, view);
}

hair_result hair_draw(hair_instance* hair, const hair_view* view)
{
    if (!hair) return HAIR_ERROR_ARGUMENT;
    hair_context* context = hair->context;
    hair_view     own;
    hair_lod      lod;
    hair_result   result = HAIR_TAKE(&context->host, hair_view, view, &own);
    if (!result && own.lod) {
        result  = HAIR_TAKE(&context->host, hair_lod, own.lod, &lod);
        own.lod = &lod;
    }
    if (!result) result = check_view(hair, &own);
    if (!result) result = hair_check_current(context);
    if (!result) result = check_shadow(hair, &own);
    if (!result) result = check_framebuffer(hair);
    if (result || is_out_of_view(hair, &own)) return result;
    hair_gl_enter(&context->gl);
    if (own.pass == HAIR_PASS_SOLIDS) {
        result = draw_solids(hair, &own);
    } else {
        make_ready(hair);
        if (own.pass != HAIR_PASS_GUIDES && hair->draw.look.density > 0) result = meet_solids(hair);
        hair->draw.bounded =
            (hair->sim.physics.root != HAIR_ROOT_FREE || !hair->sim.rods) && !hair_skin_is_on(&hair->sim);
        if (!result)
            result = hair_draw_run(&hair->draw, &hair->smooth, &hair->sim.at_step, &own,
                                   own.shader && own.pass == HAIR_PASS_COLOR ? &own.shader->gl : NULL);
    }
    hair_gl_leave(&context->gl);
    return result;
}

// `from`: xyz from the head's origin in the first three floats of every `stride`.
static void copy_to_world(const float* from, size_t stride, uint32_t count, const struct hair_pose* head,
                          float* out)
{
    for (uint32_t i = 0; i < count; ++i, from += stride, out += 3)
        for (int k = 0; k < 3; ++k) out[k] = (float)(head->position[k] + (double)from[k]);
}

static hair_result read_buffer(hair_instance* hair, GLuint buffer, uint32_t count, size_t stride,
                               const struct hair_pose* head, float* positions)
{
    struct hair_gl* gl   = &hair->context->gl;
    float*          copy = hair_alloc(&gl->host, count, stride * sizeof *copy);
    if (!copy) return hair_fail_memory(&gl->host, "the vertices to read");
    gl->GetNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * stride * sizeof *copy), copy);
    copy_to_world(copy, stride, count, head, positions);
    hair_free(&gl->host, copy);
    return HAIR_OK;
}

static hair_result read_followers(hair_instance* hair, uint32_t count, float* positions)
{
    hair_vec4* vertices = NULL;
    hair_gl_enter(&hair->context->gl);
    make_ready(hair);
    hair_result result = meet_solids(hair);
    if (!result) result = hair_draw_read_expanded(&hair->draw, &hair->smooth, &vertices);
    hair_gl_leave(&hair->context->gl);
    if (result) return result;
    copy_to_world(&vertices->x, 4, count, &hair->sim.at_step, positions);
    hair_free(&hair->context->host, vertices);
    return HAIR_OK;
}

static hair_result read_smooth(hair_instance* hair, uint32_t count, float* positions)
{
    hair_gl_enter(&hair->context->gl);
    make_ready(hair);
    hair_gl_leave(&hair->context->gl);
    return read_buffer(hair, hair->smooth.buffer[0], count, 4, &hair->sim.at_step, positions);
}

hair_result hair_read(hair_instance* hair, hair_read_what what, float* positions, uint32_t capacity,
                      uint32_t* count)
{
    if (!hair) return HAIR_ERROR_ARGUMENT;
    const hair_host* host = &hair->context->host;
    if (!count) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: count is NULL", hair->label);
    if (!positions && capacity)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: positions is NULL but capacity is %u", hair->label,
                         capacity);
    hair_result result = hair_check_current(hair->context);
    if (result) return result;

    const struct hair_sim* sim = &hair->sim;
    uint64_t               all = 0;
    switch (what) {
    case HAIR_READ_GUIDES: all = sim->guide_vertices; break;
    case HAIR_READ_SMOOTH: all = hair->smooth.vertices; break;
    case HAIR_READ_FOLLOWERS: all = (uint64_t)hair->draw.followers * (hair->draw.look.segments + 1); break;
    default:
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: what is %d, not in [0, %d]", hair->label, (int)what,
                         HAIR_READ_FOLLOWERS);
    }
    if (all > UINT32_MAX)
        return hair_fail(host, HAIR_ERROR_MEMORY, "%s: %llu vertices are too many to read", hair->label,
                         (unsigned long long)all);
    *count          = (uint32_t)all;
    uint32_t number = *count < capacity ? *count : capacity;
    if (number == 0) return HAIR_OK;
    if (what == HAIR_READ_FOLLOWERS) return read_followers(hair, number, positions);
    if (what == HAIR_READ_SMOOTH) return read_smooth(hair, number, positions);
    return read_buffer(hair, sim->state, number, sizeof(struct hair_state) / sizeof(float), &sim->last_after,
                       positions);
}

hair_result hair_get_health(hair_instance* hair, hair_health* out)
{
    if (!hair) return HAIR_ERROR_ARGUMENT;
    hair_result result = hair_check_current(hair->context);
    if (result) return result;
    hair_health own = hair_health_default();
    hair_sim_health(&hair->sim, &own);
    return HAIR_GIVE(&hair->context->host, hair_health, &own, out);
}
