// outputs.c - colour masks of the draw buffers that a pass does not write. Without a written output
// OpenGL stores undefined colours there, not finite ones among them.
#include "lib/draw/draw.h"

// Return the draw buffers of one output, as bits. Arrays of outputs take several.
static uint32_t find_buffers(struct hair_gl* gl, GLuint program, GLuint output)
{
    static const GLenum properties[] = {GL_LOCATION, GL_ARRAY_SIZE};
    GLint values[2] = {-1, 1};
    uint32_t buffers = 0;
    gl->GetProgramResourceiv(program, GL_PROGRAM_OUTPUT, output, 2, properties, 2, NULL, values);
    if (values[0] < 0) return 0; // Built-in outputs, such as gl_FragDepth, have no location.
    for (GLint i = values[0]; i < values[0] + values[1] && i < HAIR_DRAW_BUFFERS; ++i) buffers |= 1u << i;
    return buffers;
}

uint32_t hair_draw_find_outputs(struct hair_gl* gl, const struct hair_draw_plan* plan)
{
    GLint count = 0;
    uint32_t buffers = HAIR_DRAW_FIRST_BUFFER;
    if (plan->view->pass == HAIR_PASS_DEPTH) return 0;
    if (plan->has_motion_output) buffers |= HAIR_DRAW_MOTION_BUFFER;
    if (!plan->shader || !plan->shader->pixels) return buffers;
    gl->GetProgramInterfaceiv(plan->draw_program, GL_PROGRAM_OUTPUT, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) buffers |= find_buffers(gl, plan->draw_program, (GLuint)i);
    return buffers;
}

void hair_draw_begin_outputs(struct hair_gl* gl, uint32_t written, struct hair_outputs* was)
{
    GLint count = 0;
    was->closed = 0;
    gl->GetIntegerv(GL_MAX_DRAW_BUFFERS, &count);
    for (GLuint i = 0; i < (GLuint)count && i < HAIR_DRAW_BUFFERS; ++i) {
        GLint target = GL_NONE;
        if (written & 1u << i) continue;
        gl->GetIntegerv(GL_DRAW_BUFFER0 + i, &target);
        if (target == GL_NONE) continue;
        gl->GetBooleani_v(GL_COLOR_WRITEMASK, i, was->mask[i]);
        gl->ColorMaski(i, 0, 0, 0, 0);
        was->closed |= 1u << i;
    }
}

void hair_draw_end_outputs(struct hair_gl* gl, const struct hair_outputs* was)
{
    for (GLuint i = 0; i < HAIR_DRAW_BUFFERS; ++i) {
        const GLboolean* m = was->mask[i];
        if (was->closed & 1u << i) gl->ColorMaski(i, m[0], m[1], m[2], m[3]);
    }
}
