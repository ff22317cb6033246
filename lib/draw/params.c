// params.c - parameters of one draw, such as matrices from the head's origin, the eye and the look.
#include "lib/draw/params.h"
#include "lib/draw/fibre.h"

#include <string.h>

// Half of a pixel's diagonal. A ribbon reaches pixels whose centres are at most this far beside it.
#define DIAGONAL 0.70711f

static void write_clip(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                       struct hair_draw_params* out)
{
    GLfloat viewport[4] = {0};
    GLint samples = 0;
    float projection[16];
    hair_draw_project(draw, view, projection);
    memcpy(&out->view_to_clip, projection, sizeof out->view_to_clip);
    if (!hair_draw_uses_analytic_coverage(view)) return;
    draw->gl->GetFloati_v(GL_VIEWPORT, 0, viewport);
    draw->gl->GetIntegerv(GL_SAMPLES, &samples);
    // With multisampling, the ribbon must contain whole pixels.
    out->viewport =
        (hair_vec4){viewport[2], viewport[3], samples > 1 ? 2 * DIAGONAL : DIAGONAL, view->opacity};
    hair_vec3 at = hair_rotate(head->rotation, hair_v3(draw->reach.x, draw->reach.y, draw->reach.z));
    hair_vec3 eye = {out->eye.x, out->eye.y, out->eye.z};
    float middle = out->eye.w > 0 ? hair_distance(eye, at) : -hair_dot(eye, at);
    out->sort.x = out->eye.w > 0 ? fmaxf(middle - draw->reach.w, 0) : middle - draw->reach.w;
    out->sort.y = HAIR_SORT_BUCKETS / fmaxf(2 * draw->reach.w, 1e-6f);
}

// Write the matrices from the head's origins to clip space, of this frame and of the previous one.
static void write_motion(const struct hair_motion* motion, const hair_view* view,
                         struct hair_draw_params* out)
{
    float matrix[16], turn[16] = {[15] = 1}, placed[16], clip[16];
    struct hair_pose was = {.rotation = {0, 0, 0, 1}};
    for (int i = 0; i < 3; ++i)
        hair_store3(turn + 4 * i, hair_rotate(motion->before.turn, hair_v3(i == 0, i == 1, i == 2)));
    memcpy(was.position, motion->before.position, sizeof was.position);
    hair_mat4 before = hair_mat4_from_head(view->prev_view, &was);
    memcpy(matrix, &before, sizeof matrix);
    hair_mat4_multiply(matrix, turn, placed);
    hair_mat4_multiply(view->prev_projection, placed, clip);
    memcpy(&out->before_to_clip, clip, sizeof clip);
    memcpy(matrix, &out->view, sizeof matrix);
    hair_mat4_multiply(view->projection, matrix, clip);
    memcpy(&out->now_to_clip, clip, sizeof clip);
}

static void write_view(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                       struct hair_draw_params* out)
{
    out->view = hair_mat4_from_head(view->view, head);
    out->eye = hair_draw_find_eye(&out->view, view->projection);
    out->origin = (hair_vec4){(float)head->position[0], (float)head->position[1], (float)head->position[2],
                              hair_draw_cell(draw, view)};
    out->head = (hair_vec4){head->rotation.x, head->rotation.y, head->rotation.z, head->rotation.w};
    out->light_values = hair_draw_light_value_count(draw, view);
    write_clip(draw, head, view, out);
    if (view->pass == HAIR_PASS_MOTION) write_motion(&draw->motion, view, out);
    hair_draw_write_lights(draw, head, view, out);
}

// Return the weights of the map sets. A fractional `set` blends between two neighbours.
static hair_vec4 weigh_sets(float set, uint32_t sets)
{
    float weight[HAIR_MAP_SETS] = {0}, last = sets > 1 ? (float)(sets - 1) : 0;
    float at = set < last ? set : last;
    int first = (int)at;
    HAIR_ASSERT(0 <= first && first < HAIR_MAP_SETS);
    weight[first] = 1 - (at - (float)first);
    if (first + 1 < HAIR_MAP_SETS) weight[first + 1] = at - (float)first;
    return (hair_vec4){weight[0], weight[1], weight[2], weight[3]};
}

// Write the parameters of fibre shading. The squared logarithm of a reflectance times 1 / d^2 is
// the absorption, with d from Chiang et al. 2016, equation 9.
static void write_fibre(const hair_look* look, hair_vec4* out)
{
    float variance[3], b = look->roughness[1];
    hair_fibre_variances(look->roughness[0], variance);
    float d = 5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + 0.245f * b))));
    *out = (hair_vec4){variance[0], 1 / (d * d), look->cuticle_tilt, look->scattering};
}

void hair_draw_write_params(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out)
{
    const hair_look* look = &draw->look;
    HAIR_ASSERT(look->segments > 0 && (!view || head));
    memset(out, 0, sizeof *out);
    if (view) write_view(draw, head, view, out);
    out->specular = (hair_vec4){look->specular[0], look->specular[1], look->gloss[0], look->gloss[1]};
    write_fibre(look, &out->fibre);
    out->radius = look->radius;
    out->density = look->density;
    out->segments = look->segments;
    out->colored = view && view->pass == HAIR_PASS_COLOR;
    out->smooth_vertices = draw->smooth_vertices;
    out->followers = draw->followers;
    out->follower_collision = look->follower_collision;
    out->push_out_weight = view ? draw->push_out_weight : 1;
    out->map_weights = weigh_sets(look->map_set, draw->map_sets);
    hair_draw_write_lod(draw, head, view, out);
    hair_draw_write_tint(look, &out->tint);
    hair_draw_write_strand(look, &out->strand);
}
