// frame_timer.h - frame timer: the GPU time of all calls of a frame on a context.
#ifndef HAIR_GL_FRAME_TIMER_H
#define HAIR_GL_FRAME_TIMER_H

#include "lib/gl/gl.h"

#define HAIR_GL_TIMED_FRAMES 4 // Frames that a GPU may lag behind, and the current one.
#define HAIR_GL_TIMED_CALLS 256 // Timed calls in a frame. Further calls are not timed.
#define HAIR_GL_NEW_TIMED_CALLS 16 // Calls whose queries are created together.

struct hair_gl_timed_frame {
    uint32_t created; // Calls that have queries.
    uint32_t calls;
    GLuint query[HAIR_GL_TIMED_CALLS][2]; // Start and end of each call.
};

struct hair_gl_frame_timer {
    uint32_t number; // Number of the current frame.
    uint32_t read; // Number of the newest frame that was read or given up.
    bool is_running;
    struct hair_gl_timed_frame frame[HAIR_GL_TIMED_FRAMES];
};

// Begin the next frame, without calling OpenGL.
void hair_gl_frame_timer_next(struct hair_gl_frame_timer* timer);
// Begin and end a call. The timestamps are not recorded into streams of commands.
void hair_gl_frame_timer_begin(struct hair_gl* gl, struct hair_gl_frame_timer* timer);
void hair_gl_frame_timer_end(struct hair_gl* gl, struct hair_gl_frame_timer* timer);
// Read the oldest finished frame that was not read before, without waiting. Write its number and
// the sum of its calls in ms. Return false if there is none.
bool hair_gl_frame_timer_read(struct hair_gl* gl, struct hair_gl_frame_timer* timer, uint32_t* number,
                              double* ms);
// Forget all queries, which are of a lost OpenGL context.
void hair_gl_frame_timer_forget(struct hair_gl_frame_timer* timer);
void hair_gl_frame_timer_free(struct hair_gl* gl, struct hair_gl_frame_timer* timer);

#endif
