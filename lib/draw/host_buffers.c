// host_buffers.c - the strands as buffers for the application. Drawing has most of them already.
#include "lib/draw/draw.h"

#include <string.h>

static void mark_used(struct hair_renderer* renderer, enum hair_draw_resource resource)
{
    renderer->last_used[resource] = renderer->frame;
}

void hair_draw_free_reflectance(struct hair_renderer* renderer)
{
    hair_gl_free_buffer(renderer->gl, &renderer->host.color);
    renderer->host.color_vertices = 0;
    renderer->host.color_generation = 0;
}

// Return whether the reflectance is up to date. It does not depend on the motion of the hair.
static bool has_reflectance(const struct hair_renderer* renderer, size_t vertices)
{
    const struct hair_host_buffers* own = &renderer->host;
    return own->color_vertices == vertices && own->color_generation == renderer->gl->program_generation &&
           own->color_lengths == renderer->geometry->lengths->version &&
           memcmp(&own->color_look, &renderer->geometry->look, sizeof own->color_look) == 0;
}

// Write the reflectance of all vertices of followers, whose vertex cache must be up to date.
static hair_result ensure_reflectance(struct hair_renderer* renderer)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_geometry* geometry = renderer->geometry;
    struct hair_lighting* lighting = renderer->lighting;
    struct hair_host_buffers* own = &renderer->host;
    struct hair_draw_params params;
    size_t vertices = hair_geometry_count_vertices(geometry);
    bool is_painted = hair_lighting_has_strand_colors(lighting, &geometry->look);
    hair_gl_pass pass = HAIR_GL_REFLECTANCE | (is_painted ? HAIR_GL_WITH(GROOM_COLORS) : 0);
    if (hair_geometry_has_lengths(geometry)) pass |= HAIR_GL_WITH(LENGTHS);
    mark_used(renderer, HAIR_RESOURCE_REFLECTANCE);
    if (has_reflectance(renderer, vertices)) return HAIR_OK;
    HAIR_TRY(hair_gl_ensure_program(gl, pass));
    if (own->color_vertices != vertices) hair_draw_free_reflectance(renderer);
    HAIR_TRY(hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_EXPAND, "hair reflectance", vertices * 8, &own->color,
                                  GL_RGBA16F, NULL));
    own->color_vertices = vertices;
    hair_geometry_write_params(geometry, &params);
    hair_lighting_write_params(lighting, &geometry->look, NULL, NULL, &params);
    hair_gl_write_uniform(gl, geometry->params, sizeof params, &params);
    hair_geometry_bind(geometry);
    if (is_painted) hair_gl_bind_texture(gl, HAIR_UNIT_GROOM_COLOR, lighting->groom_color_texture);
    const GLuint buffers[] = {geometry->vertex_cache.position, geometry->vertex_cache.tangent, own->color};
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 3, buffers);
    hair_gl_run(gl, pass, geometry->patches * params.chunks);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 3, NULL);
    own->color_look = geometry->look;
    own->color_generation = gl->program_generation;
    own->color_lengths = geometry->lengths->version;
    return HAIR_OK;
}

void hair_draw_free_strand_index(struct hair_renderer* renderer)
{
    hair_gl_free_buffer(renderer->gl, &renderer->host.guide_index.buffer);
    hair_gl_free_buffer(renderer->gl, &renderer->host.follower_index.buffer);
}

static hair_result ensure_index(struct hair_renderer* renderer, struct hair_strand_index* index,
                                size_t vertices, uint32_t each)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(each > 0 && vertices % each == 0);
    mark_used(renderer, HAIR_RESOURCE_STRAND_INDEX);
    if (index->buffer && index->vertices == vertices && index->each == each) return HAIR_OK;
    hair_gl_free_buffer(gl, &index->buffer);
    uint32_t* numbers = hair_alloc(&gl->host, vertices, sizeof *numbers);
    if (!numbers) return hair_fail_memory(&gl->host, "the indices of strands");
    for (size_t i = 0; i < vertices; ++i) numbers[i] = (uint32_t)(i / each);
    hair_result result = hair_gl_buffer(gl, HAIR_GL_CATEGORY_EXPAND, "hair strand indices",
                                        vertices * sizeof *numbers, numbers, &index->buffer);
    hair_free(&gl->host, numbers);
    index->vertices = vertices;
    index->each = each;
    return result;
}

static hair_buffer buffer_of(GLuint buffer, uint32_t offset, uint32_t stride, GLenum format, uint32_t count)
{
    return (hair_buffer){
        .buffer = buffer, .offset = offset, .stride = stride, .format = format, .count = buffer ? count : 0};
}

