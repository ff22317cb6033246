// sorted_segments.c - segments sorted by compute with a histogram of distances from the eye, and
// blended. OpenGL blends primitives in the order of the draw's indices.
#include "lib/draw/draw.h"

static hair_result make_index(struct hair_renderer* renderer, size_t segments)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_sorted_segments* sorted_segments = &renderer->sorted_segments;
    hair_gl_free_buffer(gl, &sorted_segments->index);
    sorted_segments->segments = 0;
    hair_result result = hair_gl_storage(gl, HAIR_GL_CATEGORY_COLOR, "hair sorted segments", 8 * segments,
                                         NULL, &sorted_segments->index);
    if (result) return result;
    if (!sorted_segments->vertex_array) gl->CreateVertexArrays(1, &sorted_segments->vertex_array);
    if (!sorted_segments->vertex_array)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "the driver makes no vertex array for sorted segments");
    gl->VertexArrayElementBuffer(sorted_segments->vertex_array, sorted_segments->index);
    sorted_segments->segments = segments;
    return HAIR_OK;
}

hair_result hair_draw_ensure_sorted_segments(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    (void)plan;
    struct hair_gl* gl = renderer->gl;
    struct hair_sorted_segments* sorted_segments = &renderer->sorted_segments;
    size_t segments = (size_t)renderer->geometry->followers * renderer->geometry->look.strand.segments;
    hair_result result =
        hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_COLOR, "hair buckets", HAIR_SORT_BUCKETS * sizeof(uint32_t),
                             &sorted_segments->bucket, 0, NULL);
    if (!result && sorted_segments->segments != segments) result = make_index(renderer, segments);
    return result;
}

void hair_draw_free_sorted_segments(struct hair_renderer* renderer)
{
    struct hair_sorted_segments* sorted_segments = &renderer->sorted_segments;
    if (sorted_segments->vertex_array) renderer->gl->DeleteVertexArrays(1, &sorted_segments->vertex_array);
    sorted_segments->vertex_array = 0;
    sorted_segments->segments = 0;
    hair_gl_free_buffer(renderer->gl, &sorted_segments->bucket);
    hair_gl_free_buffer(renderer->gl, &sorted_segments->index);
}

void hair_draw_sort(struct hair_renderer* renderer)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_sorted_segments* sorted_segments = &renderer->sorted_segments;
    HAIR_ASSERT(sorted_segments->segments ==
                (size_t)renderer->geometry->followers * renderer->geometry->look.strand.segments);
    GLuint sorts[] = {sorted_segments->bucket, sorted_segments->index};
    GLuint strands[] = {renderer->strand_list.strand, renderer->strand_list.command};
    uint32_t groups = (uint32_t)((sorted_segments->segments + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_clear_buffer(gl, sorted_segments->bucket);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_HISTOGRAM, 2, sorts);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STRAND, 2, strands);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_RIBBON_POSITION, 1,
                         &renderer->geometry->vertex_cache.position);
    hair_gl_run(gl, HAIR_GL_HISTOGRAM, groups);
    hair_gl_run(gl, HAIR_GL_PREFIX_SUM, 1);
    hair_gl_run(gl, HAIR_GL_SCATTER, groups);
    // Unbind the buffer before it can be deleted, as in hair_geometry_ensure_vertex_cache().
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_RIBBON_POSITION, 1, NULL);
}

void hair_draw_issue_sorted_segments(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(renderer->sorted_segments.vertex_array && renderer->strand_list.command);
    hair_gl_bind_texture(gl, HAIR_UNIT_STRAND, renderer->strand_list.strand_texture);
    gl->BindVertexArray(renderer->sorted_segments.vertex_array);
    hair_draw_issue_commands(renderer, plan, HAIR_LIST_SORTED, GL_LINES, GL_UNSIGNED_INT);
}
