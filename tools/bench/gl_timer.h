// gl_timer.h - Durations of single dispatches and draws. A context that is made with
// bench_gl_timer_proc() waits for the GPU before and after each of them.
#ifndef HAIR_TOOLS_BENCH_GL_TIMER_H
#define HAIR_TOOLS_BENCH_GL_TIMER_H

#include <stdbool.h>

// The longest dispatch or draw of the last frame. Each has the least duration of all frames since
// the last clear, which have the same dispatches and draws.
struct bench_gl_longest {
    char pass[128]; // label of its pass
    double ms;
    unsigned count; // number of all dispatches or draws of the frame
};

// Return an OpenGL function, as hair_context_desc.get_proc does.
void* bench_gl_timer_proc(const char* name, void* user);
// Forget all frames.
void bench_gl_timer_clear(void);
void bench_gl_timer_begin_frame(void);
struct bench_gl_longest bench_gl_longest_dispatch(void);
struct bench_gl_longest bench_gl_longest_draw(void);

#endif
