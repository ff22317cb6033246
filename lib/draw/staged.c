// staged.c - vertices of listed strands written for one view, and shaded, before compute makes pixels of them.
#include "lib/draw/draw.h"

static const struct {
    const char* label;
    GLenum      format;
    size_t      size;
} parts[HAIR_STAGED_PARTS] = {[HAIR_STAGED_POSITION] = {"hair staged", GL_RGBA32F, sizeof(hair_vec4)},
                              [HAIR_STAGED_TANGENT]  = {"hair staged tangents", GL_RGBA16, 8},
                              [HAIR_STAGED_SHADED]   = {"hair staged colours", GL_RGBA16F, 8}};

hair_result hair_draw_need_staged(struct hair_draw* draw, hair_gl_pass depth)
{
    draw->used[HAIR_DRAW_STAGED] = draw->frame;
    struct hair_gl*     gl       = draw->gl;
    struct hair_staged* staged   = &draw->staged;
    int                 count    = depth ? HAIR_STAGED_SHADED : HAIR_STAGED_PARTS;
    size_t              vertices = hair_draw_count_vertices(draw);
    hair_result         result   = HAIR_OK;
    if (staged->vertices != vertices) hair_draw_free_staged(draw);
    for (int i = 0; i < count && !result; ++i) {
        if (staged->texture[i]) continue;
        result = hair_gl_storage(gl, parts[i].label, vertices * parts[i].size, NULL, &staged->buffer[i]);
        if (!result)
            result = hair_gl_buffer_texture(gl, parts[i].label, parts[i].format, staged->buffer[i],
                                            &staged->texture[i]);
    }
    staged->vertices = vertices;
    if (result) hair_draw_free_staged(draw);
    return result;
}

void hair_draw_free_staged(struct hair_draw* draw)
{
    struct hair_staged* staged = &draw->staged;
    for (int i = 0; i < HAIR_STAGED_PARTS; ++i) {
        hair_gl_free_buffer_texture(draw->gl, &staged->texture[i]);
        hair_gl_free_buffer(draw->gl, &staged->buffer[i]);
    }
    staged->vertices = 0;
}

void hair_draw_stage(struct hair_draw* draw, hair_gl_pass pass, GLuint program)
{
    struct hair_gl*     gl     = draw->gl;
    struct hair_staged* staged = &draw->staged;
    uint32_t            groups = (uint32_t)((staged->vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    gl->BindTextureUnit(HAIR_UNIT_STRAND, draw->listed.strand_texture);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_LISTED, 1, &draw->listed.command);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, HAIR_STAGED_PARTS, staged->buffer);
    hair_gl_run_with(gl, pass, program, groups);
    // Mesa unbinds a buffer that is deleted by glBindBufferBase, which takes the host's general binding with it.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, HAIR_STAGED_PARTS, NULL);
    gl->BindTextureUnit(HAIR_UNIT_EXPANDED, staged->texture[HAIR_STAGED_POSITION]);
    gl->BindTextureUnit(HAIR_UNIT_EXPANDED_TANGENT, staged->texture[HAIR_STAGED_TANGENT]);
    if (staged->texture[HAIR_STAGED_SHADED])
        gl->BindTextureUnit(HAIR_UNIT_SHADED, staged->texture[HAIR_STAGED_SHADED]);
}
