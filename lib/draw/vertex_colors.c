// vertex_colors.c - shading of the cached vertices by compute, for one view before it draws them.
#include "lib/draw/draw.h"

void hair_draw_shade(struct hair_renderer* renderer, hair_gl_pass pass, GLuint program, uint32_t chunks)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(renderer->geometry->vertex_cache.shaded && chunks > 0);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SHADED, 1,
                        &renderer->geometry->vertex_cache.shaded);
    hair_gl_run_with(gl, pass, program, renderer->geometry->patches * chunks);
    // Unbind the buffer before it can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SHADED, 1, NULL);
    gl->BindTextureUnit(HAIR_UNIT_SHADED, renderer->geometry->vertex_cache.shaded_texture);
}
