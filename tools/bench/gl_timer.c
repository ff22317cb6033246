// gl_timer.c - Durations of single dispatches and draws.
#include "tools/bench/gl_timer.h"

#include <epoxy/gl.h>
#include <hair/hair_egl.h>
#include <stdio.h>
#include <string.h>

#include "tools/common/stats.h"

static struct bench_gl_longest longest[2]; // dispatch, draw
static char pass[128];
static double begun;

static void begin(void)
{
    glFinish();
    begun = hair_now();
}

static void end(int draw)
{
    glFinish();
    double ms = hair_now() - begun;
    struct bench_gl_longest* most = &longest[draw];
    ++most->count;
    if (ms <= most->ms) return;
    most->ms = ms;
    memcpy(most->pass, pass, sizeof pass);
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
    memset(longest, 0, sizeof longest);
}

struct bench_gl_longest bench_gl_longest_dispatch(void)
{
    return longest[0];
}

struct bench_gl_longest bench_gl_longest_draw(void)
{
    return longest[1];
}
