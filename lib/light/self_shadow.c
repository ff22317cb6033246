// self_shadow.c - light that reaches each vertex of the strands. A density grid is computed once
// for all views of the same strands. The light is attenuated through the grid and by shadow maps.
#include "lib/light/lighting.h"

#include <string.h>

#define MIN_NODES 4096u // Minimum capacity of the grid, a multiple of 4 times HAIR_GROUP_SIZE.
#define SHRINKS 4 // A grid is made anew once many views in turn need less than a fourth of it.
#define NODE_GROUPS 4096 // Maximum work groups. Their threads loop over all nodes of the grid.
// Work of a dispatch. A GPU must not take long for one. `hair-bench dispatch` measures them.
#define SPLAT_SEGMENTS (1u << 21) // Segments of a dispatch that fills the grid.
#define LIT_VALUES (1u << 21) // Light values of vertices of a dispatch.

void hair_lighting_free_self_shadow(struct hair_lighting* lighting)
{
    struct hair_self_shadow_state* own = &lighting->self_shadow;
    if (!own->nodes && !own->light) return;
    hair_gl_free_array(lighting->gl, &own->density, NULL);
    hair_gl_free_array(lighting->gl, &own->nodes, NULL);
    hair_gl_free_array(lighting->gl, &own->light, &own->texture);
    memset(own, 0, sizeof *own);
}

hair_result hair_lighting_ensure_grid(struct hair_lighting* lighting, uint32_t nodes, uint32_t each)
{
    struct hair_gl* gl = lighting->gl;
    struct hair_self_shadow_state* own = &lighting->self_shadow;
    HAIR_ASSERT(0 < nodes && nodes <= HAIR_DENSITY_NODES && 0 < each && each <= 1 + HAIR_LIGHTS);
    uint32_t room = MIN_NODES;
    while (room < nodes) room *= 2;
    bool is_spare = hair_gl_count_spare(&own->spare, own->room / SHRINKS > room);
    if (own->room < nodes || is_spare) hair_gl_free_array(gl, &own->density, NULL);
    if (own->density && own->each == each) return HAIR_OK;
    hair_gl_free_array(gl, &own->nodes, NULL);
    hair_gl_free_array(gl, &own->density, NULL);
    own->room = room;
    own->filled = own->spare = 0;
    own->each = each;
    own->frame = 0;
    HAIR_TRY(hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_SELF_SHADOW, "hair light of nodes",
                                  (size_t)own->room * HAIR_NODE_WORDS(each) * sizeof(uint32_t), &own->nodes,
                                  0, NULL));
    return hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_SELF_SHADOW, "hair density",
                                (HAIR_DENSITY_FIRST + own->room) * sizeof(uint32_t), &own->density, 0, NULL);
}

static hair_result ensure_light(struct hair_lighting* lighting, const struct hair_geometry* geometry)
{
    struct hair_self_shadow_state* own = &lighting->self_shadow;
    HAIR_ASSERT(geometry->vertex_cache.vertices > 0);
    size_t numbers = geometry->vertex_cache.vertices * own->each;
    uint32_t fraction = geometry->vertex_cache.fraction;
    if (own->texture && own->numbers == numbers && own->fraction == fraction) return HAIR_OK;
    hair_gl_free_array(lighting->gl, &own->light, &own->texture);
    own->frame = 0;
    own->numbers = numbers;
    own->fraction = fraction;
    return hair_gl_ensure_array(lighting->gl, HAIR_GL_CATEGORY_SELF_SHADOW, "hair light",
                                numbers * sizeof(uint32_t), &own->light, GL_R32UI, &own->texture);
}

static void fill_grid(struct hair_lighting* lighting, const struct hair_geometry* geometry, uint32_t groups)
{
    struct hair_gl* gl = lighting->gl;
    struct hair_self_shadow_state* own = &lighting->self_shadow;
    HAIR_ASSERT(own->density && groups > 0);
    // The box takes one group more.
    hair_gl_run(gl, HAIR_GL_DENSITY_CLEAR, 1 + own->room / 4 / HAIR_GROUP_SIZE);
    hair_gl_run(gl, HAIR_GL_DENSITY_BOUNDS, groups);
    uint32_t each = (groups / geometry->patches + HAIR_SPLAT_ROUNDS - 1) / HAIR_SPLAT_ROUNDS;
    hair_gl_limit_groups(gl, HAIR_GL_DENSITY_SPLAT, SPLAT_SEGMENTS / (HAIR_GROUP_SIZE * HAIR_SPLAT_ROUNDS));
    hair_gl_run(gl, HAIR_GL_DENSITY_SPLAT, geometry->patches * each);
    own->filled = geometry->vertex_cache.writes;
    own->frame = 0;
}

