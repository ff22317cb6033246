// frame.c - a framebuffer to draw into, its pixels, and PNG files of them.
#include "tests/support/frame.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

static GLuint make_target(const struct hair_test_frame* frame, GLenum format, GLsizei samples)
{
    GLuint target;
    glCreateRenderbuffers(1, &target);
    glNamedRenderbufferStorageMultisample(target, samples, format, frame->width, frame->height);
    return target;
}

static GLuint make_framebuffer(struct hair_test_frame* frame, int i, GLenum format, GLsizei samples)
{
    GLuint framebuffer;
    frame->color[i] = make_target(frame, format, samples);
    frame->depth[i] = make_target(frame, GL_DEPTH_COMPONENT32F, samples);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, frame->color[i]);
    glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, frame->depth[i]);
    return framebuffer;
}

void hair_test_frame_clear(const struct hair_test_frame* frame)
{
    static const float black[4] = {0, 0, 0, 0}, far_away = 1;
    static const GLuint zero[4] = {0, 0, 0, 0};
    if (frame->format == GL_RGBA32UI)
        glClearNamedFramebufferuiv(frame->framebuffer, GL_COLOR, 0, zero);
    else
        glClearNamedFramebufferfv(frame->framebuffer, GL_COLOR, 0, black);
    glClearNamedFramebufferfv(frame->framebuffer, GL_DEPTH, 0, &far_away);
}

void hair_test_frame_make(struct hair_test_frame* frame, GLsizei width, GLsizei height, GLenum format,
                          GLsizei samples)
{
    *frame = (struct hair_test_frame){.width = width, .height = height, .samples = samples, .format = format};
    frame->framebuffer = make_framebuffer(frame, 0, format, samples);
    frame->resolved = samples ? make_framebuffer(frame, 1, format, 0) : frame->framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->framebuffer);
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    hair_test_frame_clear(frame);
}

void hair_test_frame_free(struct hair_test_frame* frame)
{
    glDeleteFramebuffers(1, &frame->framebuffer);
    if (frame->samples) glDeleteFramebuffers(1, &frame->resolved);
    glDeleteRenderbuffers(2, frame->color);
    glDeleteRenderbuffers(2, frame->depth);
    memset(frame, 0, sizeof *frame);
}

void hair_test_frame_read(const struct hair_test_frame* frame, float* pixels)
{
    if (frame->samples)
        glBlitNamedFramebuffer(frame->framebuffer, frame->resolved, 0, 0, frame->width, frame->height, 0, 0,
                               frame->width, frame->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame->resolved);
    glReadPixels(0, 0, frame->width, frame->height, GL_RGBA, GL_FLOAT, pixels);
    glBindFramebuffer(GL_FRAMEBUFFER, frame->framebuffer);
}

void hair_test_frame_read_depth(const struct hair_test_frame* frame, float* depths)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame->framebuffer);
    glReadPixels(0, 0, frame->width, frame->height, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
    glBindFramebuffer(GL_FRAMEBUFFER, frame->framebuffer);
}

int hair_test_png_write(const char* path, int width, int height, const unsigned char* pixels)
{
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)width,
                       .height = (png_uint_32)height,
                       .format = PNG_FORMAT_RGBA};
    return png_image_write_to_file(&image, path, 0, pixels, 0, NULL);
}

int hair_test_png_read(const char* path, int* width, int* height, unsigned char** pixels)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) return 0;
    image.format = PNG_FORMAT_RGBA;
    *pixels = malloc(PNG_IMAGE_SIZE(image));
    if (!*pixels || !png_image_finish_read(&image, NULL, *pixels, 0, NULL)) {
        free(*pixels);
        png_image_free(&image);
        return 0;
    }
    *width = (int)image.width;
    *height = (int)image.height;
    return 1;
}

void hair_test_blend_begin(void)
{
    glBlendFuncSeparatei(0, GL_DST_COLOR, GL_ZERO, GL_ONE_MINUS_DST_ALPHA, GL_SRC_COLOR);
    glBlendEquationSeparatei(0, GL_MAX, GL_FUNC_REVERSE_SUBTRACT);
    glDisablei(GL_BLEND, 0);
}

int hair_test_blend_end(void)
{
    GLint factor[4], equation[2];
    GLboolean writes;
    glGetIntegeri_v(GL_BLEND_SRC_RGB, 0, &factor[0]), glGetIntegeri_v(GL_BLEND_DST_RGB, 0, &factor[1]);
    glGetIntegeri_v(GL_BLEND_SRC_ALPHA, 0, &factor[2]), glGetIntegeri_v(GL_BLEND_DST_ALPHA, 0, &factor[3]);
    glGetIntegeri_v(GL_BLEND_EQUATION_RGB, 0, &equation[0]);
    glGetIntegeri_v(GL_BLEND_EQUATION_ALPHA, 0, &equation[1]);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &writes);
    int same = factor[0] == GL_DST_COLOR && factor[1] == GL_ZERO && factor[2] == GL_ONE_MINUS_DST_ALPHA &&
               factor[3] == GL_SRC_COLOR && equation[0] == GL_MAX && equation[1] == GL_FUNC_REVERSE_SUBTRACT;
    same = same && writes && !glIsEnabledi(GL_BLEND, 0);
    glBlendFunc(GL_ONE, GL_ZERO);
    glBlendEquation(GL_FUNC_ADD);
    return same;
}
