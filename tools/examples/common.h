// common.h - Helpers of the examples for errors, haircuts, GLSL programs, and pictures. Pictures
// are drawn off-screen and written as PPM files. Nothing here is part of the library.
#ifndef TOOLS_EXAMPLES_COMMON_H
#define TOOLS_EXAMPLES_COMMON_H

#include <epoxy/gl.h>
#include <hair/hair_asset.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Stop the program with a message.
static inline void fail(const char* message)
{
    fprintf(stderr, "%s\n", message);
    exit(EXIT_FAILURE);
}

// Stop the program unless a call of the library succeeded.
static inline void check(hair_result result)
{
    if (result) fail(hair_result_string(result));
}

// Print warnings and errors of the library. For hair_host.log.
static inline void print_sentence(hair_log_level level, const char* sentence, void* user)
{
    (void)user;
    if (level != HAIR_LOG_INFO) fprintf(stderr, "hair: %s\n", sentence);
}

// Make a groom of a built-in haircut. offscreen.c explains the steps.
static inline hair_groom* make_groom(hair_style haircut, uint32_t followers)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_style_desc style = hair_style_desc_default();
    style.style = haircut;
    check(hair_asset_generate(&style, &asset));
    hair_groom_desc desc = hair_groom_desc_default();
    check(hair_asset_to_groom_desc(asset, &desc));
    desc.follower_count = followers;
    check(hair_groom_create(&desc, &groom));
    hair_asset_destroy(asset);
    return groom;
}

// Compile and link a program. Stop with the driver's message on an error.
static inline GLuint make_program(const char* vertex_text, const char* fragment_text)
{
    const GLenum stages[2] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER};
    const char* texts[2] = {vertex_text, fragment_text};
    GLuint program = glCreateProgram();
    GLint linked;
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(stages[i]);
        glShaderSource(shader, 1, &texts[i], NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fail("A program of the example does not link.");
    return program;
}

// Write the framebuffer bound for reading. PPM rows run from top to bottom.
static inline void write_ppm(const char* path, int width, int height)
{
    unsigned char* pixels = (unsigned char*)malloc((size_t)3 * (size_t)width * (size_t)height);
    FILE* file = fopen(path, "wb");
    if (!pixels || !file) fail("The picture cannot be written.");
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels);
    fprintf(file, "P6\n%d %d\n255\n", width, height);
    for (int y = height; y-- > 0;) fwrite(pixels + (size_t)3 * (size_t)(y * width), 3, (size_t)width, file);
    if (fclose(file)) fail("The picture cannot be written.");
    free(pixels);
}

// A framebuffer of 4 samples a pixel, and one of single samples to read from.
struct picture {
    int width, height;
    GLuint framebuffers[2], renderbuffers[3];
};

// Create a picture of 4 to 3 and begin to draw into it. Colours are linear and stored as sRGB.
static inline struct picture picture_begin(int width)
{
    struct picture picture = {width, width * 3 / 4, {0, 0}, {0, 0, 0}};
    const GLsizei samples[3] = {4, 4, 0};
    const GLenum formats[3] = {GL_SRGB8_ALPHA8, GL_DEPTH_COMPONENT32F, GL_SRGB8_ALPHA8};
    const GLenum attachments[3] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT, GL_COLOR_ATTACHMENT0};
    glCreateFramebuffers(2, picture.framebuffers);
    glCreateRenderbuffers(3, picture.renderbuffers);
    for (int i = 0; i < 3; ++i) {
        glNamedRenderbufferStorageMultisample(picture.renderbuffers[i], samples[i], formats[i], picture.width,
                                              picture.height);
        glNamedFramebufferRenderbuffer(picture.framebuffers[i / 2], attachments[i], GL_RENDERBUFFER,
                                       picture.renderbuffers[i]);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffers[0]);
    glViewport(0, 0, picture.width, picture.height);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.16f, 0.19f, 0.24f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    return picture;
}

// Average the samples, write the picture and delete it.
static inline void picture_end(struct picture* picture, const char* path)
{
    glBlitNamedFramebuffer(picture->framebuffers[0], picture->framebuffers[1], 0, 0, picture->width,
                           picture->height, 0, 0, picture->width, picture->height, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, picture->framebuffers[1]);
    write_ppm(path, picture->width, picture->height);
    glDeleteFramebuffers(2, picture->framebuffers);
    glDeleteRenderbuffers(3, picture->renderbuffers);
}

#endif
