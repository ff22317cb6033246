// targets.c - Render targets of a capture.
#include "tools/common/targets.h"

#include <epoxy/gl.h>

static GLuint make_texture(GLenum format, GLsizei width, GLsizei height)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static GLuint make_samples(GLenum format, GLsizei samples, GLsizei width, GLsizei height)
{
    GLuint buffer;
    glCreateRenderbuffers(1, &buffer);
    glNamedRenderbufferStorageMultisample(buffer, samples, format, width, height);
    return buffer;
}

bool hair_targets_make(struct hair_targets* targets, uint32_t width, uint32_t height, uint32_t supersample,
                       uint32_t samples)
{
    GLsizei w = (GLsizei)width, h = (GLsizei)height, wide = w * (GLsizei)supersample,
            high = h * (GLsizei)supersample;
    GLint max = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &max);
    GLsizei count = (GLint)samples < max ? (GLsizei)samples : max;
    if (count == 1) count = 0;

    glCreateFramebuffers(HAIR_TARGET_COUNT, targets->framebuffer);
    targets->color_samples = count ? make_samples(GL_RGBA16F, count, wide, high) : 0;
    targets->depth_samples = make_samples(GL_DEPTH_COMPONENT32F, count, wide, high);
    targets->resolved = make_texture(GL_RGBA16F, wide, high);
    targets->encoded = make_texture(GL_RGBA8, w, h);
    targets->linear = make_texture(GL_RGBA16F, w, h);
    targets->depth = make_texture(GL_DEPTH_COMPONENT32F, wide, high);

    static const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    const GLuint* framebuffer = targets->framebuffer;
    GLuint drawn = framebuffer[HAIR_TARGET_DRAWN], encoded = framebuffer[HAIR_TARGET_ENCODED];
    if (targets->color_samples)
        glNamedFramebufferRenderbuffer(drawn, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, targets->color_samples);
    else
        glNamedFramebufferTexture(drawn, GL_COLOR_ATTACHMENT0, targets->resolved, 0);
    glNamedFramebufferRenderbuffer(drawn, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, targets->depth_samples);
    glNamedFramebufferTexture(framebuffer[HAIR_TARGET_RESOLVED], GL_COLOR_ATTACHMENT0, targets->resolved, 0);
    glNamedFramebufferTexture(framebuffer[HAIR_TARGET_RESOLVED], GL_DEPTH_ATTACHMENT, targets->depth, 0);
    glNamedFramebufferTexture(encoded, GL_COLOR_ATTACHMENT0, targets->encoded, 0);
    glNamedFramebufferTexture(encoded, GL_COLOR_ATTACHMENT1, targets->linear, 0);
    glNamedFramebufferDrawBuffers(encoded, 2, both);
    for (int i = 0; i < HAIR_TARGET_COUNT; ++i)
        if (glCheckNamedFramebufferStatus(framebuffer[i], GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            return false;
    return !glGetError();
}

void hair_targets_resolve(const struct hair_targets* targets, const int lower[2], const int upper[2])
{
    if (!targets->color_samples) return;
    glBlitNamedFramebuffer(targets->framebuffer[HAIR_TARGET_DRAWN],
                           targets->framebuffer[HAIR_TARGET_RESOLVED], lower[0], lower[1], upper[0], upper[1],
                           lower[0], lower[1], upper[0], upper[1], GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void hair_targets_delete(struct hair_targets* targets)
{
    const GLuint textures[] = {targets->resolved, targets->encoded, targets->linear, targets->depth};
    const GLuint renderbuffers[] = {targets->color_samples, targets->depth_samples};
    glDeleteFramebuffers(HAIR_TARGET_COUNT, targets->framebuffer);
    glDeleteTextures(4, textures);
    glDeleteRenderbuffers(2, renderbuffers);
}
