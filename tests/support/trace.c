// trace.c - wrappers around the functions of lib/gl/functions.inl.
#include "tests/support/trace.h"

#include <stdio.h>
#include <string.h>

#include <hair/hair_egl.h>

#include "lib/gl/gl.h"

enum function {
#define FUNCTION(type, name, parameters) CALL_##name,
#include "lib/gl/functions.inl"
#undef FUNCTION
    CALLS
};

static uint32_t counts[CALLS], waits, total;
static uint32_t losing_call; // Number of the first call that is lost. 0 if there is none.
static GLenum loss_status;
static int is_behind;
static void* reals[CALLS];

static const char* const names[] = {
#define FUNCTION(type, name, parameters) "gl" #name,
#include "lib/gl/functions.inl"
#undef FUNCTION
};

// Count a call, and return whether its context is lost.
static int is_lost(void)
{
    ++total;
    return losing_call && total >= losing_call;
}

// Wrappers with as many parameters as each function has. The table has only the types of
// parameters.
// clang-format off
#define CAT(a, b) CAT_(a, b)
#define CAT_(a, b) a##b
#define SECOND(a, b, ...) b
#define IS_NONE(...) IS_NONE_(CAT(NONE_, __VA_ARGS__))
#define IS_NONE_(...) SECOND(__VA_ARGS__, 0, 0)
#define NONE_void ~, 1
#define FIRST(a, ...) a
#define COUNT(...) COUNT_(__VA_ARGS__, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define COUNT_(a, b, c, d, e, f, g, h, i, j, k, n, ...) n
#define WITH_1(A) A a
#define WITH_2(A, B) WITH_1(A), B b
#define WITH_3(A, B, C) WITH_2(A, B), C c
#define WITH_4(A, B, C, D) WITH_3(A, B, C), D d
#define WITH_5(A, B, C, D, E) WITH_4(A, B, C, D), E e
#define WITH_6(A, B, C, D, E, F) WITH_5(A, B, C, D, E), F f
#define WITH_7(A, B, C, D, E, F, G) WITH_6(A, B, C, D, E, F), G g
#define WITH_8(A, B, C, D, E, F, G, H) WITH_7(A, B, C, D, E, F, G), H h
#define WITH_9(A, B, C, D, E, F, G, H, I) WITH_8(A, B, C, D, E, F, G, H), I i
#define WITH_10(A, B, C, D, E, F, G, H, I, J) WITH_9(A, B, C, D, E, F, G, H, I), J j
#define WITH_11(A, B, C, D, E, F, G, H, I, J, K) WITH_10(A, B, C, D, E, F, G, H, I, J), K k
#define PASS_1 a
#define PASS_2 PASS_1, b
#define PASS_3 PASS_2, c
#define PASS_4 PASS_3, d
#define PASS_5 PASS_4, e
#define PASS_6 PASS_5, f
#define PASS_7 PASS_6, g
#define PASS_8 PASS_7, h
#define PASS_9 PASS_8, i
#define PASS_10 PASS_9, j
#define PASS_11 PASS_10, k
#define FUNCTION(type, name, parameters) CAT(DEFINE_, IS_NONE(FIRST parameters))(type, name, parameters)
#define DEFINE_0(type, name, parameters)                                                  \
    DEFINE(type, name, parameters, CAT(WITH_, COUNT parameters) parameters,               \
           CAT(PASS_, COUNT parameters))
#define DEFINE_1(type, name, parameters) DEFINE(type, name, parameters, void, )
#define DEFINE(type, name, parameters, with, passed)          \
    static type APIENTRY call_##name(with)                    \
    {                                                         \
        type(APIENTRY* real) parameters;                      \
        memcpy(&real, &reals[CALL_##name], sizeof real);      \
        ++counts[CALL_##name];                                \
        if (is_lost()) return (type)0;                        \
        return real(passed);                                  \
    }
#include "lib/gl/functions.inl"
#undef FUNCTION
// clang-format on

// Count a wait for a fence. A query without a timeout waits for nothing.
static GLenum APIENTRY ask_sync(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    if (timeout > 0) ++waits;
    if (timeout == 0 && is_behind) return GL_TIMEOUT_EXPIRED;
    GLenum status = call_ClientWaitSync(sync, flags, timeout);
    return status ? status : GL_ALREADY_SIGNALED; // A lost context passes all fences.
}

static void APIENTRY ask_query(GLuint query, GLenum what, GLuint64* out)
{
    GLuint64 there = 1;
    if (what == GL_QUERY_RESULT) call_GetQueryObjectui64v(query, GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there) ++waits;
    *out = 1; // Queries of a lost context are available.
    call_GetQueryObjectui64v(query, what, out);
}

static GLenum APIENTRY ask_reset(void)
{
    GLenum status = call_GetGraphicsResetStatus();
    return losing_call && total >= losing_call ? loss_status : status;
}

static void APIENTRY read_buffer(GLuint buffer, GLintptr at, GLsizeiptr size, void* out)
{
    ++waits;
    call_GetNamedBufferSubData(buffer, at, size, out);
}

// Map a buffer. A persistent mapping is made only once, so it does not count.
static void* APIENTRY map_buffer(GLuint buffer, GLintptr at, GLsizeiptr size, GLbitfield access)
{
    if (!(access & GL_MAP_PERSISTENT_BIT)) ++waits;
    return call_MapNamedBufferRange(buffer, at, size, access);
}

void* hair_test_trace_proc(const char* name, void* user)
{
    static const struct {
        const char* name;
        void (*function)(void);
    } wrappers[] = {
        {"glClientWaitSync", (void (*)(void))ask_sync},
        {"glGetQueryObjectui64v", (void (*)(void))ask_query},
        {"glGetGraphicsResetStatus", (void (*)(void))ask_reset},
        {"glGetNamedBufferSubData", (void (*)(void))read_buffer},
        {"glMapNamedBufferRange", (void (*)(void))map_buffer},
#define FUNCTION(type, name, parameters) {"gl" #name, (void (*)(void))call_##name},
#include "lib/gl/functions.inl"
#undef FUNCTION
    };
    void* real = hair_egl_get_proc(name, user);
    for (int i = 0; i < CALLS; ++i)
        if (strcmp(names[i], name) == 0) reals[i] = real;
    for (size_t i = 0; real && i < sizeof wrappers / sizeof *wrappers; ++i) {
        if (strcmp(wrappers[i].name, name) != 0) continue;
        memcpy(&real, &wrappers[i].function, sizeof real);
        return real;
    }
    return real;
}

void hair_test_trace_clear(void)
{
    memset(counts, 0, sizeof counts);
    waits = total = 0;
}

void hair_test_trace_lose(uint32_t call, uint32_t status)
{
    losing_call = call;
    loss_status = status;
}

void hair_test_trace_hold(int behind)
{
    is_behind = behind;
}

uint32_t hair_test_trace_count(const char* begin)
{
    uint32_t count = 0;
    for (int i = 0; i < CALLS; ++i)
        if (strncmp(names[i], begin, strlen(begin)) == 0) count += counts[i];
    return count;
}

uint32_t hair_test_trace_waits(void)
{
    return waits;
}

const char* hair_test_trace_list(void)
{
    static char text[4096];
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < CALLS && used < sizeof text; ++i)
        if (counts[i])
            used += (size_t)snprintf(text + used, sizeof text - used, "%s %u, ", names[i], counts[i]);
    return text;
}
