// staged.c - vertices of listed strands, written and shaded for one view before its pixels are
// drawn.
#include "lib/draw/draw.h"

static const struct {
    const char* label;
    GLenum format;
    size_t size;
} parts[HAIR_STAGED_PARTS] = {[HAIR_STAGED_POSITION] = {"hair staged", GL_RGBA32F, sizeof(hair_vec4)},
                              [HAIR_STAGED_TANGENT] = {"hair staged tangents", GL_RGBA16, 8},
                              [HAIR_STAGED_SHADED] = {"hair staged colours", GL_RGBA16F, 8}};

// Return the size of a part in bytes. Drawn ribbons have two sides and no tangent. Compute
// rasterisation uses tangents. Buffers keep the larger size.
static size_t size_of(const hair_view* view, int part, size_t vertices)
{
    if (part == HAIR_STAGED_TANGENT && hair_draw_stages_sides(view)) return 0;
    if (part == HAIR_STAGED_SHADED && view->pass == HAIR_PASS_DEPTH) return 0;
    return vertices * parts[part].size * (part == HAIR_STAGED_POSITION && hair_draw_is_paired(view) ? 2 : 1);
}

static void free_part(struct hair_draw* draw, int part)
{
    hair_gl_free_buffer_texture(draw->gl, &draw->staged.texture[part]);
    hair_gl_free_buffer(draw->gl, &draw->staged.buffer[part]);
    draw->staged.size[part] = 0;
}

static hair_result need_part(struct hair_draw* draw, int part, size_t size)
{
    struct hair_staged* staged = &draw->staged;
    if (staged->size[part] >= size) return HAIR_OK;
    HAIR_ASSERT(0 <= part && part < HAIR_STAGED_PARTS);
    free_part(draw, part);
    hair_result result = hair_gl_storage(draw->gl, parts[part].label, size, NULL, &staged->buffer[part]);
    if (!result)
        result = hair_gl_buffer_texture(draw->gl, parts[part].label, parts[part].format, staged->buffer[part],
                                        &staged->texture[part]);
    staged->size[part] = size;
    return result;
}

hair_result hair_draw_need_staged(struct hair_draw* draw, const hair_view* view)
{
    draw->used[HAIR_DRAW_STAGED] = draw->frame;
    struct hair_staged* staged = &draw->staged;
    size_t vertices = hair_draw_count_vertices(draw);
    hair_result result = HAIR_OK;
    if (staged->vertices != vertices) hair_draw_free_staged(draw);
    staged->vertices = vertices;
    for (int i = 0; i < HAIR_STAGED_PARTS && !result; ++i)
        result = need_part(draw, i, size_of(view, i, vertices));
    if (result) hair_draw_free_staged(draw);
    return result;
}

void hair_draw_free_staged(struct hair_draw* draw)
{
    for (int i = 0; i < HAIR_STAGED_PARTS; ++i) free_part(draw, i);
    draw->staged.vertices = 0;
}

void hair_draw_stage(struct hair_draw* draw, hair_gl_pass pass, GLuint program)
{
    struct hair_gl* gl = draw->gl;
    struct hair_staged* staged = &draw->staged;
    HAIR_ASSERT(staged->buffer[HAIR_STAGED_POSITION]);
    gl->BindTextureUnit(HAIR_UNIT_STRAND, draw->listed.strand_texture);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_LISTED, 1, &draw->listed.command);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, HAIR_STAGED_PARTS, staged->buffer);
    hair_gl_run_indirect(gl, pass, program, draw->listed.command,
                         HAIR_STAGE_COMMAND * sizeof(struct hair_draw_command));
    // Unbind the buffers before they can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, HAIR_STAGED_PARTS, NULL);
    gl->BindTextureUnit(HAIR_UNIT_EXPANDED, staged->texture[HAIR_STAGED_POSITION]);
    if (staged->texture[HAIR_STAGED_TANGENT])
        gl->BindTextureUnit(HAIR_UNIT_EXPANDED_TANGENT, staged->texture[HAIR_STAGED_TANGENT]);
    if (staged->texture[HAIR_STAGED_SHADED])
        gl->BindTextureUnit(HAIR_UNIT_SHADED, staged->texture[HAIR_STAGED_SHADED]);
}
