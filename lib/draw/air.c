// air.c - arrows that show the wind in a slice of the field's box, drawn for debugging.
#include <math.h>

#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#define ARROWS 40 // Number of arrows along the longest side of the box.
// Side of the slice of arrows, in sides of the field's box. The fluid's default grid is as large.
#define AROUND 1.5f

// Return the speed that is drawn grey, in m/s. It is the speed of the wind, or of the first source
// with a speed. If only a texture gives velocities, it is 1 m/s.
static float grey_speed(const hair_wind* wind)
{
    float speed = hair_length(hair_load3(wind->velocity));
    for (uint32_t i = 0; i < wind->source_count && !(speed > 0); ++i) speed = fabsf(wind->sources[i].speed);
    return speed > 0 ? speed : 1;
}

static void widen_arrow(struct hair_debug_params* params, int i)
{
    float more = 0.5f * (AROUND - 1);
    hair_vec4 *corner = &params->corner, *side = &params->side[i];
    *corner =
        (hair_vec4){corner->x - more * side->x, corner->y - more * side->y, corner->z - more * side->z, 0};
    *side = (hair_vec4){AROUND * side->x, AROUND * side->y, AROUND * side->z, 0};
}

static uint32_t write_arrows(const struct hair_field_box* box, const hair_wind* wind, const hair_view* view,
                             struct hair_debug_params* params)
{
    const hair_slice slice = view->slice ? view->slice : HAIR_SLICE_Z;
    uint32_t longest = 0, along[2];
    for (int k = 0; k < 3; ++k) longest = box->bricks[k] > longest ? box->bricks[k] : longest;
    HAIR_ASSERT(longest > 0 && slice != HAIR_SLICE_NONE);
    hair_draw_write_slice(box, slice, view->slice_at, params);
    for (uint32_t i = 0; i < 2; ++i) {
        widen_arrow(params, (int)i);
        along[i] = (ARROWS * box->bricks[((uint32_t)slice + i) % 3] + longest - 1) / longest;
    }
    float apart = AROUND * HAIR_BRICK * box->voxel * (float)longest / ARROWS;
    params->air = (hair_vec4){(float)along[0], (float)along[1], apart, grey_speed(wind)};
    return along[0] * along[1];
}

hair_result hair_draw_air(struct hair_renderer* renderer, const struct hair_wind_state* air,
                          const hair_wind* wind, const struct hair_fluid* fluid,
                          const struct hair_field_box* box, const struct hair_pose* head,
                          const hair_view* view)
{
    struct hair_gl* gl = renderer->gl;
    GLuint buffer = 0; // Created for each draw, so that no memory stays when the wind is not drawn.
    hair_vec4 turn = {head->rotation.x, head->rotation.y, head->rotation.z, head->rotation.w};
    struct hair_debug_params params = {.rotation = turn};
    struct hair_draw_params own;
    struct hair_outputs outputs;
    hair_result result = hair_gl_ensure_program(gl, HAIR_GL_AIR);
    if (!result) result = hair_gl_uniform(gl, HAIR_GL_CATEGORY_AIR, "hair shown", sizeof params, &buffer);
    if (result) return result;
    uint32_t arrows = write_arrows(box, wind, view, &params);
    hair_draw_write_params(renderer, head, view, &own);
    hair_gl_write_uniform(gl, renderer->geometry->params, sizeof own, &own);
    hair_gl_write_uniform(gl, buffer, sizeof params, &params);
    hair_wind_bind(air, gl, wind);
    if (fluid) hair_fluid_bind(fluid);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, 1, &renderer->geometry->params);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DEBUG, 1, &buffer);
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE);
    hair_draw_begin_outputs(gl, HAIR_DRAW_FIRST_BUFFER, &outputs);
    hair_gl_begin(gl, HAIR_GL_AIR);
    gl->DrawArraysInstanced(GL_TRIANGLES, 0, 3, (GLsizei)arrows);
    hair_gl_end(gl, HAIR_GL_AIR);
    hair_draw_end_outputs(gl, &outputs);
    // Unbind the buffer before it is deleted. See state.c.
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DEBUG, 1, NULL);
    hair_gl_free_buffer(gl, &buffer);
    return HAIR_OK;
}
