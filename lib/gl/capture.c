// capture.c - transform feedback without rasterisation, and the state of the application that it
// changes.
#include "lib/gl/capture.h"

hair_result hair_gl_check_capture(const struct hair_gl* gl, const char* name)
{
    GLint is_active = 0;
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &is_active);
    if (!is_active) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                     "%s captures by transform feedback itself, but that of the application is active", name);
}

GLuint hair_gl_blank_framebuffer(struct hair_gl* gl)
{
    GLuint framebuffer = 0;
    gl->CreateFramebuffers(1, &framebuffer);
    if (!framebuffer) return 0;
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    return framebuffer;
}

void hair_gl_begin_capture(struct hair_gl* gl, GLuint framebuffer, struct hair_gl_capture* was)
{
    was->discard = gl->IsEnabled(GL_RASTERIZER_DISCARD);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &was->framebuffer);
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_BINDING, &was->feedback);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl->BindVertexArray(gl->vertex_array);
    gl->Enable(GL_RASTERIZER_DISCARD);
}

void hair_gl_end_capture(struct hair_gl* gl, const struct hair_gl_capture* was)
{
    if (!was->discard) gl->Disable(GL_RASTERIZER_DISCARD);
    gl->BindTransformFeedback(GL_TRANSFORM_FEEDBACK, (GLuint)was->feedback);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)was->framebuffer);
}
