// capture.h - transform feedback without rasterisation.
#ifndef HAIR_GL_CAPTURE_H
#define HAIR_GL_CAPTURE_H

#include "lib/gl/gl.h"

// Create a framebuffer without attachments. Transform feedback without rasterisation needs one,
// because every draw fails without a framebuffer.
GLuint hair_gl_blank_framebuffer(struct hair_gl* gl);
// State saved by hair_gl_begin_capture().
struct hair_gl_capture {
    GLint framebuffer, feedback;
    int discard;
};
// Return HAIR_ERROR_OPENGL if transform feedback of the application is active, paused or not. Mesa
// has one primitive mode for all transform feedback, and a capture would change the application's.
// `name` is what captures.
hair_result hair_gl_check_capture(const struct hair_gl* gl, const char* name);
// Begin transform feedback without rasterisation.
void hair_gl_begin_capture(struct hair_gl* gl, GLuint framebuffer, struct hair_gl_capture* was);
void hair_gl_end_capture(struct hair_gl* gl, const struct hair_gl_capture* was);

#endif
