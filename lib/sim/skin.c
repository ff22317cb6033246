// skin.c - the buffers of a skinned scalp, and the passes that compute the scalp motion.
#include "lib/sim/skin.h"
#include "lib/sim/sim.h"

#include <string.h>

static void free_buffers(struct hair_sim* sim)
{
    struct hair_skin* skin = &sim->skin;
    hair_gl_free_buffer_texture(sim->gl, &skin->texture);
    hair_gl_free_buffer(sim->gl, &skin->ride);
    hair_gl_free_buffer(sim->gl, &skin->seat);
    hair_gl_free_buffer(sim->gl, &skin->rest);
    hair_gl_free_buffer(sim->gl, &skin->scalp[0]);
    hair_gl_free_buffer(sim->gl, &skin->scalp[1]);
    hair_gl_free_buffer(sim->gl, &skin->params);
}

void hair_skin_free(struct hair_sim* sim)
{
    free_buffers(sim);
    hair_seats_release(sim->skin.seats);
    sim->skin.seats = NULL;
}

static size_t scalp_size(const struct hair_skin* skin)
{
    HAIR_ASSERT(skin->seats && skin->seats->vertex_count > 0);
    return 3 * (size_t)skin->seats->vertex_count * sizeof(float);
}

static struct hair_ride* make_rides(const struct hair_sim* sim)
{
    struct hair_ride* rides = hair_alloc(&sim->gl->host, sim->guides, sizeof *rides);
    for (uint32_t i = 0; rides && i < sim->guides; ++i)
        for (int k = 0; k < HAIR_RIDES; ++k) rides[i].turn[k].w = 1;
    return rides;
}

static hair_result make_buffers(struct hair_sim* sim, GLuint* ride)
{
    struct hair_gl* gl = sim->gl;
    struct hair_skin* skin = &sim->skin;
    struct hair_ride* rides = make_rides(sim);
    size_t size = scalp_size(skin);
    if (!rides) return hair_fail_memory(&gl->host, "the skinned scalp");
    hair_result result = hair_gl_storage(gl, "hair rides", sim->guides * sizeof *rides, rides, ride);
    hair_free(&gl->host, rides);
    if (!result)
        result = hair_gl_storage(gl, "hair seats", skin->seats->count * sizeof *skin->seats->seat,
                                 skin->seats->seat, &skin->seat);
    if (!result)
        result = hair_gl_storage(gl, "hair scalp at rest", size, skin->seats->positions, &skin->rest);
    for (int i = 0; i < 2 && !result; ++i) result = hair_gl_uniform(gl, "hair scalp", size, &skin->scalp[i]);
    if (!result)
        result = hair_gl_uniform(gl, "hair scalp params", sizeof(struct hair_scalp_params), &skin->params);
    if (!result) result = hair_gl_buffer_texture(gl, "hair rides", GL_RGBA32F, *ride, &skin->texture);
    return result;
}

static void rest_scalp(struct hair_sim* sim)
{
    struct hair_skin* skin = &sim->skin;
    skin->rotation = (hair_vec4){0, 0, 0, 1};
    skin->offset = (hair_vec4){0, 0, 0, 0};
    skin->fresh = 0;
    hair_gl_write_uniform(sim->gl, skin->scalp[0], scalp_size(skin), skin->seats->positions);
}

hair_result hair_skin_make(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    hair_result result = HAIR_OK;
    GLuint ride = 0;
    if (hair_skin_is_on(sim)) return HAIR_OK;
    result = hair_gl_need_rows(gl, HAIR_GL_SCALP, HAIR_GL_SEAT, 0);
    if (!result) result = hair_gl_need(gl, hair_sim_reset_pass(sim, 1));
    if (!result)
        result =
            hair_gl_need(gl, hair_gl_pass_for(HAIR_GL_SMOOTH | HAIR_GL_WITH(SKINNED), sim->most_vertices));
    if (!result) result = make_buffers(sim, &ride);
    if (result) {
        hair_gl_free_buffer(gl, &ride);
        free_buffers(sim);
        return result;
    }
    sim->skin.ride = ride;
    rest_scalp(sim);
    return HAIR_OK;
}

hair_result hair_skin_make_still(struct hair_sim* sim, GLuint* out)
{
    struct hair_ride* rides = make_rides(sim);
    if (!rides) return hair_fail_memory(&sim->gl->host, "the skinned scalp");
    hair_result result = hair_gl_buffer(sim->gl, "hair rides", sim->guides * sizeof *rides, rides, out);
    hair_free(&sim->gl->host, rides);
    return result;
}

