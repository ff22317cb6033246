// vertex_colors.c - shading of the cached vertices by compute, for one view before it draws them.
#include "lib/draw/draw.h"

hair_result hair_draw_ensure_shaded(struct hair_draw* draw)
{
    draw->used[HAIR_DRAW_SHADED] = draw->frame;
    struct hair_gl* gl = draw->gl;
    struct hair_vertex_cache* vertex_cache = &draw->vertex_cache;
    HAIR_ASSERT(vertex_cache->vertices > 0);
    if (vertex_cache->shaded_texture) return HAIR_OK;
    hair_result result =
        hair_gl_storage(gl, "hair shaded", vertex_cache->vertices * 8, NULL, &vertex_cache->shaded);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair shaded", GL_RGBA16F, vertex_cache->shaded,
                                        &vertex_cache->shaded_texture);
    if (result) hair_draw_free_shaded(draw);
    return result;
}

void hair_draw_free_shaded(struct hair_draw* draw)
{
    hair_gl_free_buffer_texture(draw->gl, &draw->vertex_cache.shaded_texture);
    hair_gl_free_buffer(draw->gl, &draw->vertex_cache.shaded);
}

void hair_draw_shade(struct hair_draw* draw, hair_gl_pass pass, GLuint program, uint32_t chunks)
{
    struct hair_gl* gl = draw->gl;
    HAIR_ASSERT(draw->vertex_cache.shaded && chunks > 0);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SHADED, 1, &draw->vertex_cache.shaded);
    hair_gl_run_with(gl, pass, program, draw->patches * chunks);
    // Unbind the buffer before it can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SHADED, 1, NULL);
    gl->BindTextureUnit(HAIR_UNIT_SHADED, draw->vertex_cache.shaded_texture);
}
