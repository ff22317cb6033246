// lod.c - conversion of the application's level-of-detail settings to the values that
// strands/lod.glsl uses for each patch.
#include "lib/draw/params.h"

#include <string.h>

// Maximum iterations of a thread's loop. Mesa's software rasteriser leaves loops after 65,535.
#define MAX_ROUNDS 4096
#define EVERYWHERE 1e30f // Distance in metres of a plane that cuts nothing off.

// Return the half space { p : edge w(p) + sign row(p) >= 0 } of clip space as a plane with a unit
// normal. The plane is in the space that `clip` transforms from.
static hair_vec4 find_side(const float clip[16], int row, float sign, float edge)
{
    HAIR_ASSERT(0 <= row && row < 3);
    float p[4];
    hair_vec4 plane = {0, 0, 0, EVERYWHERE};
    for (int i = 0; i < 4; ++i) p[i] = edge * clip[4 * i + 3] + sign * clip[4 * i + row];
    float length = hair_length(hair_v3(p[0], p[1], p[2]));
    if (!(length > 0 && length < EVERYWHERE)) return plane;
    plane = (hair_vec4){p[0] / length, p[1] / length, p[2] / length, p[3] / length};
    return plane;
}

// Write the side planes of the view. They lie beyond the viewport's edges by the amount that
// strands are widened.
static void write_sides(const struct hair_draw* draw, const hair_view* view, struct hair_draw_params* out)
{
    float matrix[16], projection[16], clip[16];
    GLfloat viewport[4] = {0};
    draw->gl->GetFloati_v(GL_VIEWPORT, 0, viewport);
    memcpy(matrix, &out->view, sizeof matrix);
    memcpy(projection, &out->view_to_clip, sizeof projection);
    hair_mat4_multiply(projection, matrix, clip);
    for (int i = 0; i < 4; ++i) {
        float edge = (float)hair_draw_edge(viewport[2 + i / 2], view->jitter[i / 2]);
        out->sides.column[i] = find_side(clip, i / 2, i % 2 ? -1 : 1, edge);
    }
    out->culls = 1;
}

// Return how many pixels a unit step along the view's y axis covers where w of clip space is 1.
static float find_scale(const struct hair_draw* draw, const float projection[16])
{
    GLfloat viewport[4] = {0};
    draw->gl->GetFloati_v(GL_VIEWPORT, 0, viewport);
    return 0.5f * hypotf(projection[4] * viewport[2], projection[5] * viewport[3]);
}

#define CELL 2.0f // Smallest useful cell of the self-shadow grid, in pixels.
#define PUSH_OUT_DISTANCE 0.005f // Typical displacement of followers pushed out of colliders, in metres.

// Return the pixels per metre at the point of the hair's bounding sphere that is nearest to the
// eye. With an orthographic projection the scale is constant.
static float pixels_of(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view)
{
    const hair_vec3 middle =
        hair_rotate(head->rotation, hair_v3(draw->reach.x, draw->reach.y, draw->reach.z));
    hair_mat4 matrix = hair_mat4_from_head(view->view, head);
    float in_eye[16], clip[16];
    memcpy(in_eye, &matrix, sizeof in_eye);
    hair_mat4_multiply(view->projection, in_eye, clip);
    hair_vec3 along = hair_v3(clip[3], clip[7], clip[11]);
    float w = hair_dot(along, middle) + clip[15] - hair_length(along) * draw->reach.w;
    return find_scale(draw, view->projection) / fmaxf(w, 1e-6f);
}

void hair_draw_select_lod(struct hair_draw* draw, const struct hair_pose* head, const hair_view* view)
{
    const hair_lod* lod = view ? view->lod : NULL;
    draw->pixels_per_metre = 0;
    draw->push_out_weight = 1;
    if (!lod || !lod->per_patch || hair_draw_uses_vertex_cache(view)) return;
    draw->pixels_per_metre = fmaxf(lod->importance * pixels_of(draw, head, view), 1e-6f);
    draw->push_out_weight = fminf(fmaxf(PUSH_OUT_DISTANCE * draw->pixels_per_metre - 1, 0), 1);
}

float hair_draw_cell(const struct hair_draw* draw, const hair_view* view)
{
    return view->lod && draw->pixels_per_metre > 0
               ? fmaxf(draw->look.self_shadow_cell, CELL / draw->pixels_per_metre)
               : draw->look.self_shadow_cell;
}

// Return about which fraction of all strands is drawn.
static double find_fraction(const struct hair_draw* draw, const hair_lod* lod)
{
    float width = 2 * draw->look.radius * draw->pixels_per_metre;
    if (!lod) return 1;
    return (double)(lod->strand_fraction *
                    (draw->pixels_per_metre > 0
                         ? fminf(fmaxf(width / lod->strand_pixels, lod->min_strand_fraction), 1)
                         : 1));
}

uint32_t hair_draw_chunks(const struct hair_draw* draw, double fraction)
{
    HAIR_ASSERT(fraction >= 0);
    double each = draw->look.segments + 1.0;
    double mean = fraction * draw->followers * each / (HAIR_GROUP_SIZE * fmax(draw->patches, 1));
    double max = draw->max_isolines * each / ((double)HAIR_GROUP_SIZE * MAX_ROUNDS);
    return 1 + (uint32_t)fmax(mean, max);
}

void hair_draw_write_lod(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                         struct hair_draw_params* out)
{
    const hair_lod* lod = view ? view->lod : NULL;
    out->chunks = hair_draw_chunks(draw, find_fraction(draw, lod));
    out->strand_fraction = lod ? lod->strand_fraction : 1;
    out->segment_fraction = lod ? lod->segment_fraction : 1;
    out->width_power = lod ? lod->width_exponent : 0;
    if (!lod || !lod->per_patch) return;
    out->pixels_per_unit = find_scale(draw, view->projection);
    out->strand_pixels = lod->strand_pixels / fmaxf(lod->importance, 1e-6f);
    out->segment_pixels = lod->segment_pixels / fmaxf(lod->importance, 1e-6f);
    out->min_strand_fraction = lod->min_strand_fraction;
    out->occluded_importance = lod->occluded_importance;
    // Only where roots are attached does every strand stay within the reach of its patch.
    if (draw->is_cullable) write_sides(draw, view, out);
    if (lod->occluded_importance < 1 && draw->is_cullable) {
        hair_vec3 at = hair_rotate(head->rotation,
                                   hair_v3(draw->head_sphere.x, draw->head_sphere.y, draw->head_sphere.z));
        out->head_sphere = (hair_vec4){at.x, at.y, at.z, draw->head_sphere.w};
    }
}

void hair_draw_cull_patches(const struct hair_draw* draw, const hair_view* view, struct hair_draw_params* out)
{
    if (draw->has_attached_roots && !out->culls) write_sides(draw, view, out);
}
