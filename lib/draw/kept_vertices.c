// kept_vertices.c - vertices of a view that later frames draw again, moved rigidly with the head.
#include "lib/draw/params.h"

#include <string.h>

#define MAX_CHANGE 0.05f // Maximum relative change of the size on the screen.
#define MIN_COSINE 0.98f // Minimum cosine between the directions to the eye, then and now.

// Find the view that shows hair of a head at `from` as `view` shows it with the head at `to`.
static void move_view(const hair_view* view, const struct hair_pose* from, const struct hair_pose* to,
                      hair_view* out)
{
    const hair_quat turn = hair_quat_multiply(to->rotation, hair_quat_conjugate(from->rotation));
    double motion[16] = {[15] = 1}, moved[16] = {0};
    for (int i = 0; i < 3; ++i) {
        hair_vec3 axis = hair_rotate(turn, hair_v3(i == 0, i == 1, i == 2));
        const float column[3] = {axis.x, axis.y, axis.z};
        for (int k = 0; k < 3; ++k) motion[4 * i + k] = (double)column[k];
    }
    for (int k = 0; k < 3; ++k) {
        motion[12 + k] = to->position[k];
        for (int i = 0; i < 3; ++i) motion[12 + k] -= motion[4 * i + k] * from->position[i];
    }
    for (int i = 0; i < 64; ++i)
        moved[i / 4 % 4 + 4 * (i / 16)] +=
            (double)view->view[i / 4 % 4 + 4 * (i % 4)] * motion[4 * (i / 16) + i % 4];
    *out = *view;
    for (int i = 0; i < 16; ++i) out->view[i] = (float)moved[i];
}

static hair_vec3 find_direction(hair_vec4 eye, hair_vec3 middle)
{
    hair_vec3 at = {eye.x, eye.y, eye.z};
    return hair_normalize(eye.w > 0 ? hair_sub(at, middle) : at, hair_v3(0, 0, 1));
}

// Return whether no hair was outside the view for which strands were listed.
static bool was_in_view(const struct hair_renderer* renderer, const struct hair_draw_params* then,
                        hair_vec3 middle)
{
    bool is_inside = true;
    for (int i = 0; i < 4 && then->culls; ++i) {
        hair_vec4 side = then->sides.column[i];
        is_inside &= hair_dot(hair_v3(side.x, side.y, side.z), middle) + side.w >= renderer->reach.w;
    }
    return is_inside;
}

// Return whether only the camera differs.
static bool are_same(const struct hair_draw_params* then, const struct hair_draw_params* now)
{
    struct hair_draw_params own = *now;
    own.view = then->view;
    own.view_to_clip = then->view_to_clip;
    own.eye = then->eye;
    own.sides = then->sides;
    own.now_to_clip = then->now_to_clip;
    own.before_to_clip = then->before_to_clip;
    // These follow the size on the screen.
    own.origin.w = then->origin.w;
    own.chunks = then->chunks;
    own.push_out_weight = then->push_out_weight;
    return memcmp(then, &own, sizeof own) == 0;
}

bool hair_draw_keep_vertices(struct hair_renderer* renderer, const struct hair_pose* from,
                             const struct hair_pose* to, struct hair_draw_plan* plan)
{
    const struct hair_strand_list_key* key = renderer->strand_list.key;
    const hair_view* view = plan->view;
    HAIR_ASSERT(!plan->keeps_vertices);
    bool has_any = plan->is_computed && plan->vertices == HAIR_VERTICES_PER_VIEW &&
                   view->pass == HAIR_PASS_COLOR && !plan->shader && !hair_draw_uses_occlusion(view) &&
                   renderer->view_cache.is_complete &&
                   renderer->view_cache.is_in_place == plan->is_of_batch && key &&
                   key->runs == renderer->geometry->smooth.runs &&
                   key->program_generation == renderer->gl->program_generation;
    if (!has_any) return false;
    HAIR_ASSERT(view->lod && key->params.pixels_per_unit > 0);
    struct hair_draw_params now;
    hair_draw_select_lod(renderer, to, plan);
    hair_draw_write_params(renderer, from, view, &now);
    now.textured = plan->is_textured;
    now.strands_at = key->params.strands_at;
    move_view(view, from, to, &plan->moved_view);
    hair_mat4 matrix = hair_mat4_from_head(plan->moved_view.view, from);
    hair_vec3 middle = hair_draw_find_middle(renderer, from);
    hair_vec3 then = find_direction(key->params.eye, middle);
    float cosine = hair_dot(then, find_direction(hair_draw_find_eye(&matrix, view->projection), middle));
    float change = renderer->pixels_per_metre / renderer->view_cache.pixels_per_metre - 1;
    bool keeps = fabsf(change) <= MAX_CHANGE && cosine >= MIN_COSINE && are_same(&key->params, &now) &&
                 was_in_view(renderer, &key->params, middle);
    if (!keeps) return false;
    plan->view = &plan->moved_view;
    plan->keeps_vertices = true;
    return true;
}

void hair_draw_forget_vertices(struct hair_renderer* renderer)
{
    renderer->view_cache.is_complete = false;
}
