// params.c - parameters of one draw, such as matrices from the head's origin, the eye and the look.
#include "lib/draw/params.h"

#include <string.h>

// Half of a pixel's diagonal. A ribbon reaches pixels whose centres are at most this far beside it.
#define DIAGONAL 0.70711f

static void write_clip(const struct hair_renderer* renderer, const struct hair_pose* head,
                       const hair_view* view, struct hair_draw_params* out)
{
    const struct hair_gl_draw_state* state = &renderer->gl->draw_state;
    float projection[16];
    hair_draw_project(renderer, view, projection);
    memcpy(&out->view_to_clip, projection, sizeof out->view_to_clip);
    if (!hair_draw_uses_analytic_coverage(view)) return;
    // With multisampling, the ribbon must contain whole pixels.
    float diagonal = state->samples > 1 ? 2 * DIAGONAL : DIAGONAL;
    out->viewport = (hair_vec4){state->viewport[2], state->viewport[3], diagonal, view->opacity};
    hair_vec3 at = hair_draw_find_middle(renderer, head);
    hair_vec3 eye = {out->eye.x, out->eye.y, out->eye.z};
    float middle = out->eye.w > 0 ? hair_distance(eye, at) : -hair_dot(eye, at);
    out->sort.x = out->eye.w > 0 ? fmaxf(middle - renderer->reach.w, 0) : middle - renderer->reach.w;
    out->sort.y = HAIR_SORT_BUCKETS / fmaxf(2 * renderer->reach.w, 1e-6f);
}

// Write the matrices from the head's origins to clip space, of this frame and of the previous one.
static void write_motion_matrices(const struct hair_vertex_history* history, const hair_view* view,
                                  struct hair_draw_params* out)
{
    float matrix[16], turn[16] = {[15] = 1}, placed[16], clip[16];
    struct hair_pose was = {.rotation = {0, 0, 0, 1}};
    for (int i = 0; i < 3; ++i)
        hair_store3(turn + 4 * i, hair_rotate(history->before.turn, hair_v3(i == 0, i == 1, i == 2)));
    memcpy(was.position, history->before.position, sizeof was.position);
    hair_mat4 before = hair_mat4_from_head(view->prev_view, &was);
    memcpy(matrix, &before, sizeof matrix);
    hair_mat4_multiply(matrix, turn, placed);
    hair_mat4_multiply(view->prev_projection, placed, clip);
    memcpy(&out->before_to_clip, clip, sizeof clip);
    memcpy(matrix, &out->view, sizeof matrix);
    hair_mat4_multiply(view->projection, matrix, clip);
    memcpy(&out->now_to_clip, clip, sizeof clip);
}

static void write_view(const struct hair_renderer* renderer, const struct hair_pose* head,
                       const hair_view* view, struct hair_draw_params* out)
{
    out->view = hair_mat4_from_head(view->view, head);
    out->eye = hair_draw_find_eye(&out->view, view->projection);
    out->origin = (hair_vec4){(float)head->position[0], (float)head->position[1], (float)head->position[2],
                              hair_draw_cell(renderer, view)};
    out->head = (hair_vec4){head->rotation.x, head->rotation.y, head->rotation.z, head->rotation.w};
    write_clip(renderer, head, view, out);
    if (hair_draw_has_motion(view)) write_motion_matrices(&renderer->geometry->history, view, out);
}

void hair_draw_write_params(const struct hair_renderer* renderer, const struct hair_pose* head,
                            const hair_view* view, struct hair_draw_params* out)
{
    const struct hair_geometry* geometry = renderer->geometry;
    HAIR_ASSERT(head && view);
    hair_geometry_write_params(geometry, out);
    out->push_out_weight = geometry->push_out_weight;
    out->draw_instances = hair_draw_instances_at_once(renderer);
    write_view(renderer, head, view, out);
    hair_lighting_write_params(renderer->lighting, &geometry->look, head, view, out);
    hair_draw_write_lod(renderer, head, view, out);
}
