// frame_profiler.h - frame profiler: the passes of an instance in the last frames and their
// durations.
#ifndef HAIR_GL_FRAME_PROFILER_H
#define HAIR_GL_FRAME_PROFILER_H

#include "lib/gl/gl.h"

#include <stdbool.h>

#define HAIR_GL_FRAMES 4 // Frames that a GPU may lag behind, and the current one.
#define HAIR_GL_SPANS 32 // Timed spans in a frame. Further work is counted, but not timed.

struct hair_gl_frame {
    uint32_t number; // Number of the frame, from 1.
    uint32_t runs[HAIR_GL_CATEGORIES];
    hair_gl_pass pass[HAIR_GL_CATEGORIES]; // Last pass that ran, per category.
    uint32_t spans;
    bool is_full; // Passes after the last span are not timed.
    hair_gl_category category[HAIR_GL_SPANS]; // Category of each span of consecutive passes.
    GLuint query[HAIR_GL_SPANS][2]; // Start and end of each span. 0 until something is timed.
};

struct hair_gl_profiler {
    struct hair_gl_frame frame[HAIR_GL_FRAMES];
    uint32_t number; // Number of the current frame.
};

const char* hair_gl_category_label(hair_gl_category category);

// Begin the next frame, without calling OpenGL.
void hair_gl_profiler_next_frame(struct hair_gl_profiler* profiler);
// Undo the frames that have begun since `was` was copied. Keep the queries made since.
void hair_gl_profiler_undo(struct hair_gl_profiler* profiler, const struct hair_gl_profiler* was);
void hair_gl_profiler_free(struct hair_gl* gl, struct hair_gl_profiler* profiler);

static inline struct hair_gl_frame* hair_gl_profiler_frame(struct hair_gl_profiler* profiler, uint32_t number)
{
    return &profiler->frame[number % HAIR_GL_FRAMES];
}

// Count a run of a pass that is not timed.
void hair_gl_profiler_count(struct hair_gl_profiler* profiler, hair_gl_pass pass);
// Begin a pass. Do nothing if gl->profiler is NULL.
void hair_gl_profiler_begin(struct hair_gl* gl, hair_gl_pass pass);
// End a pass.
void hair_gl_profiler_end(struct hair_gl* gl, hair_gl_pass pass);

// Read the durations of a frame's work, in ms. Return false if the frame is unfinished, which
// cannot happen if `waits` is nonzero.
bool hair_gl_profiler_read(struct hair_gl* gl, const struct hair_gl_frame* frame, int waits,
                           float ms[HAIR_GL_CATEGORIES]);

#endif