// Write where the positions of the previous frame are, and their transform to the world.
static void write_previous(const struct hair_vertex_history* history, GLuint now, uint32_t count,
                           hair_buffers* out)
{
    const struct hair_history_pose* before = &history->before;
    hair_quat turn = before->turn;
    const float rotation[4] = {turn.x, turn.y, turn.z, turn.w};
    out->prev_position = buffer_of(history->still ? now : history->buffer, 0, 16, GL_RGB32F, count);
    memcpy(out->prev_origin, before->position, sizeof out->prev_origin);
    memcpy(out->prev_rotation, rotation, sizeof rotation);
}

void hair_draw_free_guide_tangents(struct hair_renderer* renderer)
{
    hair_smooth_free_tangents(&renderer->geometry->smooth);
}

hair_result hair_draw_get_guides(struct hair_renderer* renderer, const struct hair_sim* sim,
                                 const struct hair_pose* head, hair_buffers* out)
{
    struct hair_geometry* geometry = renderer->geometry;
    struct hair_strand_index* index = &renderer->host.guide_index;
    uint32_t count = geometry->smooth.vertices;
    out->strand_count = geometry->guides;
    out->strand_vertices = geometry->smooth_vertices;
    if (out->attributes & HAIR_ATTRIBUTE_STRAND) {
        HAIR_TRY(ensure_index(renderer, index, count, geometry->smooth_vertices));
        out->strand = buffer_of(index->buffer, 0, 4, GL_R32UI, count);
    }
    if (out->attributes & HAIR_ATTRIBUTE_PREV_POSITION) {
        mark_used(renderer, HAIR_RESOURCE_GUIDE_HISTORY);
        HAIR_TRY(hair_geometry_begin_guide_history(geometry, head, out->frame_index));
        write_previous(&geometry->guide_history, geometry->smooth.buffer[0], count, out);
    }
    if (out->attributes & HAIR_ATTRIBUTE_POSITION)
        out->position = buffer_of(geometry->smooth.buffer[0], 0, 16, GL_RGB32F, count);
    if (out->attributes & HAIR_ATTRIBUTE_TANGENT) {
        mark_used(renderer, HAIR_RESOURCE_GUIDE_TANGENTS);
        HAIR_TRY(hair_smooth_ensure_tangents(&geometry->smooth, sim));
        out->tangent = buffer_of(geometry->smooth.tangent, 0, 16, GL_RGB32F, count);
    }
    return HAIR_OK;
}

hair_result hair_draw_get_followers(struct hair_renderer* renderer, const struct hair_pose* head,
                                    hair_buffers* out)
{
    struct hair_geometry* geometry = renderer->geometry;
    const struct hair_vertex_cache* cache = &geometry->vertex_cache;
    struct hair_strand_index* index = &renderer->host.follower_index;
    uint32_t wanted = out->attributes, count = (uint32_t)hair_geometry_count_vertices(geometry);
    out->strand_count = geometry->followers;
    out->strand_vertices = geometry->look.strand.segments + 1;
    if (count == 0) return HAIR_OK;
    if (wanted & ~(uint32_t)(HAIR_ATTRIBUTE_ROOT_UV | HAIR_ATTRIBUTE_STRAND)) {
        mark_used(renderer, HAIR_RESOURCE_VERTEX_CACHE);
        HAIR_TRY(hair_geometry_ensure_vertex_cache(geometry, NULL));
    }
    if (wanted & HAIR_ATTRIBUTE_COLOR) {
        HAIR_TRY(ensure_reflectance(renderer));
        out->color = buffer_of(renderer->host.color, 0, 8, GL_RGBA16F, count);
    }
    if (wanted & HAIR_ATTRIBUTE_ROOT_UV && hair_geometry_has_uvs(geometry)) {
        mark_used(renderer, HAIR_RESOURCE_ROOT_UVS);
        HAIR_TRY(hair_geometry_ensure_uvs(geometry));
        out->root_uv = buffer_of(geometry->uv, 0, 8, GL_RG32F, geometry->followers);
        out->root_uv.is_per_strand = true;
    }
    if (wanted & HAIR_ATTRIBUTE_STRAND) {
        HAIR_TRY(ensure_index(renderer, index, count, out->strand_vertices));
        out->strand = buffer_of(index->buffer, 0, 4, GL_R32UI, count);
    }
    if (wanted & HAIR_ATTRIBUTE_PREV_POSITION) {
        mark_used(renderer, HAIR_RESOURCE_HOST_HISTORY);
        HAIR_TRY(hair_geometry_ensure_history(geometry, &geometry->host_history));
        hair_geometry_begin_history(geometry, &geometry->host_history, head, out->frame_index);
        write_previous(&geometry->host_history, cache->position, count, out);
    }
    if (wanted & HAIR_ATTRIBUTE_POSITION) out->position = buffer_of(cache->position, 0, 16, GL_RGB32F, count);
    if (wanted & HAIR_ATTRIBUTE_RADIUS) out->radius = buffer_of(cache->position, 12, 16, GL_R32F, count);
    if (wanted & HAIR_ATTRIBUTE_TANGENT) out->tangent = buffer_of(cache->tangent, 0, 8, GL_RGB16, count);
    return HAIR_OK;
}
