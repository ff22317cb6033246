// vertex_cache.c - vertex cache of followers. Compute shaders write it once for any number of
// views, or for reading back.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <math.h>

static hair_result make(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    struct hair_vertex_cache* vertex_cache = &draw->vertex_cache;
    size_t vertices = hair_draw_count_vertices(draw);
    if (vertex_cache->vertices == vertices) return HAIR_OK;
    hair_draw_free_vertex_cache(draw);
    hair_result result =
        hair_gl_storage(gl, "hair vertex cache", vertices * sizeof(hair_vec4), NULL, &vertex_cache->position);
    if (!result)
        result =
            hair_gl_storage(gl, "hair vertex cache tangents", vertices * 8, NULL, &vertex_cache->tangent);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair vertex cache", GL_RGBA32F, vertex_cache->position,
                                        &vertex_cache->position_texture);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair vertex cache tangents", GL_RGBA16, vertex_cache->tangent,
                                        &vertex_cache->tangent_texture);
    if (result)
        hair_draw_free_vertex_cache(draw);
    else
        vertex_cache->vertices = vertices;
    return result;
}

void hair_draw_free_vertex_cache(struct hair_draw* draw)
{
    struct hair_vertex_cache* vertex_cache = &draw->vertex_cache;
    hair_gl_free_buffer_texture(draw->gl, &vertex_cache->position_texture);
    hair_gl_free_buffer_texture(draw->gl, &vertex_cache->tangent_texture);
    hair_gl_free_buffer(draw->gl, &vertex_cache->position);
    hair_gl_free_buffer(draw->gl, &vertex_cache->tangent);
    vertex_cache->vertices = 0;
    vertex_cache->is_complete = 0;
    hair_draw_free_shaded(draw);
    hair_draw_free_motion(draw);
}

// Return whether the cache is up to date. Whatever moves or changes followers also invalidates
// follower collision.
static bool is_fresh(const struct hair_draw* draw, const struct hair_smooth* smooth)
{
    const struct hair_vertex_cache* vertex_cache = &draw->vertex_cache;
    return vertex_cache->is_complete && hair_draw_has_follower_collision(draw, smooth) &&
           vertex_cache->generation == draw->follower_collision.generation &&
           vertex_cache->program_generation == draw->gl->program_generation;
}

bool hair_draw_has_vertex_cache(const struct hair_draw* draw, const struct hair_smooth* smooth)
{
    return draw->vertex_cache.vertices == hair_draw_count_vertices(draw) && is_fresh(draw, smooth);
}

hair_result hair_draw_ensure_vertex_cache(struct hair_draw* draw, const struct hair_smooth* smooth,
                                          const struct hair_draw_params* drawn)
{
    draw->used[HAIR_DRAW_VERTEX_CACHE] = draw->frame;
    struct hair_gl* gl = draw->gl;
    struct hair_vertex_cache* vertex_cache = &draw->vertex_cache;
    hair_gl_pass pass = HAIR_GL_EXPAND;
    hair_result result = make(draw);
    if (!result) result = hair_draw_ensure(draw, &pass);
    if (result || is_fresh(draw, smooth)) return result;
    struct hair_draw_params params;
    hair_draw_write_params(draw, NULL, NULL, &params);
    if (!drawn) drawn = &params;
    hair_gl_write_uniform(gl, draw->params, sizeof params, drawn);
    hair_draw_bind(draw, smooth);
    hair_draw_save_history(draw);
    HAIR_ASSERT(vertex_cache->vertices == hair_draw_count_vertices(draw) && drawn->chunks > 0);
    GLuint buffers[] = {vertex_cache->position, vertex_cache->tangent};
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_POSITION, 3, smooth->buffer);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_FOLLOWER, 1, &draw->follower);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 2, buffers);
    hair_gl_run(gl, pass, draw->patches * drawn->chunks);
    // Unbind the buffers before they can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 2, NULL);
    ++vertex_cache->writes;
    vertex_cache->is_complete = !drawn->drawn_only;
    vertex_cache->generation = draw->follower_collision.generation;
    vertex_cache->program_generation = gl->program_generation;
    return HAIR_OK;
}

hair_result hair_draw_read_vertex_cache(struct hair_draw* draw, const struct hair_smooth* smooth,
                                        hair_vec4** out)
{
    struct hair_gl* gl = draw->gl;
    int kept = draw->vertex_cache.vertices > 0;
    size_t count = hair_draw_count_vertices(draw);
    hair_vec4* vertices = hair_alloc(&gl->host, count, sizeof *vertices);
    if (!vertices) return hair_fail_memory(&gl->host, "the followers to read");
    hair_result result = hair_draw_ensure_vertex_cache(draw, smooth, NULL);
    if (!result)
        gl->GetNamedBufferSubData(draw->vertex_cache.position, 0, (GLsizeiptr)(count * sizeof *vertices),
                                  vertices);
    if (!kept) hair_draw_free_vertex_cache(draw); // Keep the memory only if drawing uses it.
    if (result) {
        hair_free(&gl->host, vertices);
        return result;
    }
    *out = vertices;
    return HAIR_OK;
}
