// smooth.c - smoothed guides as a structure of arrays, with a buffer and a texture for each.
#include "lib/strands/smooth.h"

static hair_result create_displacements(struct hair_smooth* smooth, const struct hair_groom* groom)
{
    if (!groom->guide_shapes) return HAIR_OK;
    HAIR_TRY(hair_gl_ensure_program(smooth->gl, HAIR_GL_DISPLACE));
    return hair_gl_buffer(smooth->gl, HAIR_GL_CATEGORY_SMOOTH, "hair guide shapes",
                          smooth->vertices * sizeof *groom->guide_shapes, groom->guide_shapes,
                          &smooth->guide_shape);
}

hair_result hair_smooth_create(struct hair_smooth* smooth, struct hair_gl* gl, const struct hair_groom* groom,
                               const struct hair_sim* sim)
{
    static const char names[2][16] = {"hair position", "hair frame"};
    static const size_t sizes[2] = {sizeof(hair_vec4), 2 * sizeof(uint32_t)};
    static const GLenum formats[2] = {GL_RGBA32F, GL_RG32UI};
    smooth->gl = gl;
    smooth->vertices = sim->guides * sim->smooth_vertices;
    HAIR_ASSERT(smooth->vertices > 0 && sim->smooth_vertices <= HAIR_MAX_SMOOTH_VERTICES);
    HAIR_TRY(hair_gl_ensure_program(gl, hair_sim_smooth_pass(sim, false, false)));
    for (int i = 0; i < 2; ++i) {
        size_t size = smooth->vertices * sizes[i];
        if (i == 0 && groom->guide_shapes) size *= 2; // Displacements follow the positions.
        // hair_smooth_run() writes all vertices before anything reads them.
        HAIR_TRY(hair_gl_undefined_storage(gl, HAIR_GL_CATEGORY_SMOOTH, names[i], size, &smooth->buffer[i]));
        HAIR_TRY(hair_gl_buffer_texture(gl, names[i], formats[i], smooth->buffer[i], &smooth->texture[i]));
    }
    return create_displacements(smooth, groom);
}

void hair_smooth_destroy(struct hair_smooth* smooth)
{
    if (!smooth->gl) return;
    for (int i = 0; i < 2; ++i) hair_gl_free_array(smooth->gl, &smooth->buffer[i], &smooth->texture[i]);
    hair_smooth_free_tangents(smooth);
    hair_gl_free_buffer(smooth->gl, &smooth->guide_shape);
}

void hair_smooth_run(struct hair_smooth* smooth, struct hair_sim* sim)
{
    HAIR_ASSERT(smooth->vertices == sim->guides * sim->smooth_vertices);
    HAIR_ASSERT(smooth->buffer[0] && smooth->buffer[1]);
    hair_sim_bind(sim);
    hair_gl_bind_buffers(smooth->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_POSITION, 2, smooth->buffer);
    if (hair_targets_are_on(sim)) hair_targets_bind(sim);
    hair_gl_pass pass = hair_sim_smooth_pass(sim, hair_scalp_motion_is_on(sim), hair_targets_are_on(sim));
    hair_gl_run(smooth->gl, pass, sim->guides);
    if (smooth->guide_shape) {
        hair_gl_bind_buffers(smooth->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GUIDE_SHAPE, 1,
                             &smooth->guide_shape);
        hair_gl_run(smooth->gl, HAIR_GL_DISPLACE, sim->guides);
    }
    ++smooth->runs;
    smooth->done = 1;
}

void hair_smooth_ensure(struct hair_smooth* smooth, struct hair_sim* sim)
{
    if (!smooth->done) hair_smooth_run(smooth, sim);
}

hair_result hair_smooth_ensure_tangents(struct hair_smooth* smooth, const struct hair_sim* sim)
{
    struct hair_gl* gl = smooth->gl;
    HAIR_ASSERT(smooth->done);
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_GUIDE_TANGENTS));
    if (smooth->tangent && smooth->tangent_run == smooth->runs) return HAIR_OK;
    HAIR_TRY(hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_SMOOTH, "hair tangent",
                                  smooth->vertices * sizeof(hair_vec4), &smooth->tangent, 0, NULL));
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_STEP, 1, &sim->step);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_FRAME, 1, &smooth->buffer[1]);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_TANGENT, 1, &smooth->tangent);
    hair_gl_run(gl, HAIR_GL_GUIDE_TANGENTS, (smooth->vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_TANGENT, 1, NULL);
    smooth->tangent_run = smooth->runs;
    return HAIR_OK;
}

void hair_smooth_free_tangents(struct hair_smooth* smooth)
{
    hair_gl_free_buffer(smooth->gl, &smooth->tangent);
}

void hair_smooth_invalidate(struct hair_smooth* smooth)
{
    smooth->done = 0;
}
