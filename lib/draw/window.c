// window.c - mapping from clip space to the viewport, by the application's clip control and depth
// test.
#include "lib/draw/params.h"

#include <string.h>

void hair_draw_find_unit(struct hair_gl* gl, float to_unit[16])
{
    GLint mode = GL_NEGATIVE_ONE_TO_ONE, origin = GL_LOWER_LEFT;
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &mode);
    gl->GetIntegerv(GL_CLIP_ORIGIN, &origin);
    float half[16] = {[0] = 0.5f, [5] = 0.5f, [10] = 1, [12] = 0.5f, [13] = 0.5f, [15] = 1};
    if (origin == GL_UPPER_LEFT) half[5] = -0.5f;
    if (mode != GL_ZERO_TO_ONE) half[10] = half[14] = 0.5f;
    memcpy(to_unit, half, sizeof half);
}

float hair_draw_find_sign(struct hair_gl* gl)
{
    GLint function = GL_LESS;
    gl->GetIntegerv(GL_DEPTH_FUNC, &function);
    if (function == GL_LESS || function == GL_LEQUAL) return 1;
    return function == GL_GREATER || function == GL_GEQUAL ? -1.0f : 0.0f;
}
