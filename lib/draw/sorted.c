// sorted.c - segments sorted by compute with a histogram of distances from the eye, and blended.
// OpenGL blends primitives in the order of the draw's indices.
#include "lib/draw/draw.h"

static hair_result make_index(struct hair_draw* draw, size_t segments)
{
    struct hair_gl* gl = draw->gl;
    struct hair_sorted* sorted = &draw->sorted;
    hair_gl_free_buffer(gl, &sorted->index);
    sorted->segments = 0;
    hair_result result = hair_gl_storage(gl, "hair sorted segments", 8 * segments, NULL, &sorted->index);
    if (result) return result;
    if (!sorted->vertex_array) gl->CreateVertexArrays(1, &sorted->vertex_array);
    if (!sorted->vertex_array)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "the driver makes no vertex array for sorted segments");
    gl->VertexArrayElementBuffer(sorted->vertex_array, sorted->index);
    sorted->segments = segments;
    return HAIR_OK;
}

hair_result hair_draw_need_sorted(struct hair_draw* draw)
{
    draw->used[HAIR_DRAW_SORTED] = draw->frame;
    struct hair_gl* gl = draw->gl;
    struct hair_sorted* sorted = &draw->sorted;
    size_t segments = (size_t)draw->followers * draw->look.segments;
    hair_result result = HAIR_OK;
    if (!sorted->bucket)
        result =
            hair_gl_storage(gl, "hair buckets", HAIR_SORT_BUCKETS * sizeof(uint32_t), NULL, &sorted->bucket);
    if (!result && sorted->segments != segments) result = make_index(draw, segments);
    if (!result) result = hair_gl_need_rows(gl, HAIR_GL_BUCKET, HAIR_GL_PLACE, 0);
    return result;
}

void hair_draw_free_sorted(struct hair_draw* draw)
{
    struct hair_sorted* sorted = &draw->sorted;
    if (sorted->vertex_array) draw->gl->DeleteVertexArrays(1, &sorted->vertex_array);
    sorted->vertex_array = 0;
    sorted->segments = 0;
    hair_gl_free_buffer(draw->gl, &sorted->bucket);
    hair_gl_free_buffer(draw->gl, &sorted->index);
}

void hair_draw_sort(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    struct hair_sorted* sorted = &draw->sorted;
    HAIR_ASSERT(sorted->segments == (size_t)draw->followers * draw->look.segments);
    GLuint sorts[] = {sorted->bucket, sorted->index};
    GLuint strands[] = {draw->listed.strand, draw->listed.command};
    uint32_t groups = (uint32_t)((sorted->segments + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    gl->ClearNamedBufferData(sorted->bucket, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_BUCKET, 2, sorts);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STRAND, 2, strands);
    hair_gl_run(gl, HAIR_GL_BUCKET, groups);
    hair_gl_run(gl, HAIR_GL_BUCKETS, 1);
    hair_gl_run(gl, HAIR_GL_PLACE, groups);
}

void hair_draw_sorted(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    const char* first = (const char*)NULL + HAIR_SORTED_COMMAND * sizeof(struct hair_draw_command);
    gl->BindTextureUnit(HAIR_UNIT_STRAND, draw->listed.strand_texture);
    gl->BindVertexArray(draw->sorted.vertex_array);
    gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, draw->listed.command);
    gl->Disable(GL_PRIMITIVE_RESTART);
    gl->MultiDrawElementsIndirect(GL_LINES, GL_UNSIGNED_INT, first, 1, 0);
}
