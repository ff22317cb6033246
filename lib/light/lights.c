// lights.c - lights and surroundings, transformed to the head's origin and to the sums that
// light/lights.glsl evaluates.
#include "lib/light/lighting.h"

// Return whether depth in clip space of a light's maps is in [0, 1], and not in [-1, 1].
static bool is_zero_to_one(const struct hair_gl* gl, const hair_light* light)
{
    if (light->shadow_depth_range != HAIR_DEPTH_RANGE_CURRENT)
        return light->shadow_depth_range == HAIR_DEPTH_RANGE_ZERO_TO_ONE;
    return gl->draw_state.is_zero_to_one;
}

// Write the matrix from the head's origin to a shadow map. Map xy from [-1, 1] to [0, 1], and z as
// the depth range says. Reversed depth becomes 1 - depth. In perspective the rows of z and w are
// parallel in xyz. Depth is then its value at infinity minus a term that falls with the distance.
static void write_map(const struct hair_gl* gl, const struct hair_pose* head, const hair_light* light,
                      hair_mat4* shadow, hair_vec4* map)
{
    float halve[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1};
    if (is_zero_to_one(gl, light)) {
        halve[10] = 1;
        halve[14] = 0;
    }
    float texture[16];
    hair_mat4_multiply(halve, light->shadow_matrix, texture);
    for (int i = 0; light->shadow_depth_reversed && i < 16; i += 4)
        texture[i + 2] = texture[i + 3] - texture[i + 2];
    *shadow = hair_mat4_from_head(texture, head);
    hair_vec3 z = hair_v3(texture[2], texture[6], texture[10]);
    hair_vec3 w = hair_v3(texture[3], texture[7], texture[11]);
    float square = hair_dot(w, w), per_metre = hair_length(z);
    map->z = per_metre > 0 ? 1 / per_metre : 0;
    map->w = square > 0 ? hair_dot(z, w) / square : 0;
}

static void write_light(const hair_light* light, const struct hair_pose* head,
                        hair_vec4 out[HAIR_LIGHT_VECTORS])
{
    hair_vec3 to = hair_normalize(hair_load3(light->direction), hair_v3(0, 1, 0));
    bool is_cone = light->kind == HAIR_LIGHT_SPOT;
    float edges = cosf(light->inner_angle) - cosf(light->outer_angle);
    out[HAIR_LIGHT_TO] = (hair_vec4){to.x, to.y, to.z, 0};
    out[HAIR_LIGHT_COLOR] = (hair_vec4){light->color[0], light->color[1], light->color[2], 1};
    out[HAIR_LIGHT_AXIS] =
        is_cone ? (hair_vec4){to.x, to.y, to.z, cosf(light->outer_angle)} : (hair_vec4){0, 0, 0, -1};
    out[HAIR_LIGHT_MORE] = (hair_vec4){is_cone ? 1 / fmaxf(edges, 1e-6f) : 1, 0, 0, HAIR_SHADOW_MAPS};
    out[HAIR_LIGHT_MAP] = (hair_vec4){HAIR_SHADOW_MAPS, light->opaque_bias, 0, 0};
    if (light->kind == HAIR_LIGHT_DIRECTIONAL) return;
    float at[3];
    for (int i = 0; i < 3; ++i) at[i] = (float)((double)light->position[i] - head->position[i]);
    out[HAIR_LIGHT_TO] = (hair_vec4){at[0], at[1], at[2], 1};
    out[HAIR_LIGHT_COLOR].w = light->source_radius * light->source_radius;
    out[HAIR_LIGHT_MORE].y = light->range > 0 ? 1 / (light->range * light->range) : 0;
}

// Write the irradiance matrix of one colour channel (Ramamoorthi and Hanrahan 2001, equation 12).
// Its rows and columns stand for x, y, z and 1.
static void write_sky(const float* sky, int channel, float ambient, hair_mat4* out)
{
    static const float c[] = {0, 0.429043f, 0.511664f, 0.743125f, 0.886227f, 0.247708f};
    float l[9] = {0};
    for (int i = 0; sky && i < 9; ++i) l[i] = sky[3 * i + channel];
    out->column[0] = (hair_vec4){c[1] * l[8], c[1] * l[4], c[1] * l[7], c[2] * l[3]};
    out->column[1] = (hair_vec4){c[1] * l[4], -c[1] * l[8], c[1] * l[5], c[2] * l[1]};
    out->column[2] = (hair_vec4){c[1] * l[7], c[1] * l[5], c[3] * l[6], c[2] * l[2]};
    out->column[3] = (hair_vec4){c[2] * l[3], c[2] * l[1], c[2] * l[2], c[4] * l[0] - c[5] * l[6]};
    out->column[3].w += ambient;
}

