// shaded.c - shading of the cached vertices by compute, for one view before it draws them.
#include "lib/draw/draw.h"

hair_result hair_draw_need_shaded(struct hair_draw* draw)
{
    draw->used[HAIR_DRAW_SHADED] = draw->frame;
    struct hair_gl* gl = draw->gl;
    struct hair_expanded* expanded = &draw->expanded;
    HAIR_ASSERT(expanded->vertices > 0);
    if (expanded->shaded_texture) return HAIR_OK;
    hair_result result = hair_gl_storage(gl, "hair shaded", expanded->vertices * 8, NULL, &expanded->shaded);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair shaded", GL_RGBA16F, expanded->shaded,
                                        &expanded->shaded_texture);
    if (result) hair_draw_free_shaded(draw);
    return result;
}

void hair_draw_free_shaded(struct hair_draw* draw)
{
    hair_gl_free_buffer_texture(draw->gl, &draw->expanded.shaded_texture);
    hair_gl_free_buffer(draw->gl, &draw->expanded.shaded);
}

void hair_draw_shade(struct hair_draw* draw, hair_gl_pass pass, GLuint program, uint32_t chunks)
{
    struct hair_gl* gl = draw->gl;
    HAIR_ASSERT(draw->expanded.shaded && chunks > 0);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SHADED, 1, &draw->expanded.shaded);
    hair_gl_run_with(gl, pass, program, draw->patches * chunks);
    // Unbind the buffer before it can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SHADED, 1, NULL);
    gl->BindTextureUnit(HAIR_UNIT_SHADED, draw->expanded.shaded_texture);
}
