// draw_state.h - the state of the application that draws obey. A call that draws many instances
// reads it once, because each question takes the processor about as long as a binding.
#ifndef HAIR_GL_DRAW_STATE_H
#define HAIR_GL_DRAW_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "glsl/shared.h"

struct hair_gl;

struct hair_gl_draw_state {
    float viewport[4]; // Lower left corner and size, pixels.
    float depth_range[2];
    uint32_t depth_function; // Function of the depth test, an enum of OpenGL.
    bool tests_depth, clamps_depth;
    bool is_zero_to_one; // Depth in clip space is in [0, 1], and not in [-1, 1].
    bool is_upside_down; // The origin of clip space is the upper left corner.
    bool multisamples; // The samples of a pixel are drawn one by one.
    uint32_t samples; // Samples of a pixel of the framebuffer. 0 without a multisample buffer.
    float sample[HAIR_RASTER_SAMPLES][2]; // Their positions in a pixel, if it multisamples.
};

// Read the state into hair_gl.draw_state.
void hair_gl_read_draw_state(struct hair_gl* gl);

#endif
