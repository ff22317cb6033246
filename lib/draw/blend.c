// blend.c - blending by alpha into the first draw buffers without depth writes. Only coverage
// passes need this state, and they restore it at once, like prepass.c.
#include "lib/draw/draw.h"

void hair_draw_begin_blend(struct hair_gl* gl, GLuint buffers, struct hair_blend* was)
{
    static const GLenum factors[] = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA,
                                     GL_BLEND_DST_ALPHA};
    HAIR_ASSERT(buffers <= sizeof was->buffer / sizeof *was->buffer);
    was->buffers = buffers;
    for (GLuint i = 0; i < buffers; ++i) {
        gl->GetIntegeri_v(GL_BLEND_EQUATION_RGB, i, &was->buffer[i].equation[0]);
        gl->GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, i, &was->buffer[i].equation[1]);
        for (int k = 0; k < 4; ++k) gl->GetIntegeri_v(factors[k], i, &was->buffer[i].factor[k]);
        was->buffer[i].blends = gl->IsEnabledi(GL_BLEND, i);
        gl->BlendEquationSeparatei(i, GL_FUNC_ADD, GL_FUNC_ADD);
        gl->BlendFuncSeparatei(i, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        gl->Enablei(GL_BLEND, i);
    }
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &was->writes_depth);
    gl->DepthMask(0);
}

void hair_draw_end_blend(struct hair_gl* gl, const struct hair_blend* was)
{
    for (GLuint i = 0; i < was->buffers; ++i) {
        const GLint *e = was->buffer[i].equation, *f = was->buffer[i].factor;
        gl->BlendEquationSeparatei(i, (GLenum)e[0], (GLenum)e[1]);
        gl->BlendFuncSeparatei(i, (GLenum)f[0], (GLenum)f[1], (GLenum)f[2], (GLenum)f[3]);
        (was->buffer[i].blends ? gl->Enablei : gl->Disablei)(GL_BLEND, i);
    }
    gl->DepthMask(was->writes_depth);
}
