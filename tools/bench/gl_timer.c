// gl_timer.c - Durations of single dispatches and draws.
#include "tools/bench/gl_timer.h"

#include <epoxy/gl.h>
#include <hair/hair_egl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/stats.h"

// Least duration of a dispatch or a draw.
struct timing {
    char pass[128]; // label of its pass
    double ms;
    bool is_measured;
};

// Least durations of the dispatches or the draws of a frame, in their order.
struct timings {
    struct timing* least;
    unsigned count, room;
};

static struct timings timings[2]; // dispatches, draws
static char pass[128];
static double begun;

static void begin(void)
{
    glFinish();
    begun = hair_now();
}

// Keep the shorter of two durations, because a pause of the processor in one frame would count
// otherwise.
static void keep(struct timings* times, double ms)
{
    if (times->count == times->room) {
        unsigned room = times->room ? 2 * times->room : 256;
        struct timing* more = realloc(times->least, room * sizeof *more);
        if (!more) return;
        memset(more + times->room, 0, (room - times->room) * sizeof *more);
        times->least = more;
        times->room = room;
    }
    struct timing* least = &times->least[times->count++];
    bool is_other = !least->is_measured || strcmp(least->pass, pass);
    least->is_measured = true;
    if (is_other || ms < least->ms) least->ms = ms;
    memcpy(least->pass, pass, sizeof pass);
}

static void end(int draw)
{
    glFinish();
    keep(&timings[draw], hair_now() - begun);
}

static void APIENTRY push_group(GLenum source, GLuint id, GLsizei length, const GLchar* text)
{
    snprintf(pass, sizeof pass, "%s", text);
    glPushDebugGroup(source, id, length, text);
}

static void APIENTRY dispatch(GLuint x, GLuint y, GLuint z)
{
    begin();
    glDispatchCompute(x, y, z);
    end(0);
}

static void APIENTRY dispatch_indirect(GLintptr at)
{
    begin();
    glDispatchComputeIndirect(at);
    end(0);
}

static void APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    begin();
    glDrawArrays(mode, first, count);
    end(1);
}

static void APIENTRY draw_instanced(GLenum mode, GLint first, GLsizei count, GLsizei instances)
{
    begin();
    glDrawArraysInstanced(mode, first, count, instances);
    end(1);
}

static void APIENTRY draw_indirect(GLenum mode, GLenum type, const void* at, GLsizei count, GLsizei stride)
{
    begin();
    glMultiDrawElementsIndirect(mode, type, at, count, stride);
    end(1);
}

void* bench_gl_timer_proc(const char* name, void* user)
{
    static const struct {
        const char* name;
        void (*function)(void);
    } own[] = {
        {"glPushDebugGroup", (void (*)(void))push_group},
        {"glDispatchCompute", (void (*)(void))dispatch},
        {"glDispatchComputeIndirect", (void (*)(void))dispatch_indirect},
        {"glDrawArrays", (void (*)(void))draw_arrays},
        {"glDrawArraysInstanced", (void (*)(void))draw_instanced},
        {"glMultiDrawElementsIndirect", (void (*)(void))draw_indirect},
    };
    void* address = hair_egl_get_proc(name, user);
    for (size_t i = 0; i < sizeof own / sizeof *own; ++i)
        if (strcmp(own[i].name, name) == 0) memcpy(&address, &own[i].function, sizeof address);
    return address;
}

void bench_gl_timer_clear(void)
{
    for (int draw = 0; draw < 2; ++draw) {
        free(timings[draw].least);
        timings[draw] = (struct timings){0};
    }
}

void bench_gl_timer_begin_frame(void)
{
    timings[0].count = timings[1].count = 0;
}

static struct bench_gl_longest longest(const struct timings* times)
{
    struct bench_gl_longest found = {.count = times->count};
    for (unsigned i = 0; i < times->count; ++i) {
        const struct timing* timing = &times->least[i];
        if (timing->ms < found.ms) continue;
        found.ms = timing->ms;
        memcpy(found.pass, timing->pass, sizeof found.pass);
    }
    return found;
}

struct bench_gl_longest bench_gl_longest_dispatch(void)
{
    return longest(&timings[0]);
}

struct bench_gl_longest bench_gl_longest_draw(void)
{
    return longest(&timings[1]);
}
