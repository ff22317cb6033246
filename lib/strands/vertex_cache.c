// vertex_cache.c - vertex cache of followers. Compute shaders write it once for any number of
// views, or for reading back.
#include "lib/strands/geometry.h"

#include <math.h>

#define SPARE 2 // A cache is made anew once many views in sequence need less than this part of it.
#define GROWTH 8 // A cache has room for this part more strands than a view needs.

// Return the number of strands that a cache has room for.
static uint64_t count_strands(const struct hair_geometry* geometry, uint32_t fraction)
{
    if (!fraction) return geometry->followers;
    return ((uint64_t)geometry->followers * fraction >> 32) + HAIR_CACHE_MORE * (uint64_t)geometry->patches;
}

size_t hair_geometry_count_cached(const struct hair_geometry* geometry, uint32_t fraction)
{
    return (size_t)count_strands(geometry, fraction) * (geometry->look.strand.segments + 1);
}

// Return a fraction as cache_fraction of hair_draw_params has it, rounded up.
static uint32_t write_fraction(double fraction)
{
    double scaled = ceil(fraction * 4294967296.0);
    return scaled < 1 ? 1 : scaled < UINT32_MAX ? (uint32_t)scaled : UINT32_MAX;
}

uint32_t hair_geometry_choose_cached_fraction(struct hair_geometry* geometry, double fraction)
{
    struct hair_vertex_cache* own = &geometry->vertex_cache;
    HAIR_ASSERT(fraction >= 0);
    uint32_t min = write_fraction(fraction), room = write_fraction(fraction * (1 + 1.0 / GROWTH));
    bool needs_all = SPARE * count_strands(geometry, room) > geometry->followers;
    bool has_all = !own->fraction, is_spare = !needs_all && (has_all || own->fraction / SPARE > room);
    bool is_made = own->vertices && own->vertices == hair_geometry_count_cached(geometry, own->fraction);
    if (hair_gl_count_spare(&own->spare_strands, is_made && is_spare)) is_made = false;
    if (is_made && (has_all || own->fraction >= min)) return own->fraction;
    return needs_all ? 0 : room;
}

// Make the buffers of the cache, for a fraction of the strands. Light needs no tangents.
static hair_result ensure_cache_buffers(struct hair_geometry* geometry, uint32_t fraction, bool is_for_light)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_vertex_cache* own = &geometry->vertex_cache;
    size_t vertices = hair_geometry_count_cached(geometry, fraction);
    if (!is_for_light) own->spare_strands = 0;
    if (own->vertices != vertices || own->fraction != fraction) hair_geometry_free_vertex_cache(geometry);
    if (hair_gl_count_spare(&own->spare, is_for_light && own->tangent && !own->is_complete))
        hair_gl_free_array(gl, &own->tangent, &own->tangent_texture);
    hair_result result =
        hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_EXPAND, "hair vertex cache", vertices * sizeof(hair_vec4),
                             &own->position, GL_RGBA32F, &own->position_texture);
    if (!result && !is_for_light)
        result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_EXPAND, "hair vertex cache tangents", vertices * 8,
                                      &own->tangent, GL_RGBA16, &own->tangent_texture);
    if (result)
        hair_geometry_free_vertex_cache(geometry);
    else
        own->vertices = vertices, own->fraction = fraction;
    return result;
}

hair_result hair_geometry_ensure_shaded(struct hair_geometry* geometry)
{
    struct hair_vertex_cache* own = &geometry->vertex_cache;
    HAIR_ASSERT(own->vertices > 0 && !own->fraction);
    hair_result result =
        hair_gl_ensure_array(geometry->gl, HAIR_GL_CATEGORY_EXPAND, "hair shaded", own->vertices * 8,
                             &own->shaded, GL_RGBA16F, &own->shaded_texture);
    if (result) hair_geometry_free_shaded(geometry);
    return result;
}

void hair_geometry_free_shaded(struct hair_geometry* geometry)
{
    hair_gl_free_array(geometry->gl, &geometry->vertex_cache.shaded, &geometry->vertex_cache.shaded_texture);
}

