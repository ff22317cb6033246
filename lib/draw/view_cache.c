// view_cache.c - vertices of one view, written or shaded before its pixels are drawn.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#define SHRINKS 3 // Buffers are made anew once many views in turn need less than a third of them.

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
static size_t size_of_part(const struct hair_draw_plan* plan, int part, size_t vertices)
{
    if (part == HAIR_VIEW_CACHE_TANGENT && plan->has_sides) return 0;
    if (part == HAIR_VIEW_CACHE_SHADED && plan->view->pass == HAIR_PASS_DEPTH) return 0;
    return vertices * parts[part].size * (part == HAIR_VIEW_CACHE_POSITION && plan->is_paired ? 2 : 1);
}

static void free_part(struct hair_renderer* renderer, int part)
{
    struct hair_view_cache* own = &renderer->view_cache;
    hair_gl_free_array(renderer->gl, &own->buffer[part], &own->texture[part]);
    own->size[part] = 0;
}

static void free_own_buffers(struct hair_renderer* renderer)
{
    struct hair_view_cache* own = &renderer->view_cache;
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS; ++i) free_part(renderer, i);
    own->room = own->spare = own->segments = 0;
    own->is_complete &= own->is_in_place;
}

static hair_result ensure_part(struct hair_renderer* renderer, int part, size_t size)
{
    struct hair_view_cache* own = &renderer->view_cache;
    HAIR_ASSERT(0 <= part && part < HAIR_VIEW_CACHE_PARTS);
    if (own->size[part] >= size) return HAIR_OK;
    free_part(renderer, part);
    own->size[part] = size;
    return hair_gl_ensure_array(renderer->gl, HAIR_GL_CATEGORY_EXPAND, parts[part].label, size,
                                &own->buffer[part], parts[part].format, &own->texture[part]);
}

// Return the capacity in strands: that of all strands, halved as often as it holds what the view
// may draw.
static uint32_t find_room(const struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    uint32_t room = renderer->geometry->followers;
    uint32_t max = hair_draw_max_strands(renderer, plan->head, plan->view);
    while (room > 1 && (room + 1) / 2 >= max) room = (room + 1) / 2;
    return room;
}

hair_result hair_draw_ensure_view_cache(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    if (plan->is_of_batch) return HAIR_OK; // It has a place, see hair_batch_join().
    struct hair_view_cache* own = &renderer->view_cache;
    uint32_t room = find_room(renderer, plan), segments = renderer->geometry->look.strand.segments;
    hair_result result = HAIR_OK;
    bool is_spare = hair_gl_count_spare(&own->spare, own->room / SHRINKS > room);
    if (own->segments != segments || own->room < room || is_spare) {
        free_own_buffers(renderer);
        own->room = room;
        own->segments = segments;
    }
    size_t vertices = (size_t)own->room * (segments + 1);
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS && !result; ++i)
        result = ensure_part(renderer, i, size_of_part(plan, i, vertices));
    if (result) free_own_buffers(renderer);
    return result;
}

void hair_draw_free_view_cache(struct hair_renderer* renderer)
{
    free_own_buffers(renderer);
    hair_batch_leave_place(renderer->batch, &renderer->view_cache.place);
    renderer->view_cache.is_complete = false;
}

// Bind the vertices of the listed strands in place of the vertex cache.
static void bind_listed_vertices(struct hair_renderer* renderer)
{
    static const hair_uint unit[HAIR_VIEW_CACHE_PARTS] = {HAIR_UNIT_CACHED_POSITION, HAIR_UNIT_CACHED_TANGENT,
                                                          HAIR_UNIT_SHADED};
    const struct hair_view_cache* view_cache = &renderer->view_cache;
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS; ++i)
        if (view_cache->texture[i]) hair_gl_bind_texture(renderer->gl, unit[i], view_cache->texture[i]);
}

// Write and shade the vertices of the listed strands.
static void write_listed_vertices(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_view_cache* view_cache = &renderer->view_cache;
    HAIR_ASSERT(plan->is_of_batch ? view_cache->place.blocks : view_cache->buffer[HAIR_VIEW_CACHE_POSITION]);
    const GLuint list[] = {renderer->strand_list.strand, renderer->strand_list.command};
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_LISTED_STRAND, 2, list);
    if (plan->is_of_batch)
        hair_batch_bind_place(renderer->batch, view_cache->place);
    else
        hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, HAIR_VIEW_CACHE_PARTS,
                             view_cache->buffer);
    hair_gl_run_indirect(gl, plan->shade, plan->shade_program, renderer->strand_list.command,
                         HAIR_EXPAND_VIEW_COMMAND * sizeof(struct hair_draw_command));
    // Unbind the buffers before they can be deleted. Mesa unbinds a deleted buffer with
    // glBindBufferBase, which also clears the application's generic binding.
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, HAIR_VIEW_CACHE_PARTS,
                         NULL);
    view_cache->is_complete = plan->is_computed && plan->view->pass == HAIR_PASS_COLOR && !plan->shader &&
                              renderer->pixels_per_metre > 0;
    view_cache->is_in_place = plan->is_of_batch;
    view_cache->pixels_per_metre = renderer->pixels_per_metre;
}

// Shade the vertices of the vertex cache.
static void shade_cached_vertices(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                                  uint32_t chunks)
{
    struct hair_gl* gl = renderer->gl;
    const struct hair_vertex_cache* cache = &renderer->geometry->vertex_cache;
    const GLuint buffers[] = {cache->position, cache->tangent, cache->shaded};
    HAIR_ASSERT(cache->shaded && chunks > 0);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 3, buffers);
    hair_gl_run_with(gl, plan->shade, plan->shade_program, renderer->geometry->patches * chunks);
    // Unbind the buffers before they can be deleted, as above.
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 3, NULL);
    hair_gl_bind_texture(gl, HAIR_UNIT_SHADED, cache->shaded_texture);
}

void hair_draw_write_vertices(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                              const struct hair_draw_params* params)
{
    if (plan->vertices != HAIR_VERTICES_PER_VIEW) {
        shade_cached_vertices(renderer, plan, params->chunks);
        return;
    }
    if (!plan->keeps_vertices) write_listed_vertices(renderer, plan);
    if (!plan->is_of_batch) bind_listed_vertices(renderer);
}