// Return whether the light values are valid. Views of one frame with the same lights share them.
// The contents of shadow maps belong to the application, and may change between frames.
static bool is_found(struct hair_lighting* lighting, const hair_view* view,
                     const struct hair_draw_params* params)
{
    struct hair_self_shadow_state* own = &lighting->self_shadow;
    int same = view->frame_index && view->frame_index == own->frame && own->count == params->lights &&
               memcmp(own->lights, params->light, sizeof own->lights) == 0 &&
               memcmp(own->maps, params->shadow, sizeof own->maps) == 0;
    own->frame = view->frame_index;
    own->count = params->lights;
    memcpy(own->lights, params->light, sizeof own->lights);
    memcpy(own->maps, params->shadow, sizeof own->maps);
    return same;
}

// Run a pass that finds the light of nodes or vertices, past colliders too.
static void find_light(struct hair_lighting* lighting, const struct hair_geometry* geometry,
                       hair_gl_pass pass, uint32_t groups, uint32_t max)
{
    HAIR_ASSERT(groups > 0 && max > 0);
    if (geometry->follower_collision.field) pass |= HAIR_GL_WITH(COLLIDERS);
    hair_gl_limit_groups(lighting->gl, pass, max);
    hair_gl_run(lighting->gl, pass, groups);
}

uint32_t hair_lighting_value_count(const hair_look* look, const hair_view* view)
{
    int wanted = view->pass == HAIR_PASS_COLOR && look->self_shadow.method == HAIR_SELF_SHADOW_STRANDS;
    return wanted ? 1 + view->light_count : 0;
}

hair_result hair_lighting_update_self_shadow(struct hair_lighting* lighting, struct hair_geometry* geometry,
                                             const hair_view* view, const struct hair_draw_params* params,
                                             const struct hair_draw_params* drawn, bool is_part)
{
    struct hair_gl* gl = lighting->gl;
    struct hair_self_shadow_state* own = &lighting->self_shadow;
    HAIR_ASSERT(own->density && params->light_values == own->each);
    hair_result result = hair_geometry_ensure_vertex_cache(geometry, is_part ? params : NULL);
    if (!result) result = ensure_light(lighting, geometry);
    if (result) return result;
    hair_gl_write_uniform(gl, geometry->params, sizeof *params, params);
    hair_geometry_bind(geometry);
    hair_lighting_bind_shadow_maps(lighting, view);
    uint32_t groups = geometry->patches * params->chunks;
    GLuint buffers[] = {own->nodes, geometry->vertex_cache.position, own->light};
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_DENSITY, 1, &own->density);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_DENSITY_LIGHT, 3, buffers);
    if (own->filled != geometry->vertex_cache.writes) fill_grid(lighting, geometry, groups);
    if (is_found(lighting, view, params) && !view->lod) return HAIR_OK;
    if (view->lod) own->frame = 0; // Another view draws other strands, or in another width.
    if (geometry->follower_collision.field) hair_field_bind(geometry->follower_collision.field);
    uint32_t values = params->light_values;
    uint32_t whole = own->room / HAIR_GROUP_SIZE;
    find_light(lighting, geometry, HAIR_GL_NODE_TRANSMITTANCE, whole < NODE_GROUPS ? whole : NODE_GROUPS,
               NODE_GROUPS / values);
    hair_gl_pass pass = HAIR_GL_VERTEX_TRANSMITTANCE;
    if (view->lod) { // Strands of a level of detail are wider, and drawn elsewhere.
        pass = hair_geometry_choose_variant(geometry, HAIR_GL_VERTEX_TRANSMITTANCE_DRAWN);
        hair_gl_write_uniform(gl, geometry->params, sizeof *drawn, drawn);
    }
    find_light(lighting, geometry, pass, groups, LIT_VALUES / (HAIR_GROUP_SIZE * values));
    return HAIR_OK;
}
