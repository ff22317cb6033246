// ledger.c - frame profiler. Passes are counted by their category of work, and consecutive passes
// of a category share a pair of timestamps.
#include "lib/gl/ledger.h"

#include <string.h>

static const struct {
    const char* label;
    const char* begins;
} works[] = {
#define WORK(name, label, begins) {label, begins},
#include "lib/gl/works.inl"
#undef WORK
};

const char* hair_gl_work_label(hair_gl_work work)
{
    HAIR_ASSERT((unsigned)work < HAIR_GL_WORKS);
    return works[work].label;
}

static hair_gl_work work_of(hair_gl_pass pass)
{
    const char* label = hair_gl_row_label(pass);
    if (pass & HAIR_GL_WITH(DEPTH))
        return pass & HAIR_GL_WITH(SHARES) ? HAIR_GL_WORK_OPACITY : HAIR_GL_WORK_DEPTH;
    int work = 0;
    while (work < HAIR_GL_WORK_COLOR && strncmp(label, works[work].begins, strlen(works[work].begins)) != 0)
        ++work;
    return (hair_gl_work)work;
}

void hair_gl_ledger_next(struct hair_gl_ledger* ledger)
{
    struct hair_gl_frame* frame = hair_gl_ledger_frame(ledger, ++ledger->number);
    frame->number = ledger->number;
    frame->spans = 0;
    memset(frame->runs, 0, sizeof frame->runs);
}

void hair_gl_ledger_free(struct hair_gl* gl, struct hair_gl_ledger* ledger)
{
    for (int i = 0; i < HAIR_GL_FRAMES; ++i)
        if (ledger->frame[i].query[0][0]) gl->DeleteQueries(2 * HAIR_GL_SPANS, ledger->frame[i].query[0]);
    memset(ledger, 0, sizeof *ledger);
}

void hair_gl_ledger_begin(struct hair_gl* gl, hair_gl_pass pass)
{
    if (!gl->ledger) return;
    struct hair_gl_frame* frame = hair_gl_ledger_frame(gl->ledger, gl->ledger->number);
    hair_gl_work work = work_of(pass);
    HAIR_ASSERT(frame->number == gl->ledger->number && frame->spans <= HAIR_GL_SPANS);
    ++frame->runs[work];
    frame->pass[work] = pass;
    int same = frame->spans > 0 && frame->work[frame->spans - 1] == work;
    if (!gl->timings || same || frame->spans == HAIR_GL_SPANS) return;
    if (!frame->query[0][0]) gl->CreateQueries(GL_TIMESTAMP, 2 * HAIR_GL_SPANS, frame->query[0]);
    gl->QueryCounter(frame->query[frame->spans][0], GL_TIMESTAMP);
    frame->work[frame->spans++] = work;
}

void hair_gl_ledger_end(struct hair_gl* gl, hair_gl_pass pass)
{
    if (!gl->ledger || !gl->timings) return;
    struct hair_gl_frame* frame = hair_gl_ledger_frame(gl->ledger, gl->ledger->number);
    if (frame->spans > 0 && frame->work[frame->spans - 1] == work_of(pass))
        gl->QueryCounter(frame->query[frame->spans - 1][1], GL_TIMESTAMP);
}

static bool read_spans(struct hair_gl* gl, const struct hair_gl_frame* frame, int waits,
                       float ms[HAIR_GL_WORKS])
{
    for (uint32_t i = frame->spans; i-- > 0;) { // The last span finishes last.
        GLuint64 there = 0, start = 0, end = 0;
        HAIR_ASSERT(frame->query[i][1] && frame->work[i] < HAIR_GL_WORKS);
        if (!waits) gl->GetQueryObjectui64v(frame->query[i][1], GL_QUERY_RESULT_AVAILABLE, &there);
        if (!waits && !there) return false;
        gl->GetQueryObjectui64v(frame->query[i][1], GL_QUERY_RESULT, &end);
        gl->GetQueryObjectui64v(frame->query[i][0], GL_QUERY_RESULT, &start);
        ms[frame->work[i]] += (float)((double)(end - start) * 1e-6);
    }
    return true;
}

bool hair_gl_ledger_read(struct hair_gl* gl, const struct hair_gl_frame* frame, int waits,
                         float ms[HAIR_GL_WORKS])
{
    GLint buffer = 0; // An application's query buffer would receive the results, as in pass.c.
    memset(ms, 0, HAIR_GL_WORKS * sizeof *ms);
    if (!frame->spans) return true;
    gl->GetIntegerv(GL_QUERY_BUFFER_BINDING, &buffer);
    if (buffer) gl->BindBuffer(GL_QUERY_BUFFER, 0);
    int done = read_spans(gl, frame, waits, ms);
    if (buffer) gl->BindBuffer(GL_QUERY_BUFFER, (GLuint)buffer);
    return done;
}