void hair_skin_forget(struct hair_sim* sim, GLuint still)
{
    GLsizeiptr size = (GLsizeiptr)(sim->guides * sizeof(struct hair_ride));
    sim->gl->CopyNamedBufferSubData(still, sim->skin.ride, 0, 0, size);
    rest_scalp(sim);
}

void hair_skin_give(struct hair_sim* sim, const float* positions, const struct hair_pose* space)
{
    struct hair_skin* skin = &sim->skin;
    HAIR_ASSERT(hair_skin_is_on(sim) && positions);
    hair_gl_write_uniform(sim->gl, skin->scalp[1], scalp_size(skin), positions);
    skin->space = *space;
    skin->fresh = 1;
}

static void bind(struct hair_sim* sim, GLuint scalp, struct hair_scalp_params params)
{
    struct hair_gl* gl = sim->gl;
    struct hair_skin* skin = &sim->skin;
    HAIR_ASSERT(hair_skin_is_on(sim) && scalp);
    GLuint storage[] = {skin->ride, scalp, skin->rest, skin->seat};
    params.rotation = skin->rotation;
    params.offset = skin->offset;
    params.vertices = skin->seats->vertex_count;
    params.guides = sim->guides;
    params.smooth_vertices = sim->smooth_vertices;
    hair_gl_write_uniform(gl, skin->params, sizeof params, &params);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_RIDE, 4, storage);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, HAIR_BIND_SCALP_PARAMS, 1, &skin->params);
}

void hair_skin_give_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size, uint32_t first,
                           uint32_t stride, const struct hair_pose* space)
{
    struct hair_gl* gl = sim->gl;
    struct hair_skin* skin = &sim->skin;
    HAIR_ASSERT(stride >= 3);
    HAIR_ASSERT((first + (size_t)stride * (skin->seats->vertex_count - 1) + 3) * sizeof(float) <= size);
    GLintptr at = (GLintptr)offset;
    GLsizeiptr whole = (GLsizeiptr)size;
    hair_gl_write_uniform(gl, skin->scalp[1], scalp_size(skin), NULL);
    bind(sim, skin->scalp[1], (struct hair_scalp_params){.first = first, .stride = stride});
    gl->BindBuffersRange(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GIVEN, 1, &buffer, &at, &whole);
    // Shaders of the application may have written the buffer.
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    hair_gl_run(gl, HAIR_GL_SCALP, (skin->seats->vertex_count + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GIVEN, 1, NULL);
    skin->space = *space;
    skin->fresh = 1;
}

// Make the new scalp the current one. Its transform into the head's frame maps a position p to
//
//   conj(r) s (p + conj(s) (t - o))
//
// where s and t are the rotation and position of its space, and r and o those of the head. In this
// order, large coordinates cancel first.
static void take_fresh(struct hair_sim* sim)
{
    struct hair_skin* skin = &sim->skin;
    HAIR_ASSERT(skin->fresh && skin->scalp[0] != skin->scalp[1]);
    hair_quat s = skin->space.rotation;
    hair_quat q = hair_quat_normalize(hair_quat_multiply(hair_quat_conjugate(sim->head.rotation), s));
    hair_vec3 away = hair_rotate(hair_quat_conjugate(s), hair_pose_offset(&skin->space, &sim->head));
    GLuint given = skin->scalp[1];
    skin->scalp[1] = skin->scalp[0];
    skin->scalp[0] = given;
    skin->rotation = (hair_vec4){q.x, q.y, q.z, q.w};
    skin->offset = (hair_vec4){away.x, away.y, away.z, 0};
}

static void run(struct hair_sim* sim, struct hair_scalp_params params)
{
    struct hair_skin* skin = &sim->skin;
    if (skin->fresh) {
        take_fresh(sim);
        params.what |= HAIR_SCALP_FRESH;
    }
    skin->fresh = 0;
    hair_sim_bind(sim);
    bind(sim, skin->scalp[0], params);
    hair_gl_run(sim->gl, HAIR_GL_RIDE, (sim->guides + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

void hair_skin_ride(struct hair_sim* sim, int again, uint32_t substeps, float before, float after)
{
    HAIR_ASSERT(0 <= before && before <= after && after <= 1);
    run(sim, (struct hair_scalp_params){.what = again ? HAIR_SCALP_AGAIN : 0,
                                        .substeps = substeps,
                                        .share_before = before,
                                        .share_after = after});
}

void hair_skin_reset(struct hair_sim* sim)
{
    run(sim, (struct hair_scalp_params){.what = HAIR_SCALP_RESET});
}

void hair_skin_bind_all(struct hair_sim* sim, uint32_t followers)
{
    bind(sim, sim->skin.scalp[0], (struct hair_scalp_params){.followers = followers});
}
