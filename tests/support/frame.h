// frame.h - something to draw into, its pixels, and pictures of them as PNG.
#ifndef HAIR_TESTS_SUPPORT_FRAME_H
#define HAIR_TESTS_SUPPORT_FRAME_H

#include <epoxy/gl.h>

struct hair_test_frame {
    GLsizei width, height, samples;
    GLuint framebuffer; // what is drawn into
    GLuint resolved; // what is read from: the same when samples is 0
    GLuint color[2], depth[2];
};

// `format`: GL_RGBA32F or GL_RGBA8. `samples`: 0 or 4. Bound, its viewport set, cleared to black, depth 1.
void hair_test_frame_make(struct hair_test_frame* frame, GLsizei width, GLsizei height, GLenum format,
                          GLsizei samples);
// To the same again.
void hair_test_frame_clear(const struct hair_test_frame* frame);
void hair_test_frame_free(struct hair_test_frame* frame);

// Four floats a pixel, the lower row first. The frame is bound again afterwards.
void hair_test_frame_read(const struct hair_test_frame* frame, float* pixels);
// One float a pixel, of a frame without samples.
void hair_test_frame_read_depth(const struct hair_test_frame* frame, float* depths);

// A host's blending of the first draw buffer, set up but off: begun, and whether all of it is still as it was, which ends it.
void hair_test_blend_begin(void);
int hair_test_blend_end(void);

// RGBA of 8 bits, the upper row first. 1 when it was done.
int hair_test_png_write(const char* path, int width, int height, const unsigned char* pixels);
// The same; the caller frees *pixels.
int hair_test_png_read(const char* path, int* width, int* height, unsigned char** pixels);

#endif
