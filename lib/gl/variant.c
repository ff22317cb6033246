// variant.c - passes that are compiled otherwise than their rows say: with more definitions, or with the host's text in
// place of own.glsl. Only what is asked for is compiled, and has memory.
#include "lib/gl/gl.h"

#include <stdio.h>
#include <string.h>

hair_result hair_gl_make_shader(struct hair_gl* gl, const char* label, const char* text, int pixels,
                                struct hair_gl_shader* out)
{
    size_t name = strlen(label) + 1, size = strlen(text) + 1;
    out->label = hair_alloc(&gl->host, name, 1);
    out->text  = hair_alloc(&gl->host, size, 1);
    if (!out->label || !out->text) return hair_fail_memory(&gl->host, "a shader's text");
    memcpy(out->label, label, name);
    memcpy(out->text, text, size);
    out->pixels = pixels;
    return HAIR_OK;
}

static void free_programs(struct hair_gl* gl, struct hair_gl_shader* shader)
{
    for (int i = 0; i < HAIR_GL_VARIANTS * HAIR_GL_DRAWN; ++i)
        if (shader->program[i / HAIR_GL_DRAWN][i % HAIR_GL_DRAWN])
            gl->DeleteProgram(shader->program[i / HAIR_GL_DRAWN][i % HAIR_GL_DRAWN]);
    memset(shader->program, 0, sizeof shader->program);
}

void hair_gl_free_shader(struct hair_gl* gl, struct hair_gl_shader* shader)
{
    free_programs(gl, shader);
    hair_free(&gl->host, shader->label);
    hair_free(&gl->host, shader->text);
    memset(shader, 0, sizeof *shader);
}

static size_t define(char* prefix, size_t used, size_t size, const char* name)
{
    return used + (size_t)snprintf(prefix + used, size - used, "#define %s 1\n", name);
}

void hair_gl_write_variant(const struct hair_gl_shader* shader, uint32_t bits, char* out, size_t size)
{
    static const char* const names[] = {"HAIR_TINTED", "HAIR_IDS", "HAIR_MOTION", "HAIR_SHARES",
                                        "HAIR_PAINTED"};
    size_t                   used    = 0;
    *out                             = 0;
    for (uint32_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (bits >> i & 1) used = define(out, used, size, names[i]);
    if (shader->text) define(out, used, size, shader->pixels ? "HAIR_OWN_PIXELS" : "HAIR_OWN_VERTICES");
}

hair_result hair_gl_need_variant(struct hair_gl* gl, struct hair_gl_shader* shader, uint32_t bits,
                                 hair_gl_pass pass, GLuint* out)
{
    GLuint* program = &shader->program[bits][pass - HAIR_GL_TESSELLATED_RIBBONS];
    if (shader->made != gl->made) free_programs(gl, shader); // All shaders have been compiled anew.
    shader->made       = gl->made;
    hair_result result = HAIR_OK;
    if (!*program) result = hair_gl_link_variant(gl, shader, bits, pass, program);
    *out = *program;
    return result;
}
