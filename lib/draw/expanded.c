// expanded.c - vertex cache of followers. Compute shaders write it once for any number of views, or
// for reading back.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <math.h>

static hair_result make(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    struct hair_expanded* expanded = &draw->expanded;
    size_t vertices = hair_draw_count_vertices(draw);
    if (expanded->vertices == vertices) return HAIR_OK;
    hair_draw_free_expanded(draw);
    hair_result result =
        hair_gl_storage(gl, "hair expanded", vertices * sizeof(hair_vec4), NULL, &expanded->position);
    if (!result)
        result = hair_gl_storage(gl, "hair expanded tangents", vertices * 8, NULL, &expanded->tangent);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair expanded", GL_RGBA32F, expanded->position,
                                        &expanded->position_texture);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair expanded tangents", GL_RGBA16, expanded->tangent,
                                        &expanded->tangent_texture);
    if (result)
        hair_draw_free_expanded(draw);
    else
        expanded->vertices = vertices;
    return result;
}

void hair_draw_free_expanded(struct hair_draw* draw)
{
    struct hair_expanded* expanded = &draw->expanded;
    hair_gl_free_buffer_texture(draw->gl, &expanded->position_texture);
    hair_gl_free_buffer_texture(draw->gl, &expanded->tangent_texture);
    hair_gl_free_buffer(draw->gl, &expanded->position);
    hair_gl_free_buffer(draw->gl, &expanded->tangent);
    expanded->vertices = 0;
    expanded->there = 0;
    hair_draw_free_shaded(draw);
    hair_draw_free_motion(draw);
}

// Return whether the cache is up to date. Whatever moves or changes followers also invalidates
// follower collision.
static bool is_fresh(const struct hair_draw* draw, const struct hair_smooth* smooth)
{
    const struct hair_expanded* expanded = &draw->expanded;
    return expanded->there && hair_draw_has_met_colliders(draw, smooth) && expanded->met == draw->hits.met &&
           expanded->made == draw->gl->made;
}

bool hair_draw_is_expanded(const struct hair_draw* draw, const struct hair_smooth* smooth)
{
    return draw->expanded.vertices == hair_draw_count_vertices(draw) && is_fresh(draw, smooth);
}

hair_result hair_draw_need_expanded(struct hair_draw* draw, const struct hair_smooth* smooth,
                                    const struct hair_draw_params* drawn)
{
    draw->used[HAIR_DRAW_EXPANDED] = draw->frame;
    struct hair_gl* gl = draw->gl;
    struct hair_expanded* expanded = &draw->expanded;
    hair_gl_pass pass = HAIR_GL_EXPAND;
    hair_result result = make(draw);
    if (!result) result = hair_draw_need(draw, &pass);
    if (result || is_fresh(draw, smooth)) return result;
    struct hair_draw_params params;
    hair_draw_write_params(draw, NULL, NULL, &params);
    if (!drawn) drawn = &params;
    hair_gl_write_uniform(gl, draw->params, sizeof params, drawn);
    hair_draw_bind(draw, smooth);
    hair_draw_keep_shown(draw);
    HAIR_ASSERT(expanded->vertices == hair_draw_count_vertices(draw) && drawn->chunks > 0);
    GLuint buffers[] = {expanded->position, expanded->tangent};
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_POSITION, 3, smooth->buffer);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_FOLLOWER, 1, &draw->follower);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, 2, buffers);
    hair_gl_run(gl, pass, draw->patches * drawn->chunks);
    // Unbind the buffers before they can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, 2, NULL);
    ++expanded->writes;
    expanded->there = !drawn->drawn_only;
    expanded->met = draw->hits.met;
    expanded->made = gl->made;
    return HAIR_OK;
}

hair_result hair_draw_read_expanded(struct hair_draw* draw, const struct hair_smooth* smooth, hair_vec4** out)
{
    struct hair_gl* gl = draw->gl;
    int kept = draw->expanded.vertices > 0;
    size_t count = hair_draw_count_vertices(draw);
    hair_vec4* vertices = hair_alloc(&gl->host, count, sizeof *vertices);
    if (!vertices) return hair_fail_memory(&gl->host, "the followers to read");
    hair_result result = hair_draw_need_expanded(draw, smooth, NULL);
    if (!result)
        gl->GetNamedBufferSubData(draw->expanded.position, 0, (GLsizeiptr)(count * sizeof *vertices),
                                  vertices);
    if (!kept) hair_draw_free_expanded(draw); // Keep the memory only if drawing uses it.
    if (result) {
        hair_free(&gl->host, vertices);
        return result;
    }
    *out = vertices;
    return HAIR_OK;
}
