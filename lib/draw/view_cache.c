// view_cache.c - vertices of listed strands, written and shaded for one view before its pixels are
// drawn.
#include "lib/draw/draw.h"

static const struct {
    const char* label;
    GLenum format;
    size_t size;
} parts[HAIR_VIEW_CACHE_PARTS] = {
    [HAIR_VIEW_CACHE_POSITION] = {"hair view cache", GL_RGBA32F, sizeof(hair_vec4)},
    [HAIR_VIEW_CACHE_TANGENT] = {"hair view cache tangents", GL_RGBA16, 8},
    [HAIR_VIEW_CACHE_SHADED] = {"hair view cache colours", GL_RGBA16F, 8}};

// Return the size of a part in bytes. Drawn ribbons have two sides and no tangent. Compute
// rasterisation uses tangents. Buffers keep the larger size.
static size_t size_of(const struct hair_draw_plan* plan, int part, size_t vertices)
{
    if (part == HAIR_VIEW_CACHE_TANGENT && plan->has_sides) return 0;
    if (part == HAIR_VIEW_CACHE_SHADED && plan->view->pass == HAIR_PASS_DEPTH) return 0;
    return vertices * parts[part].size * (part == HAIR_VIEW_CACHE_POSITION && plan->is_paired ? 2 : 1);
}

static void free_part(struct hair_renderer* renderer, int part)
{
    hair_gl_free_buffer_texture(renderer->gl, &renderer->view_cache.texture[part]);
    hair_gl_free_buffer(renderer->gl, &renderer->view_cache.buffer[part]);
    renderer->view_cache.size[part] = 0;
}

static hair_result ensure_part(struct hair_renderer* renderer, int part, size_t size)
{
    struct hair_view_cache* view_cache = &renderer->view_cache;
    if (view_cache->size[part] >= size) return HAIR_OK;
    HAIR_ASSERT(0 <= part && part < HAIR_VIEW_CACHE_PARTS);
    free_part(renderer, part);
    hair_result result =
        hair_gl_storage(renderer->gl, parts[part].label, size, NULL, &view_cache->buffer[part]);
    if (!result)
        result = hair_gl_buffer_texture(renderer->gl, parts[part].label, parts[part].format,
                                        view_cache->buffer[part], &view_cache->texture[part]);
    view_cache->size[part] = size;
    return result;
}

hair_result hair_draw_ensure_view_cache(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    struct hair_view_cache* view_cache = &renderer->view_cache;
    size_t vertices = hair_geometry_count_vertices(renderer->geometry);
    hair_result result = HAIR_OK;
    if (view_cache->vertices != vertices) hair_draw_free_view_cache(renderer);
    view_cache->vertices = vertices;
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS && !result; ++i)
        result = ensure_part(renderer, i, size_of(plan, i, vertices));
    if (result) hair_draw_free_view_cache(renderer);
    return result;
}

void hair_draw_free_view_cache(struct hair_renderer* renderer)
{
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS; ++i) free_part(renderer, i);
    renderer->view_cache.vertices = 0;
}

void hair_draw_expand_view(struct hair_renderer* renderer, hair_gl_pass pass, GLuint program)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_view_cache* view_cache = &renderer->view_cache;
    HAIR_ASSERT(view_cache->buffer[HAIR_VIEW_CACHE_POSITION]);
    gl->BindTextureUnit(HAIR_UNIT_STRAND, renderer->strand_list.strand_texture);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_LIST_COMMAND, 1, &renderer->strand_list.command);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, HAIR_VIEW_CACHE_PARTS,
                        view_cache->buffer);
    hair_gl_run_indirect(gl, pass, program, renderer->strand_list.command,
                         HAIR_EXPAND_VIEW_COMMAND * sizeof(struct hair_draw_command));
    // Unbind the buffers before they can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, HAIR_VIEW_CACHE_PARTS, NULL);
    gl->BindTextureUnit(HAIR_UNIT_CACHED_POSITION, view_cache->texture[HAIR_VIEW_CACHE_POSITION]);
    if (view_cache->texture[HAIR_VIEW_CACHE_TANGENT])
        gl->BindTextureUnit(HAIR_UNIT_CACHED_TANGENT, view_cache->texture[HAIR_VIEW_CACHE_TANGENT]);
    if (view_cache->texture[HAIR_VIEW_CACHE_SHADED])
        gl->BindTextureUnit(HAIR_UNIT_SHADED, view_cache->texture[HAIR_VIEW_CACHE_SHADED]);
}
