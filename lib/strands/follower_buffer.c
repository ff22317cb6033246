// follower_buffer.c - buffers of followers. All instances of a groom have one, except those whose
// followers differ from the groom.
#include "lib/strands/geometry.h"

#include <math.h>

static float find_max_width(uint32_t count, const struct hair_follower* followers)
{
    float width = 0;
    for (uint32_t i = 0; i < count; ++i) width = fmaxf(width, followers[i].offset[0].w);
    return width;
}

hair_result hair_geometry_make_followers(const struct hair_geometry* geometry,
                                         const struct hair_follower* followers, bool is_shared,
                                         struct hair_follower_buffer* out)
{
    struct hair_gl* gl = geometry->gl;
    size_t size = hair_groom_follower_bytes(geometry->groom);
    struct hair_follower_buffer made = {.max_width = find_max_width(geometry->followers, followers),
                                        .is_shared = is_shared};
    if (is_shared)
        HAIR_TRY(hair_gl_shared_buffer(gl, "hair followers", size, followers, &made.buffer));
    else
        HAIR_TRY(hair_gl_buffer(gl, HAIR_GL_CATEGORY_COLOR, "hair followers", size, followers, &made.buffer));
    hair_result result =
        hair_gl_buffer_texture(gl, "hair followers", GL_RGBA32UI, made.buffer, &made.texture);
    if (result)
        hair_geometry_free_followers(gl, &made);
    else
        *out = made;
    return result;
}

void hair_geometry_free_followers(struct hair_gl* gl, struct hair_follower_buffer* followers)
{
    hair_gl_free_array(gl, &followers->buffer, &followers->texture);
}

void hair_geometry_swap_followers(struct hair_geometry* geometry, struct hair_follower_buffer* followers)
{
    struct hair_follower_buffer was = geometry->follower;
    geometry->follower = *followers, *followers = was;
    geometry->bound_run = geometry->smooth.runs - 1; // Their roots have not moved with the scalp.
}
