// blend.c - blending by alpha into the first draw buffer without depth writes. Only coverage passes
// need this state, and they restore it at once, like prepass.c.
#include "lib/draw/draw.h"

void hair_draw_begin_blend(struct hair_gl* gl, struct hair_blend* was)
{
    static const GLenum factors[] = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA,
                                     GL_BLEND_DST_ALPHA};
    gl->GetIntegeri_v(GL_BLEND_EQUATION_RGB, 0, &was->equation[0]);
    gl->GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, 0, &was->equation[1]);
    for (int i = 0; i < 4; ++i) gl->GetIntegeri_v(factors[i], 0, &was->factor[i]);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &was->writes_depth);
    was->blends = gl->IsEnabledi(GL_BLEND, 0);
    gl->BlendEquationSeparatei(0, GL_FUNC_ADD, GL_FUNC_ADD);
    gl->BlendFuncSeparatei(0, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->Enablei(GL_BLEND, 0);
    gl->DepthMask(0);
}

void hair_draw_end_blend(struct hair_gl* gl, const struct hair_blend* was)
{
    const GLint* f = was->factor;
    gl->BlendEquationSeparatei(0, (GLenum)was->equation[0], (GLenum)was->equation[1]);
    gl->BlendFuncSeparatei(0, (GLenum)f[0], (GLenum)f[1], (GLenum)f[2], (GLenum)f[3]);
    (was->blends ? gl->Enablei : gl->Disablei)(GL_BLEND, 0);
    gl->DepthMask(was->writes_depth);
}
