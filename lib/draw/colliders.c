// colliders.c - colliders and a slice of the field, drawn for debugging.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

// Return the offset and scale from depth in clip space to depth in the framebuffer.
static hair_vec4 find_depth(const struct hair_gl* gl)
{
    const GLfloat* range = gl->draw_state.depth_range;
    if (gl->draw_state.is_zero_to_one) return (hair_vec4){range[0], range[1] - range[0], 0, 0};
    return (hair_vec4){0.5f * (range[0] + range[1]), 0.5f * (range[1] - range[0]), 0, 0};
}

void hair_draw_write_slice(const struct hair_field_box* box, hair_slice slice, float place,
                           struct hair_debug_params* params)
{
    const float brick = HAIR_BRICK * box->voxel, lower[] = {box->lower.x, box->lower.y, box->lower.z};
    if (!slice) return;
    int axis = (int)slice - HAIR_SLICE_X, a = (axis + 1) % 3, b = (axis + 2) % 3;
    HAIR_ASSERT(0 <= axis && axis < 3);
    float length[3] = {brick * (float)box->bricks[0], brick * (float)box->bricks[1],
                       brick * (float)box->bricks[2]};
    float at[3] = {lower[0], lower[1], lower[2]}, normal[3] = {0}, sides[2][3] = {{0}};
    at[axis] += place * length[axis];
    normal[axis] = 1;
    sides[0][a] = length[a];
    sides[1][b] = length[b];
    params->plane = (hair_vec4){normal[0], normal[1], normal[2], at[axis]};
    params->corner = (hair_vec4){at[0], at[1], at[2], 0};
    params->side[0] = (hair_vec4){sides[0][0], sides[0][1], sides[0][2], 0};
    params->side[1] = (hair_vec4){sides[1][0], sides[1][1], sides[1][2], 0};
}

static struct hair_debug_collider show(const struct hair_collider_field* field, const hair_collider* collider,
                                       uint32_t i, const struct hair_pose* head)
{
    hair_vec3 lower, upper;
    struct hair_field_collider own = hair_field_shown(field, collider, i, head, &lower, &upper);
    hair_vec3 more = hair_scale(hair_sub(upper, lower), 0.01f); // Rays begin outside the box.
    lower = hair_sub(lower, more);
    upper = hair_add(upper, more);
    return (struct hair_debug_collider){own, {lower.x, lower.y, lower.z, 0}, {upper.x, upper.y, upper.z, 0}};
}

static void draw_slice(struct hair_renderer* renderer, const struct hair_collider_field* field,
                       const hair_view* view, GLuint buffer, const struct hair_debug_params* params)
{
    if (!view->slice || !hair_field_is_near(field)) return;
    struct hair_gl* gl = renderer->gl;
    hair_gl_write_uniform(gl, buffer, sizeof *params, params);
    hair_field_bind(field);
    hair_gl_begin(gl, HAIR_GL_SLICE);
    gl->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    hair_gl_end(gl, HAIR_GL_SLICE);
}

static void draw_shapes(struct hair_renderer* renderer, const struct hair_collider_field* field,
                        const hair_collider* colliders, uint32_t count, const struct hair_pose* head,
                        GLuint buffer, struct hair_debug_params* params)
{
    struct hair_gl* gl = renderer->gl;
    hair_gl_begin(gl, HAIR_GL_COLLIDERS);
    for (uint32_t first = 0; first < count; first += HAIR_DEBUG_COLLIDERS) {
        uint32_t some = count - first < HAIR_DEBUG_COLLIDERS ? count - first : HAIR_DEBUG_COLLIDERS;
        HAIR_ASSERT(0 < some && first + some <= count);
        for (uint32_t i = 0; i < some; ++i)
            params->shown[i] = show(field, &colliders[first + i], first + i, head);
        hair_gl_write_uniform(gl, buffer, sizeof *params, params);
        gl->DrawArraysInstanced(GL_TRIANGLES, 0, 36, (GLsizei)some);
    }
    hair_gl_end(gl, HAIR_GL_COLLIDERS);
}

hair_result hair_draw_colliders(struct hair_renderer* renderer, const struct hair_collider_field* field,
                                const hair_collider* colliders, uint32_t count, const struct hair_pose* head,
                                const hair_view* view)
{
    struct hair_gl* gl = renderer->gl;
    // Created for each draw, so that no memory stays when colliders are not drawn.
    GLuint buffer = 0;
    hair_result result = hair_gl_ensure_program(gl, HAIR_GL_COLLIDERS);
    if (!result && view->slice) result = hair_gl_ensure_program(gl, HAIR_GL_SLICE);
    if (result) return result;
    struct hair_debug_params* params = hair_alloc(&gl->host, 1, sizeof *params);
    if (!params) return hair_fail_memory(&gl->host, "the colliders to draw");
    result = hair_gl_uniform(gl, HAIR_GL_CATEGORY_COLLIDERS, "hair shown", sizeof *params, &buffer);
    if (!result) {
        struct hair_draw_params own;
        struct hair_outputs outputs;
        hair_draw_write_params(renderer, head, view, &own);
        hair_gl_write_uniform(gl, renderer->geometry->params, sizeof own, &own);
        params->rotation =
            (hair_vec4){head->rotation.x, head->rotation.y, head->rotation.z, head->rotation.w};
        params->depth = find_depth(gl);
        hair_draw_write_slice(&field->box, view->slice, view->slice_at, params);
        hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, 1, &renderer->geometry->params);
        hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DEBUG, 1, &buffer);
        gl->BindVertexArray(gl->vertex_array);
        gl->Disable(GL_CULL_FACE);
        hair_draw_begin_outputs(gl, HAIR_DRAW_FIRST_BUFFER, &outputs);
        draw_slice(renderer, field, view, buffer, params);
        hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NODE, 1, &field->sdf_pool->nodes);
        draw_shapes(renderer, field, colliders, count, head, buffer, params);
        hair_draw_end_outputs(gl, &outputs);
        hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DEBUG, 1,
                             NULL); // Unbind the buffer before it is deleted. See state.c.
    }
    hair_gl_free_buffer(gl, &buffer);
    hair_free(&gl->host, params);
    return result;
}