void hair_geometry_free_vertex_cache(struct hair_geometry* geometry)
{
    struct hair_vertex_cache* own = &geometry->vertex_cache;
    hair_gl_free_array(geometry->gl, &own->position, &own->position_texture);
    hair_gl_free_array(geometry->gl, &own->tangent, &own->tangent_texture);
    own->vertices = own->fraction = 0;
    own->is_complete = 0;
    hair_geometry_free_shaded(geometry);
    hair_geometry_free_history(geometry, &geometry->history);
    hair_geometry_free_history(geometry, &geometry->host_history);
}

// Return whether the cache is up to date. Whatever moves or changes followers also invalidates
// follower collision.
static bool is_fresh(const struct hair_geometry* geometry)
{
    const struct hair_vertex_cache* vertex_cache = &geometry->vertex_cache;
    return vertex_cache->is_complete && hair_geometry_has_follower_collision(geometry) &&
           vertex_cache->generation == geometry->follower_collision.generation &&
           vertex_cache->program_generation == geometry->gl->program_generation;
}

bool hair_geometry_has_vertex_cache(const struct hair_geometry* geometry)
{
    return geometry->vertex_cache.vertices == hair_geometry_count_vertices(geometry) && is_fresh(geometry);
}

hair_result hair_geometry_ensure_vertex_cache(struct hair_geometry* geometry,
                                              const struct hair_draw_params* drawn)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_vertex_cache* vertex_cache = &geometry->vertex_cache;
    hair_gl_pass pass = hair_geometry_choose_variant(geometry, drawn ? HAIR_GL_EXPAND_DRAWN : HAIR_GL_EXPAND);
    hair_result result = ensure_cache_buffers(geometry, drawn ? drawn->cache_fraction : 0, drawn != NULL);
    if (!result) result = hair_gl_ensure_program(gl, pass);
    if (result || is_fresh(geometry)) return result;
    struct hair_draw_params params;
    if (drawn)
        params = *drawn;
    else
        hair_geometry_write_params(geometry, &params);
    hair_gl_write_uniform(gl, geometry->params, sizeof params, &params);
    hair_geometry_bind(geometry);
    hair_geometry_save_history(geometry);
    HAIR_ASSERT(vertex_cache->fraction == params.cache_fraction && params.chunks > 0);
    const GLuint buffers[] = {vertex_cache->position, drawn ? 0 : vertex_cache->tangent};
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 2, buffers);
    hair_gl_run(gl, pass, geometry->patches * params.chunks);
    // Unbind the buffers before they can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 2, NULL);
    ++vertex_cache->writes;
    HAIR_ASSERT(vertex_cache->writes > 0); // 0 means that no frame was shown.
    vertex_cache->is_complete = !drawn;
    vertex_cache->generation = geometry->follower_collision.generation;
    vertex_cache->program_generation = gl->program_generation;
    return HAIR_OK;
}

hair_result hair_geometry_read_vertex_cache(struct hair_geometry* geometry, hair_vec4** out)
{
    struct hair_gl* gl = geometry->gl;
    int kept = geometry->vertex_cache.vertices > 0;
    size_t count = hair_geometry_count_vertices(geometry);
    hair_vec4* vertices = hair_alloc(&gl->host, count, sizeof *vertices);
    if (!vertices) return hair_fail_memory(&gl->host, "the followers to read");
    hair_result result = hair_geometry_ensure_vertex_cache(geometry, NULL);
    if (!result) hair_gl_read(gl, geometry->vertex_cache.position, count * sizeof *vertices, vertices);
    // Keep the memory only if drawing uses it.
    if (!kept) hair_geometry_free_vertex_cache(geometry);
    if (result) {
        hair_free(&gl->host, vertices);
        return result;
    }
    *out = vertices;
    return HAIR_OK;
}

void hair_geometry_bind_vertex_cache(struct hair_geometry* geometry)
{
    HAIR_ASSERT(geometry->vertex_cache.position_texture && geometry->vertex_cache.tangent_texture);
    hair_gl_bind_texture(geometry->gl, HAIR_UNIT_CACHED_POSITION, geometry->vertex_cache.position_texture);
    hair_gl_bind_texture(geometry->gl, HAIR_UNIT_CACHED_TANGENT, geometry->vertex_cache.tangent_texture);
}