uint32_t hair_view_maps(const hair_view* view, struct hair_light_maps out[HAIR_SHADOW_MAPS])
{
    HAIR_ASSERT(view->light_count <= HAIR_LIGHTS);
    uint32_t maps = 0;
    for (uint32_t i = 0; i < view->light_count && maps < HAIR_SHADOW_MAPS; ++i) {
        const hair_light* light = &view->lights[i];
        if (light->hair_shadow_map || light->opaque_shadow_map)
            out[maps++] = (struct hair_light_maps){i, light->hair_shadow_map, light->opaque_shadow_map};
    }
    HAIR_ASSERT(maps <= HAIR_SHADOW_MAPS);
    return maps;
}

bool hair_lighting_is_blocked(const hair_view* view)
{
    struct hair_light_maps maps[HAIR_SHADOW_MAPS];
    uint32_t count = hair_view_maps(view, maps);
    for (uint32_t i = 0; i < count; ++i)
        if (maps[i].body) return view->pass == HAIR_PASS_COLOR;
    return false;
}

void hair_lighting_unbind(struct hair_lighting* lighting)
{
    while (lighting->map_views)
        hair_gl_free_buffer_texture(lighting->gl, &lighting->map_view[--lighting->map_views]);
}

// Return a map, or a 2D view of a layer of it. The view lives until hair_lighting_unbind().
static GLuint find_layer(struct hair_lighting* lighting, GLuint map, uint32_t layer)
{
    struct hair_gl* gl = lighting->gl;
    GLint format = GL_DEPTH_COMPONENT32F;
    if (hair_gl_find_texture_target(gl, map) == GL_TEXTURE_2D) return map;
    HAIR_ASSERT(lighting->map_views < 2 * HAIR_SHADOW_MAPS);
    GLuint* view = &lighting->map_view[lighting->map_views++];
    gl->GetTextureLevelParameteriv(map, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    gl->GenTextures(1, view);
    gl->TextureView(*view, GL_TEXTURE_2D, map, (GLenum)format, 0, 1, layer, 1);
    return *view;
}

static void bind_map(struct hair_lighting* lighting, GLuint unit, GLuint texture, uint32_t layer,
                     bool is_reversed)
{
    struct hair_gl* gl = lighting->gl;
    if (!texture) return;
    hair_gl_bind_texture(gl, unit, find_layer(lighting, texture, layer));
    hair_gl_bind_sampler(gl, unit, gl->shadow_sampler[is_reversed]);
}

void hair_lighting_bind_shadow_maps(struct hair_lighting* lighting, const hair_view* view)
{
    struct hair_light_maps maps[HAIR_SHADOW_MAPS];
    uint32_t count = hair_view_maps(view, maps);
    HAIR_ASSERT(count <= HAIR_SHADOW_MAPS);
    hair_lighting_unbind(lighting);
    for (GLuint i = 0; i < count; ++i) {
        const hair_light* light = &view->lights[maps[i].light];
        bind_map(lighting, HAIR_UNIT_SHADOW + i, maps[i].shadow, light->hair_shadow_part.layer,
                 light->shadow_depth_reversed);
        bind_map(lighting, HAIR_UNIT_BODY + i, maps[i].body, light->opaque_shadow_part.layer,
                 light->shadow_depth_reversed);
    }
}

static void write_parts(const hair_light* light, hair_vec4* hair, hair_vec4* opaque)
{
    const float *a = light->hair_shadow_part.offset, *b = light->hair_shadow_part.size;
    const float *c = light->opaque_shadow_part.offset, *d = light->opaque_shadow_part.size;
    *hair = (hair_vec4){a[0], a[1], b[0], b[1]};
    *opaque = (hair_vec4){c[0], c[1], d[0], d[1]};
}

void hair_lighting_write_lights(struct hair_gl* gl, const hair_look* look, const struct hair_pose* head,
                                const hair_view* view, struct hair_draw_params* out)
{
    struct hair_light_maps maps[HAIR_SHADOW_MAPS];
    uint32_t count = hair_view_maps(view, maps);
    out->lights = view->light_count;
    out->reversed_maps = 0;
    for (uint32_t i = 0; i < view->light_count; ++i)
        write_light(&view->lights[i], head, &out->light[i * HAIR_LIGHT_VECTORS]);
    for (uint32_t i = 0; i < count; ++i) {
        HAIR_ASSERT(maps[i].light < view->light_count);
        hair_vec4* light = &out->light[maps[i].light * HAIR_LIGHT_VECTORS];
        write_map(gl, head, &view->lights[maps[i].light], &out->shadow[i], &light[HAIR_LIGHT_MAP]);
        write_parts(&view->lights[maps[i].light], &out->map_part[i], &out->map_part[HAIR_SHADOW_MAPS + i]);
        light[HAIR_LIGHT_MORE].z = look->self_shadow.absorption;
        if (view->lights[maps[i].light].shadow_depth_reversed) out->reversed_maps |= 1u << i;
        if (maps[i].shadow) light[HAIR_LIGHT_MORE].w = (float)i;
        if (maps[i].body) light[HAIR_LIGHT_MAP].x = (float)i;
    }
    for (int channel = 0; channel < 3; ++channel)
        write_sky(view->sky, channel, view->ambient[channel], &out->sky[channel]);
}
