// self_shadow.c - light that reaches each vertex of the strands. A density grid is computed once
// for all views of the same strands. The light is attenuated through the grid and by shadow maps.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <string.h>

#define NODE_GROUPS 1024 // Number of work groups. Their threads loop over all nodes of the grid.

void hair_draw_free_self_shadow(struct hair_draw* draw)
{
    struct hair_self_shadow_state* own = &draw->self_shadow;
    hair_gl_free_buffer_texture(draw->gl, &own->texture);
    hair_gl_free_buffer(draw->gl, &own->density);
    hair_gl_free_buffer(draw->gl, &own->box);
    hair_gl_free_buffer(draw->gl, &own->nodes);
    hair_gl_free_buffer(draw->gl, &own->light);
    memset(own, 0, sizeof *own);
}

static hair_result make_light(struct hair_draw* draw, uint32_t each)
{
    struct hair_gl* gl = draw->gl;
    struct hair_self_shadow_state* own = &draw->self_shadow;
    HAIR_ASSERT(0 < each && each <= 1 + HAIR_LIGHTS && draw->vertex_cache.vertices > 0);
    size_t numbers = draw->vertex_cache.vertices * each;
    if (own->texture && own->numbers == numbers && own->each == each) return HAIR_OK;
    hair_gl_free_buffer_texture(gl, &own->texture);
    hair_gl_free_buffer(gl, &own->light);
    hair_gl_free_buffer(gl, &own->nodes);
    own->frame = 0;
    own->numbers = numbers;
    own->each = each;
    size_t nodes = (size_t)HAIR_DENSITY_NODES * each;
    hair_result result = hair_gl_storage(gl, "hair light of nodes", nodes * sizeof(float), NULL, &own->nodes);
    if (!result) result = hair_gl_storage(gl, "hair light", numbers * sizeof(uint32_t), NULL, &own->light);
    return result ? result : hair_gl_buffer_texture(gl, "hair light", GL_R32UI, own->light, &own->texture);
}

static hair_gl_pass past_colliders(const struct hair_draw* draw, hair_gl_pass pass)
{
    return draw->follower_collision.field ? pass | HAIR_GL_WITH(COLLIDERS) : pass;
}

static hair_result make(struct hair_draw* draw, uint32_t each)
{
    struct hair_gl* gl = draw->gl;
    struct hair_self_shadow_state* own = &draw->self_shadow;
    hair_result result = HAIR_OK;
    if (!own->density)
        result =
            hair_gl_storage(gl, "hair density", HAIR_DENSITY_NODES * sizeof(uint32_t), NULL, &own->density);
    if (!result && !own->box)
        result = hair_gl_storage(gl, "hair density box", 6 * sizeof(uint32_t), NULL, &own->box);
    if (!result) result = make_light(draw, each);
    if (result) return result;
    return hair_gl_ensure_programs(gl, HAIR_GL_DENSITY_BOUNDS, HAIR_GL_VERTEX_TRANSMITTANCE,
                                   draw->follower_collision.field ? HAIR_GL_WITH(COLLIDERS) : 0);
}

static void fill(struct hair_draw* draw, uint32_t groups)
{
    static const GLuint none = 0, outermost = UINT32_MAX;
    struct hair_gl* gl = draw->gl;
    struct hair_self_shadow_state* own = &draw->self_shadow;
    gl->ClearNamedBufferData(own->density, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    gl->ClearNamedBufferData(own->box, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &outermost);
    hair_gl_run(gl, HAIR_GL_DENSITY_BOUNDS, groups);
    hair_gl_run(gl, HAIR_GL_DENSITY_SPLAT, draw->patches);
    own->filled = draw->vertex_cache.writes;
    own->frame = 0;
}

// Return whether the light values are valid. Views of one frame with the same lights share them.
// The contents of shadow maps belong to the application, and may change between frames.
static bool is_found(struct hair_draw* draw, const hair_view* view, const struct hair_draw_params* params)
{
    struct hair_self_shadow_state* own = &draw->self_shadow;
    int same = view->frame_index && view->frame_index == own->frame && own->count == params->lights &&
               memcmp(own->lights, params->light, sizeof own->lights) == 0 &&
               memcmp(own->maps, params->shadow, sizeof own->maps) == 0;
    own->frame = view->frame_index;
    own->count = params->lights;
    memcpy(own->lights, params->light, sizeof own->lights);
    memcpy(own->maps, params->shadow, sizeof own->maps);
    return same;
}

// Return whether only the vertices that the view draws need light. Strands that a level of
// detail leaves out need no light. The drawn strands make up for them in the grid. A full vertex
// cache that views share has all vertices.
static bool is_of_a_part(const struct hair_draw* draw, const struct hair_smooth* smooth,
                         const hair_view* view)
{
    return view->lod && !draw->motion.buffer && !hair_draw_has_vertex_cache(draw, smooth);
}

hair_result hair_draw_find_light(struct hair_draw* draw, const struct hair_smooth* smooth,
                                 const struct hair_pose* head, const hair_view* view)
{
    struct hair_gl* gl = draw->gl;
    struct hair_self_shadow_state* own = &draw->self_shadow;
    if (own->density && draw->look.self_shadow != HAIR_SELF_SHADOW_STRANDS) hair_draw_free_self_shadow(draw);
    if (!hair_draw_light_value_count(draw, view)) return HAIR_OK;
    draw->used[HAIR_DRAW_SELF_SHADOW] = draw->frame;
    struct hair_draw_params params;
    int part = is_of_a_part(draw, smooth, view);
    hair_view whole = *view;
    whole.lod = NULL; // All views of a step share the grid.
    hair_draw_write_params(draw, head, part ? view : &whole, &params);
    params.drawn_only = (uint32_t)part;
    params.culls = 0; // Hair that is out of view or occluded casts shadows too.
    params.head_sphere.w = 0;
    hair_result result = hair_draw_ensure_vertex_cache(draw, smooth, part ? &params : NULL);
    if (!result) result = make(draw, hair_draw_light_value_count(draw, view));
    if (result) return result;
    hair_gl_write_uniform(gl, draw->params, sizeof params, &params);
    hair_draw_bind(draw, smooth);
    hair_draw_bind_shadows(draw, view);
    uint32_t groups = draw->patches * params.chunks;
    GLuint grid[] = {own->density, own->box};
    GLuint strands[] = {own->nodes, draw->vertex_cache.position, own->light};
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_DENSITY, 2, grid);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_DENSITY_LIGHT, 3, strands);
    if (own->filled != draw->vertex_cache.writes) fill(draw, groups);
    if (is_found(draw, view, &params)) return HAIR_OK;
    if (part) own->frame = 0; // Another view draws other vertices.
    if (draw->follower_collision.field) hair_field_bind(draw->follower_collision.field);
    hair_gl_run(gl, past_colliders(draw, HAIR_GL_NODE_TRANSMITTANCE), NODE_GROUPS);
    hair_gl_run(gl, past_colliders(draw, HAIR_GL_VERTEX_TRANSMITTANCE), groups);
    return HAIR_OK;
}
