// frame.h - a framebuffer to draw into, its pixels, and PNG files of them.
#ifndef HAIR_TESTS_SUPPORT_FRAME_H
#define HAIR_TESTS_SUPPORT_FRAME_H

#include <epoxy/gl.h>

struct hair_test_frame {
    GLsizei width, height, samples;
    GLenum format;
    GLuint framebuffer; // draw framebuffer
    GLuint resolved; // read framebuffer. It equals `framebuffer` if `samples` is 0.
    GLuint color[2], depth[2];
};

// Make a frame and bind it, with its viewport set, cleared to black and to depth 1. `format` is
// GL_RGBA32F, GL_RGBA8 or GL_RGBA32UI. `samples` is 0 or 4.
void hair_test_frame_make(struct hair_test_frame* frame, GLsizei width, GLsizei height, GLenum format,
                          GLsizei samples);
// Clear the frame to black and to depth 1.
void hair_test_frame_clear(const struct hair_test_frame* frame);
void hair_test_frame_free(struct hair_test_frame* frame);

// Read four floats per pixel, lower row first. The frame is bound again afterwards.
void hair_test_frame_read(const struct hair_test_frame* frame, float* pixels);
// Read one float per pixel, from a frame without samples.
void hair_test_frame_read_depth(const struct hair_test_frame* frame, float* depths);

// Set up the blending of the first draw buffer as an application may have it, but disabled.
void hair_test_blend_begin(void);
// Restore the blending. Return whether all of it was unchanged.
int hair_test_blend_end(void);

// Write RGBA of 8 bits, upper row first. Return 1 on success.
int hair_test_png_write(const char* path, int width, int height, const unsigned char* pixels);
// Read RGBA of 8 bits, upper row first. Return 1 on success. The caller frees *pixels.
int hair_test_png_read(const char* path, int* width, int* height, unsigned char** pixels);

#endif
