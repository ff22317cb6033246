// frame_profiler.c - frame profiler. Passes are counted by their category of work, and consecutive
// passes of a category share a pair of timestamps.
#include "lib/gl/frame_profiler.h"

#include "lib/gl/commands.h"

#include <string.h>

static const char* const labels[] = {
#define CATEGORY(name, label) label,
#include "lib/gl/passes.inl"
};

const char* hair_gl_category_label(hair_gl_category category)
{
    HAIR_ASSERT((unsigned)category < HAIR_GL_CATEGORIES);
    return labels[category];
}

static hair_gl_category category_of(hair_gl_pass pass)
{
    if (pass & HAIR_GL_WITH(DEPTH))
        return pass & HAIR_GL_WITH(ALPHA_COVERAGE) ? HAIR_GL_CATEGORY_OPACITY : HAIR_GL_CATEGORY_DEPTH;
    return hair_gl_row_category(pass);
}

void hair_gl_profiler_next_frame(struct hair_gl_profiler* profiler)
{
    struct hair_gl_frame* frame = hair_gl_profiler_frame(profiler, ++profiler->number);
    frame->number = profiler->number;
    frame->spans = 0;
    frame->is_full = false;
    memset(frame->runs, 0, sizeof frame->runs);
}

void hair_gl_profiler_undo(struct hair_gl_profiler* profiler, const struct hair_gl_profiler* was)
{
    struct hair_gl_profiler now = *profiler;
    *profiler = *was;
    for (int i = 0; i < HAIR_GL_FRAMES; ++i)
        memcpy(profiler->frame[i].query, now.frame[i].query, sizeof now.frame[i].query);
}

void hair_gl_profiler_free(struct hair_gl* gl, struct hair_gl_profiler* profiler)
{
    for (int i = 0; i < HAIR_GL_FRAMES; ++i)
        if (profiler->frame[i].query[0][0]) gl->DeleteQueries(2 * HAIR_GL_SPANS, profiler->frame[i].query[0]);
    memset(profiler, 0, sizeof *profiler);
}

void hair_gl_profiler_count(struct hair_gl_profiler* profiler, hair_gl_pass pass)
{
    struct hair_gl_frame* frame = hair_gl_profiler_frame(profiler, profiler->number);
    hair_gl_category category = category_of(pass);
    HAIR_ASSERT(frame->number == profiler->number && frame->spans <= HAIR_GL_SPANS);
    ++frame->runs[category];
    frame->pass[category] = pass;
}

void hair_gl_profiler_begin(struct hair_gl* gl, hair_gl_pass pass)
{
    if (!gl->profiler) return;
    struct hair_gl_frame* frame = hair_gl_profiler_frame(gl->profiler, gl->profiler->number);
    hair_gl_category category = category_of(pass);
    hair_gl_profiler_count(gl->profiler, pass);
    int same = frame->spans > 0 && frame->category[frame->spans - 1] == category;
    frame->is_full |= !same && frame->spans == HAIR_GL_SPANS;
    if (!gl->timings || same || frame->is_full || hair_gl_is_recording(gl)) return;
    if (!frame->query[0][0]) gl->CreateQueries(GL_TIMESTAMP, 2 * HAIR_GL_SPANS, frame->query[0]);
    if (!frame->query[0][0]) return; // The driver has made no queries, so nothing is timed.
    gl->QueryCounter(frame->query[frame->spans][0], GL_TIMESTAMP);
    frame->category[frame->spans++] = category;
}

void hair_gl_profiler_end(struct hair_gl* gl, hair_gl_pass pass)
{
    if (!gl->profiler || !gl->timings || hair_gl_is_recording(gl)) return;
    struct hair_gl_frame* frame = hair_gl_profiler_frame(gl->profiler, gl->profiler->number);
    if (frame->spans > 0 && !frame->is_full && frame->category[frame->spans - 1] == category_of(pass))
        gl->QueryCounter(frame->query[frame->spans - 1][1], GL_TIMESTAMP);
}

static bool read_spans(struct hair_gl* gl, const struct hair_gl_frame* frame, int waits,
                       float ms[HAIR_GL_CATEGORIES])
{
    for (uint32_t i = frame->spans; i-- > 0;) { // The last span finishes last.
        GLuint64 there = 0, start = 0, end = 0;
        HAIR_ASSERT(frame->query[i][1] && frame->category[i] < HAIR_GL_CATEGORIES);
        if (!waits) gl->GetQueryObjectui64v(frame->query[i][1], GL_QUERY_RESULT_AVAILABLE, &there);
        if (!waits && !there) return false;
        gl->GetQueryObjectui64v(frame->query[i][1], GL_QUERY_RESULT, &end);
        gl->GetQueryObjectui64v(frame->query[i][0], GL_QUERY_RESULT, &start);
        ms[frame->category[i]] += (float)((double)(end - start) * 1e-6);
    }
    return true;
}

bool hair_gl_profiler_read(struct hair_gl* gl, const struct hair_gl_frame* frame, int waits,
                           float ms[HAIR_GL_CATEGORIES])
{
    memset(ms, 0, HAIR_GL_CATEGORIES * sizeof *ms);
    if (!frame->spans) return true;
    GLint buffer = hair_gl_begin_query_reads(gl);
    bool done = read_spans(gl, frame, waits, ms);
    hair_gl_end_query_reads(gl, buffer);
    return done;
}
