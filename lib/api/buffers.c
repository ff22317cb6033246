// buffers.c - the public call that provides the strands as OpenGL buffers.
#include "lib/api/api.h"

// Attributes that guides have.
#define OF_GUIDES                                                                                            \
    ((uint32_t)(HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_TANGENT | HAIR_ATTRIBUTE_STRAND |                   \
                HAIR_ATTRIBUTE_PREV_POSITION))

static hair_result check_request(const hair_instance* hair, hair_read_source source,
                                 const hair_buffers* wanted)
{
    const hair_host* host = &hair->context->host;
    if (source != HAIR_READ_SMOOTH && source != HAIR_READ_FOLLOWERS)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: source is %d, not HAIR_READ_SMOOTH or HAIR_READ_FOLLOWERS", hair->label,
                         (int)source);
    if (source == HAIR_READ_SMOOTH && wanted->attributes & ~OF_GUIDES)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_buffers.attributes is %u, but guides have only those of %u", hair->label,
                         wanted->attributes, OF_GUIDES);
    uint64_t vertices = source == HAIR_READ_SMOOTH ? hair_geometry_count_smoothed(&hair->geometry)
                                                   : hair_geometry_count_vertices(&hair->geometry);
    if (vertices <= UINT32_MAX) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_MEMORY, "%s: %llu vertices are too many for buffers", hair->label,
                     (unsigned long long)vertices);
}

static hair_result find_followers(hair_instance* hair, const struct hair_pose* head, hair_buffers* out)
{
    hair_draw_select_lod(&hair->renderer, head, NULL);
    HAIR_TRY(hair_update_follower_collision(hair));
    return hair_draw_get_followers(&hair->renderer, head, out);
}

hair_result hair_get_buffers(hair_instance* hair, hair_read_source source, hair_buffers* out)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    const struct hair_pose* head = &hair->sim.head_at_last_step;
    hair_buffers wanted, own = hair_buffers_default();
    HAIR_TRY(HAIR_COPY_IN(host, hair_buffers, out, &wanted));
    HAIR_TRY(check_request(hair, source, &wanted));
    HAIR_TRY(hair_check_current(hair->context));
    HAIR_TRY(hair_catch_up(&hair, 1));
    own.attributes = wanted.attributes;
    own.frame_index = wanted.frame_index;
    own.prev_rotation[3] = 1;
    for (int k = 0; k < 3; ++k) own.origin[k] = own.prev_origin[k] = head->position[k];
    HAIR_TRY(hair_get_bounds(hair, own.lower, own.upper));
    hair_enter(hair);
    hair_draw_free_unused(&hair->renderer, hair->profiler.number);
    hair_geometry_ensure_guides(&hair->geometry, &hair->sim);
    hair_result result = source == HAIR_READ_SMOOTH
                             ? hair_draw_get_guides(&hair->renderer, &hair->sim, head, &own)
                             : find_followers(hair, head, &own);
    HAIR_TRY(hair_leave(hair->context, result));
    hair_sim_set_unseen_time(&hair->sim, 0);
    return HAIR_COPY_OUT(host, hair_buffers, &own, out);
}
