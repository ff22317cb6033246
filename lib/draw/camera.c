// camera.c - matrices of a view, and the mapping from clip space to the viewport. The mapping
// depends on the application's clip control and depth test.
#include "lib/draw/params.h"

#include <string.h>

hair_vec3 hair_draw_find_middle(const struct hair_renderer* renderer, const struct hair_pose* head)
{
    return hair_rotate(head->rotation, hair_v3(renderer->reach.x, renderer->reach.y, renderer->reach.z));
}

hair_vec4 hair_draw_find_eye(const hair_mat4* view, const float projection[16])
{
    const hair_vec4* c = view->column;
    hair_vec3 x = {c[0].x, c[0].y, c[0].z}, y = {c[1].x, c[1].y, c[1].z}, z = {c[2].x, c[2].y, c[2].z};
    hair_vec3 t = {c[3].x, c[3].y, c[3].z};
    if (projection[3] == 0 && projection[7] == 0 && projection[11] == 0) {
        hair_vec3 back = hair_normalize(hair_v3(x.z, y.z, z.z), hair_v3(0, 0, 1));
        return (hair_vec4){back.x, back.y, back.z, 0};
    }
    return (hair_vec4){-hair_dot(x, t), -hair_dot(y, t), -hair_dot(z, t), 1};
}

// Add the jitter to the projection. Jitter shifts the picture by so many pixels.
void hair_draw_project(const struct hair_renderer* renderer, const hair_view* view, float projection[16])
{
    const GLfloat* viewport = renderer->gl->draw_state.viewport;
    const float* by = view->jitter;
    memcpy(projection, view->projection, sizeof view->projection);
    if (by[0] == 0 && by[1] == 0) return;
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 2; ++i)
            projection[4 * column + i] += 2 * by[i] / fmaxf(viewport[2 + i], 1) * projection[4 * column + 3];
}

void hair_draw_clip_to_unit_matrix(const struct hair_gl* gl, float to_unit[16])
{
    float half[16] = {[0] = 0.5f, [5] = 0.5f, [10] = 1, [12] = 0.5f, [13] = 0.5f, [15] = 1};
    if (gl->draw_state.is_upside_down) half[5] = -0.5f;
    if (!gl->draw_state.is_zero_to_one) half[10] = half[14] = 0.5f;
    memcpy(to_unit, half, sizeof half);
}

float hair_draw_depth_direction(const struct hair_gl* gl)
{
    const GLenum function = gl->draw_state.depth_function;
    if (function == GL_LESS || function == GL_LEQUAL) return 1;
    return function == GL_GREATER || function == GL_GEQUAL ? -1.0f : 0.0f;
}
