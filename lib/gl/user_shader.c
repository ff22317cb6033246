// user_shader.c - programs with the application's text in place of light/user_shader.glsl. Only
// requested programs are compiled and take memory.
#include "lib/gl/gl.h"

#include <string.h>

hair_result hair_gl_create_shader(struct hair_gl* gl, const char* label, const char* text, int pixels,
                                  struct hair_gl_shader* out)
{
    HAIR_ASSERT(!out->label && !out->text && !out->programs);
    size_t name = strlen(label) + 1, size = strlen(text) + 1;
    out->label = hair_alloc(&gl->host, name, 1);
    out->text = hair_alloc(&gl->host, size, 1);
    if (!out->label || !out->text) return hair_fail_memory(&gl->host, "a shader's text");
    memcpy(out->label, label, name);
    memcpy(out->text, text, size);
    out->pixels = pixels;
    return HAIR_OK;
}

void hair_gl_free_shader_programs(struct hair_gl* gl, struct hair_gl_shader* shader)
{
    for (uint32_t i = 0; i < shader->count; ++i) hair_gl_delete_program(gl, shader->programs[i].program);
    shader->count = 0;
}

void hair_gl_free_shader(struct hair_gl* gl, struct hair_gl_shader* shader)
{
    hair_gl_free_shader_programs(gl, shader);
    hair_free(&gl->host, shader->programs);
    hair_free(&gl->host, shader->label);
    hair_free(&gl->host, shader->text);
    memset(shader, 0, sizeof *shader);
}

static hair_result reserve_programs(struct hair_gl* gl, struct hair_gl_shader* shader)
{
    if (shader->count < shader->room) return HAIR_OK;
    void* more = hair_grow(&gl->host, shader->programs, sizeof *shader->programs, &shader->room, 4);
    if (!more) return hair_fail_memory(&gl->host, "a shader's programs");
    shader->programs = more;
    return HAIR_OK;
}

hair_result hair_gl_ensure_user_program(struct hair_gl* gl, struct hair_gl_shader* shader, hair_gl_pass pass,
                                        GLuint* out)
{
    // The run time counts as that of the pass.
    if (!hair_gl_get_or_add(gl, pass)) return HAIR_ERROR_MEMORY;
    // All shaders have been compiled again.
    if (shader->program_generation != gl->program_generation) hair_gl_free_shader_programs(gl, shader);
    shader->program_generation = gl->program_generation;
    for (uint32_t i = 0; i < shader->count; ++i)
        if (shader->programs[i].pass == pass) {
            *out = shader->programs[i].program;
            return HAIR_OK;
        }
    HAIR_TRY(reserve_programs(gl, shader));
    HAIR_TRY(hair_gl_link_pass(gl, shader, pass, out));
    HAIR_ASSERT(shader->count < shader->room);
    shader->programs[shader->count++] = (struct hair_gl_user_program){pass, *out};
    return HAIR_OK;
}
