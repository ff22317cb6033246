// lighting.c - the life, the parameters and the bindings of lighting.
#include "lib/light/lighting.h"

hair_result hair_lighting_create(struct hair_lighting* lighting, struct hair_gl* gl,
                                 const struct hair_groom* groom)
{
    GLuint made[2] = {0};
    lighting->gl = gl;
    hair_lighting_measure_groom(lighting, groom);
    lighting->has_groom_colors = groom->colors != NULL;
    if (!groom->colors) return HAIR_OK;
    HAIR_TRY(hair_lighting_make_colors(lighting, groom->info.follower_count, groom->colors, true, made));
    hair_lighting_swap_colors(lighting, made, false);
    return HAIR_OK;
}

hair_result hair_lighting_make_colors(const struct hair_lighting* lighting, uint32_t followers,
                                      const uint16_t* colors, bool is_shared, GLuint out[2])
{
    size_t size = (size_t)followers * (HAIR_CURVE_INTERVALS + 1) * 4 * sizeof *colors;
    if (is_shared)
        HAIR_TRY(hair_gl_shared_buffer(lighting->gl, "hair colours", size, colors, &out[0]));
    else
        HAIR_TRY(hair_gl_buffer(lighting->gl, HAIR_GL_CATEGORY_COLOR, "hair colours", size, colors, &out[0]));
    hair_result result = hair_gl_buffer_texture(lighting->gl, "hair colours", GL_RGBA16, out[0], &out[1]);
    if (result) hair_gl_free_array(lighting->gl, &out[0], &out[1]);
    return result;
}

void hair_lighting_swap_colors(struct hair_lighting* lighting, GLuint colors[2], bool has_group_colors)
{
    GLuint was[2] = {lighting->groom_color, lighting->groom_color_texture};
    lighting->groom_color = colors[0], lighting->groom_color_texture = colors[1];
    lighting->has_group_colors = has_group_colors;
    colors[0] = was[0], colors[1] = was[1];
}

bool hair_lighting_has_strand_colors(const struct hair_lighting* lighting, const hair_look* look)
{
    return lighting->groom_color && (lighting->has_group_colors || look->color.groom_colors > 0);
}

void hair_lighting_destroy(struct hair_lighting* lighting)
{
    if (!lighting->gl) return;
    hair_lighting_unbind(lighting);
    hair_lighting_free_fibres(lighting);
    hair_lighting_free_self_shadow(lighting);
    hair_gl_free_array(lighting->gl, &lighting->groom_color, &lighting->groom_color_texture);
}

// Write the parameters of fibre shading.
static void write_fibre(const hair_look* look, hair_vec4* out)
{
    float variance[3], d = hair_fibre_darkening(look->shading.roughness[1]);
    hair_fibre_variances(look->shading.roughness[0], variance);
    *out = (hair_vec4){variance[0], 1 / (d * d), look->shading.cuticle_tilt, look->shading.scattering};
}

void hair_lighting_write_params(const struct hair_lighting* lighting, const hair_look* look,
                                const struct hair_pose* head, const hair_view* view,
                                struct hair_draw_params* out)
{
    out->specular = (hair_vec4){look->shading.specular[0], look->shading.specular[1], look->shading.gloss[0],
                                look->shading.gloss[1]};
    write_fibre(look, &out->fibre);
    hair_look_write_tint(look, &out->tint);
    if (!lighting->has_groom_colors) out->tint.groom_color = 0;
    if (!view) return;
    out->colored = view->pass == HAIR_PASS_COLOR;
    out->encode = (hair_uint)view->encode;
    out->light_values = hair_lighting_value_count(look, view);
    out->cache_fraction = lighting->self_shadow.fraction;
    if (out->colored && !out->light_values) out->order = hair_lighting_order(lighting, look);
    hair_lighting_write_lights(lighting->gl, look, head, view, out);
}

void hair_lighting_bind(struct hair_lighting* lighting, const hair_look* look, const hair_view* view)
{
    struct hair_gl* gl = lighting->gl;
    if (lighting->fibres.texture) hair_gl_bind_texture(gl, HAIR_UNIT_FIBRE, lighting->fibres.texture);
    hair_gl_bind_sampler(gl, HAIR_UNIT_FIBRE, 0);
    if (hair_lighting_value_count(look, view))
        hair_gl_bind_texture(gl, HAIR_UNIT_LIGHT, lighting->self_shadow.texture);
    hair_lighting_bind_shadow_maps(lighting, view);
}
