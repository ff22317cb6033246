// follower_collision.c - follower collision, which finds the followers inside colliders and pushes
// them out.
#include "lib/strands/geometry.h"

#include <string.h>

// Distance in metres, beyond the margin of guides, to which followers are pushed out.
#define OUTSIDE 5e-4f
// Followers that a dispatch pushes out. A GPU must not take long for one. `hair-bench dispatch`
// measures them. Among many colliders most followers stay inside one, and take all rounds.
#define PUSHED 32768
#define PUSHED_AMONG_MANY 1024

// Return the pass that finds hits. GPUs need many threads with short loops. A software rasteriser
// needs the least total work.
static hair_gl_pass pass_of(const struct hair_geometry* geometry)
{
    if (geometry->follower_collision.prepass) return HAIR_GL_PREPASS_HIT;
    return hair_geometry_add_style(geometry, geometry->gl->software ? HAIR_GL_HIT : HAIR_GL_HIT_GROUP);
}

// Return the pass that pushes followers out.
static hair_gl_pass repair_of(const struct hair_geometry* geometry)
{
    return hair_geometry_add_style(geometry, geometry->gl->software ? HAIR_GL_REPAIR : HAIR_GL_REPAIR_GROUP);
}

hair_result hair_geometry_ensure_hit_programs(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    hair_result result = hair_gl_ensure_program(gl, pass_of(geometry));
    if (!result && geometry->follower_collision.prepass)
        result = hair_gl_ensure_program(gl, hair_geometry_add_style(geometry, HAIR_GL_PREPASS));
    if (!result && geometry->look.followers.collision == HAIR_FOLLOWER_COLLISION_PUSH_OUT)
        result = hair_gl_ensure_program(gl, repair_of(geometry));
    return result;
}

static hair_result ensure_hit_buffers(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_follower_collision_state* own = &geometry->follower_collision;
    size_t count = geometry->followers;
    hair_result result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_HIT, "hair hits", count * sizeof(float),
                                              &own->hit, GL_R32F, &own->hit_texture);
    if (!result)
        result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_HIT, "hair hit list",
                                      (count + 2) * sizeof(uint32_t), &own->list, 0, NULL);
    if (!result && geometry->look.followers.collision == HAIR_FOLLOWER_COLLISION_PUSH_OUT)
        result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_REPAIR, "hair repairs",
                                      count * HAIR_REPAIR_CONTROLS * 8, &own->repair, GL_RGBA16F,
                                      &own->repair_texture);
    if (!result && own->prepass) result = hair_geometry_ensure_prepass(geometry);
    return result ? result : hair_geometry_ensure_hit_programs(geometry);
}

void hair_geometry_free_follower_collision(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_follower_collision_state* own = &geometry->follower_collision;
    hair_gl_free_array(gl, &own->hit, &own->hit_texture);
    hair_gl_free_array(gl, &own->repair, &own->repair_texture);
    hair_gl_free_array(gl, &own->list, NULL);
    if (own->frame) gl->DeleteFramebuffers(1, &own->frame);
    own->frame = 0;
    hair_gl_free_texture(gl, &own->image);
}

static void run_collision(struct hair_geometry* geometry, const struct hair_collider_field* field,
                          float margin)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_follower_collision_state* follower_collision = &geometry->follower_collision;
    struct hair_draw_params params;
    hair_geometry_write_params(geometry, &params);
    HAIR_ASSERT(follower_collision->parity < 2 && follower_collision->hit && follower_collision->list);
    follower_collision->parity = 1 - follower_collision->parity;
    params.parity = follower_collision->parity;
    params.collision_margin = margin + OUTSIDE;
    hair_gl_write_uniform(gl, geometry->params, sizeof params, &params);
    hair_geometry_bind(geometry);
    hair_field_bind(field);
    GLuint buffers[] = {follower_collision->hit, follower_collision->repair, follower_collision->list};
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_HIT, 3, buffers);
    if (follower_collision->prepass) hair_geometry_run_prepass(geometry);
    int by_group = !follower_collision->prepass && !gl->software;
    uint32_t each = by_group ? HAIR_HIT_FOLLOWERS : HAIR_GROUP_SIZE;
    hair_gl_run(gl, pass_of(geometry), (geometry->followers + each - 1) / each);
    // Work groups beyond the end of the list return at once.
    if (geometry->look.followers.collision != HAIR_FOLLOWER_COLLISION_PUSH_OUT) return;
    each = gl->software ? HAIR_REPAIR_ALONE : HAIR_REPAIR_TURNS;
    uint32_t max = field->near < HAIR_MANY_COLLIDERS ? PUSHED : PUSHED_AMONG_MANY;
    hair_gl_limit_groups(gl, repair_of(geometry), max / each);
    hair_gl_run(gl, repair_of(geometry), (geometry->followers + each - 1) / each);
}

bool hair_geometry_has_follower_collision(const struct hair_geometry* geometry)
{
    return geometry->follower_collision.valid &&
           geometry->follower_collision.smooth_run == geometry->smooth.runs;
}

hair_result hair_geometry_update_follower_collision(struct hair_geometry* geometry,
                                                    const struct hair_collider_field* field, float margin)
{
    struct hair_follower_collision_state* follower_collision = &geometry->follower_collision;
    follower_collision->active = field != NULL;
    follower_collision->field = field;
    if (field) {
        hair_result result = ensure_hit_buffers(geometry);
        if (result) return result;
        run_collision(geometry, field, margin);
    }
    ++follower_collision->generation;
    follower_collision->valid = 1;
    follower_collision->smooth_run = geometry->smooth.runs;
    return HAIR_OK;
}

void hair_geometry_set_blockers(struct hair_geometry* geometry, const struct hair_collider_field* field)
{
    geometry->follower_collision.field = field;
}

void hair_geometry_invalidate(struct hair_geometry* geometry)
{
    geometry->follower_collision.valid = 0;
}
