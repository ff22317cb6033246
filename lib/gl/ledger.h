// ledger.h - what an instance has had done in its last frames, and how long that took.
#ifndef HAIR_GL_LEDGER_H
#define HAIR_GL_LEDGER_H

#include "lib/gl/gl.h"

typedef enum hair_gl_work {
#define WORK(name, label, begins) HAIR_GL_WORK_##name,
#include "lib/gl/works.inl"
#undef WORK
    HAIR_GL_WORKS
} hair_gl_work;

#define HAIR_GL_FRAMES 4 // that a GPU may be behind, and the one under way
#define HAIR_GL_SPANS 32 // of time in a frame; work that is done beyond is counted but not timed

struct hair_gl_frame {
    uint32_t number; // from 1
    uint32_t runs[HAIR_GL_WORKS];
    hair_gl_pass pass[HAIR_GL_WORKS]; // the last that ran
    uint32_t spans;
    hair_gl_work work[HAIR_GL_SPANS]; // passes that follow each other and belong to the same
    GLuint query[HAIR_GL_SPANS][2]; // start and end; 0 until something is timed
};

struct hair_gl_ledger {
    struct hair_gl_frame frame[HAIR_GL_FRAMES];
    uint32_t number; // of the frame under way
};

const char* hair_gl_work_label(hair_gl_work work);

// The next frame begins. No OpenGL.
void hair_gl_ledger_next(struct hair_gl_ledger* ledger);
void hair_gl_ledger_free(struct hair_gl* gl, struct hair_gl_ledger* ledger);

static inline struct hair_gl_frame* hair_gl_ledger_frame(struct hair_gl_ledger* ledger, uint32_t number)
{
    return &ledger->frame[number % HAIR_GL_FRAMES];
}

// Bracket a pass, if gl->ledger is there.
void hair_gl_ledger_begin(struct hair_gl* gl, hair_gl_pass pass);
void hair_gl_ledger_end(struct hair_gl* gl, hair_gl_pass pass);

// Times of the work of a frame, ms. 0: it has not been finished yet, unless that is waited for.
int hair_gl_ledger_read(struct hair_gl* gl, const struct hair_gl_frame* frame, int waits,
                        float ms[HAIR_GL_WORKS]);

#endif
