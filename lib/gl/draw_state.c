// draw_state.c - questions to OpenGL about the state that draws obey.
#include "lib/gl/gl.h"

// Read the positions of the samples in a pixel.
static void read_samples(struct hair_gl* gl, struct hair_gl_draw_state* out)
{
    GLint samples = 0;
    gl->GetIntegerv(GL_SAMPLES, &samples);
    out->samples = samples > 0 ? (uint32_t)samples : 0;
    out->multisamples = samples > 1 && gl->IsEnabled(GL_MULTISAMPLE);
    for (uint32_t i = 0; out->multisamples && i < out->samples && i < HAIR_RASTER_SAMPLES; ++i)
        gl->GetMultisamplefv(GL_SAMPLE_POSITION, i, out->sample[i]);
}

void hair_gl_read_draw_state(struct hair_gl* gl)
{
    GLint mode = GL_NEGATIVE_ONE_TO_ONE, origin = GL_LOWER_LEFT, function = GL_LESS;
    // A lost context answers nothing.
    gl->draw_state = (struct hair_gl_draw_state){.depth_range = {0, 1}};
    struct hair_gl_draw_state* out = &gl->draw_state;
    gl->GetFloati_v(GL_VIEWPORT, 0, out->viewport);
    gl->GetFloatv(GL_DEPTH_RANGE, out->depth_range);
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &mode);
    gl->GetIntegerv(GL_CLIP_ORIGIN, &origin);
    gl->GetIntegerv(GL_DEPTH_FUNC, &function);
    out->is_zero_to_one = mode == GL_ZERO_TO_ONE;
    out->is_upside_down = origin == GL_UPPER_LEFT;
    out->depth_function = (uint32_t)function;
    out->tests_depth = gl->IsEnabled(GL_DEPTH_TEST);
    out->clamps_depth = gl->IsEnabled(GL_DEPTH_CLAMP);
    read_samples(gl, out);
}
