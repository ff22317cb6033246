// pass.c - running a pass: its program, a debug group with its name, its timer, its barrier.
#include "lib/gl/ledger.h"

#define MAX_GROUPS 65535 // In one dimension: what OpenGL promises.

void hair_gl_begin(struct hair_gl* gl, hair_gl_pass pass)
{
    gl->PushDebugGroup(GL_DEBUG_SOURCE_THIRD_PARTY, (GLuint)pass, -1, hair_gl_pass_label(pass));
    struct hair_gl_timer* timer = &gl->timer[pass];
    // Time stamps rather than an elapsed-time query, of which the host may have one under way.
    if (gl->timings) {
        if (!timer->query[0][0]) gl->CreateQueries(GL_TIMESTAMP, 2 * HAIR_GL_TIMER_DEPTH, timer->query[0]);
        hair_gl_pass_ms(gl, pass); // Before the slot is used again.
        gl->QueryCounter(timer->query[timer->begun % HAIR_GL_TIMER_DEPTH][0], GL_TIMESTAMP);
    }
    hair_gl_ledger_begin(gl, pass);
    gl->UseProgram(gl->program[pass]);
}

void hair_gl_end(struct hair_gl* gl, hair_gl_pass pass)
{
    struct hair_gl_timer* timer = &gl->timer[pass];
    hair_gl_ledger_end(gl, pass);
    if (gl->timings) gl->QueryCounter(timer->query[timer->begun % HAIR_GL_TIMER_DEPTH][1], GL_TIMESTAMP);
    ++timer->begun;
    gl->PopDebugGroup();
}

void hair_gl_run(struct hair_gl* gl, hair_gl_pass pass, uint32_t groups)
{
    if (groups == 0) return;
    uint32_t rows = (groups + MAX_GROUPS - 1) / MAX_GROUPS;
    hair_gl_begin(gl, pass);
    gl->DispatchCompute(rows > 1 ? MAX_GROUPS : groups, rows, 1);
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                      GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT);
    hair_gl_end(gl, pass);
}

hair_gl_pass hair_gl_pass_for(hair_gl_pass smallest, uint32_t vertices)
{
    return smallest + (vertices > 32) + (vertices > 64) + (vertices > 128);
}

static void read_timer(struct hair_gl* gl, struct hair_gl_timer* timer)
{
    if (timer->begun - timer->read > HAIR_GL_TIMER_DEPTH) timer->read = timer->begun - HAIR_GL_TIMER_DEPTH;
    for (; timer->read < timer->begun; ++timer->read) {
        const GLuint* query = timer->query[timer->read % HAIR_GL_TIMER_DEPTH];
        GLuint64      there = 0, start = 0, end = 0;
        gl->GetQueryObjectui64v(query[1], GL_QUERY_RESULT_AVAILABLE, &there);
        if (!there) break;
        gl->GetQueryObjectui64v(query[0], GL_QUERY_RESULT, &start);
        gl->GetQueryObjectui64v(query[1], GL_QUERY_RESULT, &end);
        timer->ms = (float)((double)(end - start) * 1e-6);
        timer->total += (double)(end - start) * 1e-6;
    }
}

float hair_gl_pass_ms(struct hair_gl* gl, hair_gl_pass pass)
{
    struct hair_gl_timer* timer = &gl->timer[pass];
    if (!timer->query[0][0]) return 0;
    GLint buffer = 0; // While the host has one bound, results go there instead.
    gl->GetIntegerv(GL_QUERY_BUFFER_BINDING, &buffer);
    if (buffer) gl->BindBuffer(GL_QUERY_BUFFER, 0);
    read_timer(gl, timer);
    if (buffer) gl->BindBuffer(GL_QUERY_BUFFER, (GLuint)buffer);
    return timer->ms;
}

void hair_gl_free_timers(struct hair_gl* gl)
{
    for (int pass = 0; pass < HAIR_GL_PASS_COUNT; ++pass)
        if (gl->timer[pass].query[0][0]) gl->DeleteQueries(2 * HAIR_GL_TIMER_DEPTH, gl->timer[pass].query[0]);
}
