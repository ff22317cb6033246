// shadow_map.c - Shadow maps of a light, with depth of opaque geometry, depth of hair, and opacity
// of hair.
#include "tools/common/shadow_map.h"

#include <epoxy/gl.h>

#include <string.h>

static GLuint make_texture(enum hair_shadow_part part, GLsizei size)
{
    GLuint texture;
    GLint filter = part == HAIR_SHADOW_OPACITY ? GL_LINEAR : GL_NEAREST;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, part == HAIR_SHADOW_OPACITY ? GL_R16F : GL_DEPTH_COMPONENT32F, size, size);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static bool make_part(struct hair_shadow_map* map, enum hair_shadow_part part)
{
    GLuint framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    map->framebuffer[part] = framebuffer;
    map->texture[part] = make_texture(part, map->size);
    if (part == HAIR_SHADOW_OPACITY) {
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, map->texture[part], 0);
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, map->texture[HAIR_SHADOW_BODY], 0);
    } else {
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, map->texture[part], 0);
        glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
    }
    return glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

bool hair_shadow_map_make(struct hair_shadow_map* map, enum hair_shadow_part parts, int size)
{
    if (map->size != size) hair_shadow_map_delete(map);
    map->size = size;
    for (int part = 0; part < (int)parts; ++part)
        if (!map->framebuffer[part] && !make_part(map, (enum hair_shadow_part)part)) return false;
    return !glGetError();
}

void hair_shadow_map_delete(struct hair_shadow_map* map)
{
    glDeleteFramebuffers(HAIR_SHADOW_PARTS, map->framebuffer);
    glDeleteTextures(HAIR_SHADOW_PARTS, map->texture);
    memset(map, 0, sizeof *map);
}

void hair_shadow_map_begin(const struct hair_shadow_map* map, enum hair_shadow_part part)
{
    static const float far = 1, none[4] = {0};
    int opacity = part == HAIR_SHADOW_OPACITY;
    glBindFramebuffer(GL_FRAMEBUFFER, map->framebuffer[part]);
    glViewport(0, 0, map->size, map->size);
    glClearNamedFramebufferfv(map->framebuffer[part], opacity ? GL_COLOR : GL_DEPTH, 0,
                              opacity ? none : &far);
    glEnable(GL_DEPTH_TEST);
}

unsigned hair_shadow_sampler(void)
{
    GLuint sampler;
    glCreateSamplers(1, &sampler);
    glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return sampler;
}
