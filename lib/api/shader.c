// shader.c - public calls on the application's own shading.
#include "lib/api/api.h"

static hair_result fill_shader(hair_shader* shader, hair_context* context, const hair_shader_desc* desc)
{
    struct hair_gl* gl = &context->gl;
    GLuint program = 0;
    HAIR_TRY(hair_gl_create_shader(gl, desc->label ? desc->label : "shader", desc->glsl,
                                   desc->at == HAIR_SHADE_PIXELS, &shader->gl));
    // Compile the variant that most views use. Errors of other variants show here too.
    hair_gl_enter(gl);
    hair_result result =
        hair_gl_ensure_user_program(gl, &shader->gl, HAIR_GL_TESSELLATED | HAIR_GL_WITH(FIBRES), &program);
    return hair_leave(context, result);
}

static void empty(struct hair_context_member* member)
{
    hair_shader* shader = (hair_shader*)member;
    hair_gl_free_shader(&shader->context->gl, &shader->gl);
}

hair_result hair_shader_create(hair_context* context, const hair_shader_desc* desc, hair_shader** out)
{
    HAIR_TRY(hair_check_context(context));
    const hair_host* host = &context->host;
    hair_shader_desc own;
    HAIR_TRY(HAIR_COPY_IN(host, hair_shader_desc, desc, &own));
    if (!own.glsl) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_shader_desc.glsl is NULL");
    if (!out) return hair_fail(host, HAIR_ERROR_ARGUMENT, "out is NULL");
    HAIR_TRY(hair_check_current(context));
    hair_shader* shader = hair_alloc(host, 1, sizeof *shader);
    if (!shader) return hair_fail_memory(host, "a shader");
    shader->context = context;
    hair_context_add(context, &shader->member, empty);
    hair_result result = fill_shader(shader, context, &own);
    if (result) {
        hair_shader_destroy(shader);
        return result;
    }
    *out = shader;
    return HAIR_OK;
}

void hair_shader_destroy(hair_shader* shader)
{
    if (!shader) return;
    hair_host host = shader->context->host;
    hair_context_tell_left(shader->context);
    hair_context_remove(shader->context, &shader->member);
    hair_free(&host, shader);
}
