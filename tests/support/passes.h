// passes.h - the program of a pass, or 0 without one, and the number of its runs.
#ifndef TESTS_PASSES_H
#define TESTS_PASSES_H

#include "tests/support/support.h" // before what includes OpenGL's own header

#include <string.h>

#include "lib/gl/gl.h"

static inline GLuint hair_test_program(const struct hair_gl* gl, hair_gl_pass pass)
{
    const struct hair_gl_program* own = hair_gl_find(gl, pass);
    return own ? own->program : 0;
}

static inline uint32_t hair_test_runs(const struct hair_gl* gl, hair_gl_pass pass)
{
    const struct hair_gl_program* own = hair_gl_find(gl, pass);
    return own ? own->timer.begun : 0;
}

static inline uint32_t hair_test_count_programs(const struct hair_gl* gl)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < gl->programs; ++i) count += gl->program[i]->program != 0;
    return count;
}

// Return the number of runs of all passes whose labels contain `words`.
static inline uint32_t hair_test_runs_of(const struct hair_gl* gl, const char* words)
{
    uint32_t runs = 0;
    for (uint32_t i = 0; i < gl->programs; ++i)
        if (strstr(gl->program[i]->label, words)) runs += gl->program[i]->timer.begun;
    return runs;
}

#endif
