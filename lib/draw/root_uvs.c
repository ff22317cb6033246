// root_uvs.c - scalp uvs of roots, for textures and shaders.
#include "lib/draw/draw.h"

bool hair_draw_has_uvs(const struct hair_draw* draw)
{
    return draw->root_bindings && draw->root_bindings->uv;
}

hair_result hair_draw_ensure_uvs(struct hair_draw* draw)
{
    HAIR_ASSERT(hair_draw_has_uvs(draw));
    draw->used[HAIR_DRAW_UVS] = draw->frame;
    struct hair_gl* gl = draw->gl;
    hair_result result = HAIR_OK;
    if (!draw->uv)
        result = hair_gl_buffer(gl, "hair root uvs", draw->followers * 2 * sizeof(float),
                                draw->root_bindings->uv, &draw->uv);
    if (!result && !draw->uv_texture)
        result = hair_gl_buffer_texture(gl, "hair root uvs", GL_RG32F, draw->uv, &draw->uv_texture);
    return result;
}

void hair_draw_free_uvs(struct hair_draw* draw)
{
    hair_gl_free_buffer_texture(draw->gl, &draw->uv_texture);
    hair_gl_free_buffer(draw->gl, &draw->uv);
}
