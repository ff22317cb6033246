// scalp_roots.c - followers on a skinned scalp. Their roots follow the scalp between the guides.
#include "lib/strands/geometry.h"

// Let the strands have a buffer of followers of their own, which may be written.
static hair_result own_followers(struct hair_geometry* geometry)
{
    struct hair_follower_buffer made = {0};
    if (!geometry->follower.is_shared) return HAIR_OK;
    HAIR_TRY(hair_geometry_make_followers(geometry, geometry->groom->followers, false, &made));
    hair_geometry_swap_followers(geometry, &made);
    hair_geometry_free_followers(geometry->gl, &made);
    return HAIR_OK;
}

hair_result hair_geometry_create_scalp_roots(struct hair_geometry* geometry, struct hair_sim* sim)
{
    struct hair_gl* gl = geometry->gl;
    size_t size = geometry->followers * sizeof(struct hair_follower);
    if (size > (size_t)gl->max_storage_bytes)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "hair followers on a skinned scalp take %zu bytes, more than the driver's %d", size,
                         gl->max_storage_bytes);
    HAIR_TRY(own_followers(geometry));
    return hair_scalp_motion_create(sim);
}

// Move the roots of followers with the scalp. Free roots are not attached to it.
void hair_geometry_bind_followers(struct hair_geometry* geometry, struct hair_sim* sim)
{
    struct hair_gl* gl = geometry->gl;
    if (!hair_scalp_motion_is_on(sim) || geometry->bound_run == geometry->smooth.runs ||
        sim->physics.root == HAIR_ROOT_FREE)
        return;
    HAIR_ASSERT(sim->scalp_motion.root_bindings->count == geometry->guides + geometry->followers);
    hair_sim_bind(sim);
    hair_scalp_motion_bind_all(sim, geometry->followers);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_FOLLOWER, 1, &geometry->follower.buffer);
    hair_gl_bind_texture(gl, HAIR_UNIT_POSITION, geometry->smooth.texture[0]);
    hair_gl_bind_texture(gl, HAIR_UNIT_FRAME, geometry->smooth.texture[1]);
    hair_gl_run(gl, HAIR_GL_BIND_FOLLOWERS, (geometry->followers + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    geometry->bound_run = geometry->smooth.runs;
}
