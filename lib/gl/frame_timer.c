// frame_timer.c - frame timer. Each call has a pair of timestamps, so that work of the application
// between two calls does not count.
#include "lib/gl/frame_timer.h"

#include "lib/gl/commands.h"

#include <string.h>

static struct hair_gl_timed_frame* timed_frame_of(struct hair_gl_frame_timer* timer, uint32_t number)
{
    return &timer->frame[number % HAIR_GL_TIMED_FRAMES];
}

void hair_gl_frame_timer_next(struct hair_gl_frame_timer* timer)
{
    HAIR_ASSERT(!timer->is_running);
    timed_frame_of(timer, ++timer->number)->calls = 0;
    if (timer->number - timer->read >= HAIR_GL_TIMED_FRAMES)
        timer->read = timer->number - HAIR_GL_TIMED_FRAMES; // The queries of that frame are reused.
}

// Create queries for more calls of a frame. Return false if there are none.
static bool add_queries(struct hair_gl* gl, struct hair_gl_timed_frame* frame)
{
    if (frame->created == HAIR_GL_TIMED_CALLS) return false;
    GLuint* first = frame->query[frame->created];
    gl->CreateQueries(GL_TIMESTAMP, 2 * HAIR_GL_NEW_TIMED_CALLS, first);
    if (!first[0]) return false;
    frame->created += HAIR_GL_NEW_TIMED_CALLS;
    return true;
}

void hair_gl_frame_timer_begin(struct hair_gl* gl, struct hair_gl_frame_timer* timer)
{
    struct hair_gl_timed_frame* frame = timed_frame_of(timer, timer->number);
    HAIR_ASSERT(!timer->is_running && !hair_gl_is_recording(gl));
    if (frame->calls == frame->created && !add_queries(gl, frame)) return;
    gl->QueryCounter(frame->query[frame->calls][0], GL_TIMESTAMP);
    timer->is_running = true;
}

void hair_gl_frame_timer_end(struct hair_gl* gl, struct hair_gl_frame_timer* timer)
{
    struct hair_gl_timed_frame* frame = timed_frame_of(timer, timer->number);
    HAIR_ASSERT(!hair_gl_is_recording(gl));
    if (!timer->is_running) return;
    gl->QueryCounter(frame->query[frame->calls++][1], GL_TIMESTAMP);
    timer->is_running = false;
}

// Sum the calls of a frame. Return false if the GPU has not finished the last.
static bool sum_calls(struct hair_gl* gl, const struct hair_gl_timed_frame* frame, double* ms)
{
    *ms = 0;
    for (uint32_t i = frame->calls; i-- > 0;) {
        GLuint64 there = 1, start = 0, end = 0;
        if (i + 1 == frame->calls)
            gl->GetQueryObjectui64v(frame->query[i][1], GL_QUERY_RESULT_AVAILABLE, &there);
        if (!there) return false;
        gl->GetQueryObjectui64v(frame->query[i][1], GL_QUERY_RESULT, &end);
        gl->GetQueryObjectui64v(frame->query[i][0], GL_QUERY_RESULT, &start);
        if (end > start) *ms += (double)(end - start) * 1e-6;
    }
    return true;
}

bool hair_gl_frame_timer_read(struct hair_gl* gl, struct hair_gl_frame_timer* timer, uint32_t* number,
                              double* ms)
{
    if (timer->read + 1 >= timer->number) return false; // The current frame has not ended.
    GLint buffer = hair_gl_begin_query_reads(gl);
    bool is_done = sum_calls(gl, timed_frame_of(timer, timer->read + 1), ms);
    hair_gl_end_query_reads(gl, buffer);
    if (is_done) *number = ++timer->read;
    return is_done;
}

void hair_gl_frame_timer_forget(struct hair_gl_frame_timer* timer)
{
    memset(timer->frame, 0, sizeof timer->frame);
    timer->read = timer->number; // The frames before have no times.
}

void hair_gl_frame_timer_free(struct hair_gl* gl, struct hair_gl_frame_timer* timer)
{
    for (int i = 0; i < HAIR_GL_TIMED_FRAMES; ++i)
        if (timer->frame[i].created)
            gl->DeleteQueries((GLsizei)(2 * timer->frame[i].created), timer->frame[i].query[0]);
    hair_gl_frame_timer_forget(timer);
}
