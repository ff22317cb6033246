// geometry.c - the life of the strands of an instance.
#include "lib/strands/geometry.h"

#include <string.h>

// Create the buffer of factors of single strands, if the groom has any.
static hair_result create_factors(struct hair_geometry* geometry, const struct hair_groom* groom)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_strand_factor_buffer* out = &geometry->factors;
    for (int i = 0; i < HAIR_FACTORS; ++i) out->max[i] = groom->factors ? groom->max_follower_factors[i] : 1;
    if (!groom->factors) return HAIR_OK;
    out->slots = groom->factor_slots;
    out->count = groom->factor_count;
    HAIR_TRY(hair_gl_shared_buffer(gl, "factors of strands",
                                   (size_t)geometry->followers * out->count * sizeof *groom->factors,
                                   groom->factors, &out->buffer));
    return hair_gl_buffer_texture(gl, "factors of strands", GL_R16F, out->buffer, &out->texture);
}

hair_result hair_geometry_create(struct hair_geometry* geometry, struct hair_gl* gl,
                                 const struct hair_groom* groom, const struct hair_sim* sim,
                                 const hair_look* look, bool uses_prepass)
{
    geometry->gl = gl;
    geometry->look = *look;
    hair_look_write_curves(look, &geometry->strand_look);
    geometry->follower_collision.prepass = uses_prepass;
    geometry->lengths = &sim->lengths;
    geometry->guides = sim->guides;
    geometry->smooth_vertices = sim->smooth_vertices;
    geometry->followers = groom->info.follower_count;
    geometry->shape_vertices = groom->shape_vertices;
    geometry->patches = groom->info.patch_count;
    geometry->map_sets = groom->map_sets;
    geometry->groom = groom;
    for (uint32_t i = 0; i < geometry->patches; ++i)
        if (groom->patches[i].count > geometry->max_isolines)
            geometry->max_isolines = groom->patches[i].count;
    // A patch of more than HAIR_MAX_ISOLINES is drawn in parts.
    HAIR_ASSERT((geometry->max_isolines > 0) == (geometry->followers > 0));
    HAIR_TRY(hair_smooth_create(&geometry->smooth, gl, groom, sim));
    HAIR_TRY(hair_geometry_make_followers(geometry, groom->followers, true, &geometry->follower));
    HAIR_TRY(create_factors(geometry, groom));
    HAIR_TRY(hair_gl_buffer(gl, HAIR_GL_CATEGORY_COLOR, "hair patches",
                            geometry->patches * sizeof *groom->patches, groom->patches, &geometry->patch));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_COLOR, "hair draw", sizeof(struct hair_draw_params),
                             &geometry->params));
    return hair_gl_buffer_texture(gl, "hair patches", GL_RGBA32UI, geometry->patch, &geometry->patch_texture);
}

void hair_geometry_destroy(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    if (!gl) return;
    hair_geometry_free_follower_collision(geometry);
    hair_geometry_free_vertex_cache(geometry);
    hair_geometry_free_history(geometry, &geometry->guide_history);
    hair_geometry_free_uvs(geometry);
    hair_geometry_free_followers(gl, &geometry->follower);
    hair_gl_free_array(gl, &geometry->patch, &geometry->patch_texture);
    hair_gl_free_array(gl, &geometry->factors.buffer, &geometry->factors.texture);
    hair_gl_free_buffer(gl, &geometry->groups.factors);
    hair_gl_free_buffer(gl, &geometry->params);
    hair_smooth_destroy(&geometry->smooth);
}

hair_result hair_geometry_make_group_looks(const struct hair_geometry* geometry,
                                           const struct hair_group_factors factors[HAIR_STRAND_GROUPS],
                                           struct hair_group_look_buffer* out)
{
    struct hair_group_look_buffer made = {0};
    for (int g = 0; g < HAIR_STRAND_GROUPS; ++g) {
        made.max_curl_radius = fmaxf(made.max_curl_radius, factors[g].curl_radius);
        made.max_frizz = fmaxf(made.max_frizz, factors[g].frizz);
    }
    HAIR_TRY(hair_gl_buffer(geometry->gl, HAIR_GL_CATEGORY_COLOR, "looks of groups",
                            HAIR_STRAND_GROUPS * sizeof *factors, factors, &made.factors));
    *out = made;
    return HAIR_OK;
}

void hair_geometry_swap_group_looks(struct hair_geometry* geometry, struct hair_group_look_buffer* groups)
{
    struct hair_group_look_buffer was = geometry->groups;
    geometry->groups = *groups, *groups = was;
}

void hair_geometry_set_look(struct hair_geometry* geometry, const hair_look* look)
{
    if (memcmp(look, &geometry->look, sizeof *look) != 0) hair_geometry_invalidate(geometry);
    geometry->look = *look;
    hair_look_write_curves(look, &geometry->strand_look);
}

void hair_geometry_invalidate_guides(struct hair_geometry* geometry)
{
    hair_smooth_invalidate(&geometry->smooth);
}

void hair_geometry_ensure_guides(struct hair_geometry* geometry, struct hair_sim* sim)
{
    if (!geometry->smooth.done) hair_geometry_save_guide_history(geometry);
    hair_smooth_ensure(&geometry->smooth, sim);
    hair_geometry_bind_followers(geometry, sim);
}

uint32_t hair_geometry_count_smoothed(const struct hair_geometry* geometry)
{
    return geometry->smooth.vertices;
}

GLuint hair_geometry_smoothed_positions(const struct hair_geometry* geometry)
{
    return geometry->smooth.buffer[0];
}

bool hair_geometry_shows_followers(const struct hair_geometry* geometry)
{
    return geometry->look.followers.density > 0;
}
