// view_textures.c - checks of the textures that the application passes to a view. A texture of
// another kind would raise the application's error flag, or stay bound.
#include "lib/api/api.h"

// Return whether shaders read depth from the texture.
static int is_depth(const struct hair_gl* gl, GLuint texture)
{
    GLint base = 0, type = GL_NONE, stencil = 0, reads = GL_DEPTH_COMPONENT;
    gl->GetTextureParameteriv(texture, GL_TEXTURE_BASE_LEVEL, &base);
    gl->GetTextureLevelParameteriv(texture, base, GL_TEXTURE_DEPTH_TYPE, &type);
    gl->GetTextureLevelParameteriv(texture, base, GL_TEXTURE_STENCIL_SIZE, &stencil);
    if (stencil) gl->GetTextureParameteriv(texture, GL_DEPTH_STENCIL_TEXTURE_MODE, &reads);
    return type != GL_NONE && reads == GL_DEPTH_COMPONENT;
}

// Return whether the texture may hold depth in its red channel, as maps of some renderers do.
static bool has_depth_in_red(const struct hair_gl* gl, GLuint texture)
{
    GLint base = 0, bits = 0;
    gl->GetTextureParameteriv(texture, GL_TEXTURE_BASE_LEVEL, &base);
    gl->GetTextureLevelParameteriv(texture, base, GL_TEXTURE_RED_SIZE, &bits);
    return bits >= 16;
}

// Return the layers of a texture that may hold shadow maps, or 0 for another kind.
static GLint count_layers(const struct hair_gl* gl, GLuint texture)
{
    GLint layers = 0;
    switch (hair_gl_find_texture_target(gl, texture)) {
    case GL_TEXTURE_2D: return 1;
    case GL_TEXTURE_CUBE_MAP: return 6;
    case GL_TEXTURE_2D_ARRAY:
    case GL_TEXTURE_CUBE_MAP_ARRAY:
        gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH, &layers);
        return layers;
    default: return 0;
    }
}

// Check a map of a light. Layers are read through views, which need immutable storage.
static hair_result check_shadow_map(const hair_instance* hair, GLuint texture, uint32_t layer, uint32_t light,
                                    const char* name)
{
    const struct hair_gl* gl = &hair->context->gl;
    if (!texture) return HAIR_OK;
    GLint layers = count_layers(gl, texture), is_immutable = 0;
    if (!layers || !(is_depth(gl, texture) || has_depth_in_red(gl, texture)))
        return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_view.lights[%u].%s is %u, not a 2D texture%s", hair->label, light, name,
                         texture, layers ? " of depth" : ", an array or a cube map");
    gl->GetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_FORMAT, &is_immutable);
    if (!is_immutable && hair_gl_find_texture_target(gl, texture) != GL_TEXTURE_2D)
        return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_view.lights[%u].%s is %u, a texture of layers without immutable storage",
                         hair->label, light, name, texture);
    if (layer < (uint32_t)layers) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                     "%s: hair_view.lights[%u] has layer %u of %s, which has %d layers", hair->label, light,
                     layer, name, layers);
}

static hair_result check_shadow_maps(const hair_instance* hair, const hair_view* view)
{
    for (uint32_t i = 0; view->pass == HAIR_PASS_COLOR && i < view->light_count; ++i) {
        const hair_light* light = &view->lights[i];
        HAIR_TRY(check_shadow_map(hair, light->hair_shadow_map, light->hair_shadow_part.layer, i,
                                  "hair_shadow_map"));
        HAIR_TRY(check_shadow_map(hair, light->opaque_shadow_map, light->opaque_shadow_part.layer, i,
                                  "opaque_shadow_map"));
    }
    return HAIR_OK;
}

static hair_result check_color(const hair_instance* hair, const hair_view* view)
{
    const struct hair_gl* gl = &hair->context->gl;
    if (!view->color_texture || view->pass != HAIR_PASS_COLOR) return HAIR_OK;
    if (hair_gl_find_texture_target(gl, view->color_texture) == GL_TEXTURE_2D) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT, "%s: hair_view.color_texture is %u, not a 2D texture",
                     hair->label, view->color_texture);
}

static hair_result check_depth(const hair_instance* hair, const hair_view* view)
{
    const struct hair_gl* gl = &hair->context->gl;
    GLuint texture = view->occluder_depth;
    if (!hair_draw_uses_occlusion(view)) return HAIR_OK;
    if (hair_gl_find_texture_target(gl, texture) == GL_TEXTURE_2D && is_depth(gl, texture)) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                     "%s: hair_view.occluder_depth is %u, not a 2D texture of depth", hair->label, texture);
}

hair_result hair_check_view_textures(const hair_instance* hair, const hair_view* view)
{
    HAIR_TRY(check_shadow_maps(hair, view));
    HAIR_TRY(check_color(hair, view));
    return check_depth(hair, view);
}
