// lod.c - conversion of the application's level-of-detail settings to the values that
// strands/lod.glsl uses for each patch.
#include "lib/draw/params.h"

#include <string.h>

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
static void write_sides(const struct hair_renderer* renderer, const hair_view* view,
                        struct hair_draw_params* out)
{
    float matrix[16], projection[16], clip[16];
    const GLfloat* viewport = renderer->gl->draw_state.viewport;
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
static float find_scale(const struct hair_renderer* renderer, const float projection[16])
{
    const GLfloat* viewport = renderer->gl->draw_state.viewport;
    return 0.5f * hypotf(projection[4] * viewport[2], projection[5] * viewport[3]);
}

#define MARGIN 1.001 // Factor that allows for rounding on the GPU.
#define CELL 1.0f // Smallest useful cell of the self-shadow grid, in pixels.
// Typical displacement of followers pushed out of colliders, in metres.
#define PUSH_OUT_DISTANCE 0.005f

float hair_draw_pixels_per_metre(const struct hair_renderer* renderer, const struct hair_pose* head,
                                 const hair_view* view)
{
    const hair_vec3 middle = hair_draw_find_middle(renderer, head);
    hair_mat4 matrix = hair_mat4_from_head(view->view, head);
    float in_eye[16], clip[16];
    memcpy(in_eye, &matrix, sizeof in_eye);
    hair_mat4_multiply(view->projection, in_eye, clip);
    hair_vec3 along = hair_v3(clip[3], clip[7], clip[11]);
    float w = hair_dot(along, middle) + clip[15] - hair_length(along) * renderer->reach.w;
    return find_scale(renderer, view->projection) / fmaxf(w, 1e-6f);
}

float hair_draw_full_importance(const struct hair_renderer* renderer, float pixels_per_metre)
{
    const hair_lod usual = hair_lod_default();
    const hair_look* look = &renderer->geometry->look;
    float width = 2 * look->strand.radius * pixels_per_metre;
    float segment = renderer->extent.length / (float)look->strand.segments * pixels_per_metre;
    return fmaxf(usual.strand_pixels / fmaxf(width, 1e-6f), usual.segment_pixels / fmaxf(segment, 1e-6f));
}

// Return whether a view reads where strands are from a shadow map.
static bool reads_shadow_map(const struct hair_renderer* renderer, const hair_view* view)
{
    bool reads = false;
    if (view->pass != HAIR_PASS_COLOR ||
        renderer->geometry->look.self_shadow.method != HAIR_SELF_SHADOW_STRANDS)
        return false;
    for (uint32_t i = 0; i < view->light_count; ++i) reads |= view->lights[i].hair_shadow_map != 0;
    return reads;
}

// Return the push out of colliders that a view shows, which has `own` by its size on the screen.
// Strands must be where shadow maps draw them, or light would pass beside them.
static float find_push_out(struct hair_renderer* renderer, const hair_view* view, float own)
{
    struct hair_map_push_out* map = &renderer->map_push_out;
    if (reads_shadow_map(renderer, view)) return fmaxf(own, map->weight);
    if (view->pass != HAIR_PASS_DEPTH) return own;
    map->weight = map->frame == renderer->frame ? fmaxf(map->weight, own) : own;
    map->frame = renderer->frame;
    return own;
}

void hair_draw_select_lod(struct hair_renderer* renderer, const struct hair_pose* head,
                          const struct hair_draw_plan* plan)
{
    const hair_lod* lod = plan ? plan->view->lod : NULL;
    bool is_by_size = lod && lod->per_patch && plan->vertices != HAIR_VERTICES_CACHED;
    renderer->pixels_per_metre = 0;
    if (is_by_size)
        renderer->pixels_per_metre =
            fmaxf(lod->importance * hair_draw_pixels_per_metre(renderer, head, plan->view), 1e-6f);
    float own = is_by_size ? fminf(fmaxf(PUSH_OUT_DISTANCE * renderer->pixels_per_metre - 1, 0), 1) : 1;
    renderer->geometry->push_out_weight = plan ? find_push_out(renderer, plan->view, own) : own;
}

float hair_draw_cell(const struct hair_renderer* renderer, const hair_view* view)
{
    return view->lod && renderer->pixels_per_metre > 0
               ? fmaxf(renderer->geometry->look.self_shadow.cell, CELL / renderer->pixels_per_metre)
               : renderer->geometry->look.self_shadow.cell;
}

double hair_draw_estimate_fraction(const struct hair_renderer* renderer, const hair_lod* lod)
{
    if (!lod) return 1;
    float width = 2 * renderer->geometry->look.strand.radius * renderer->pixels_per_metre;
    return (double)(lod->strand_fraction *
                    (renderer->pixels_per_metre > 0
                         ? fminf(fmaxf(width / lod->strand_pixels, lod->min_strand_fraction), 1)
                         : 1));
}

double hair_draw_max_fraction(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view)
{
    const struct hair_geometry* geometry = renderer->geometry;
    const hair_lod* lod = view->lod;
    double fraction = lod ? (double)lod->strand_fraction : 1;
    if (lod && lod->per_patch && renderer->has_attached_roots) {
        double w = fmax(hair_draw_min_w(renderer, head, view), 1e-6);
        double width =
            2 * (double)(geometry->look.strand.radius * renderer->extent.importance * lod->importance);
        double pixels = MARGIN * width * (double)find_scale(renderer, view->projection) / w;
        fraction *= fmin(fmax(pixels / (double)lod->strand_pixels, (double)lod->min_strand_fraction), 1);
    }
    return fraction;
}

uint32_t hair_draw_max_strands(const struct hair_renderer* renderer, const struct hair_pose* head,
                               const hair_view* view)
{
    const struct hair_geometry* geometry = renderer->geometry;
    double fraction = hair_draw_max_fraction(renderer, head, view);
    // Each patch rounds up.
    double strands = ceil(fraction * geometry->followers) + geometry->patches;
    return strands < geometry->followers ? (uint32_t)strands : geometry->followers;
}

void hair_draw_write_lod(const struct hair_renderer* renderer, const struct hair_pose* head,
                         const hair_view* view, struct hair_draw_params* out)
{
    const hair_lod* lod = view->lod;
    out->max_radius = (float)hair_draw_max_radius(renderer, lod);
    if (!lod) return;
    out->chunks = hair_geometry_chunk_count(renderer->geometry, hair_draw_estimate_fraction(renderer, lod));
    out->strand_fraction = lod->strand_fraction;
    out->segment_fraction = lod->segment_fraction;
    out->width_power = lod->width_exponent;
    hair_lighting_find_curl(renderer->lighting, &renderer->geometry->look, &out->curl_slope, &out->curl_rate);
    if (!lod->per_patch) return;
    out->pixels_per_unit = find_scale(renderer, view->projection);
    out->strand_pixels = lod->strand_pixels / fmaxf(lod->importance, 1e-6f);
    out->segment_pixels = lod->segment_pixels / fmaxf(lod->importance, 1e-6f);
    out->min_strand_fraction = lod->min_strand_fraction;
    out->occluded_importance = lod->occluded_importance;
    // Only where roots are attached does every strand stay within the reach of its patch.
    if (renderer->is_cullable) write_sides(renderer, view, out);
    if (lod->occluded_importance < 1 && renderer->is_cullable) {
        hair_vec3 at = hair_rotate(head->rotation, hair_v3(renderer->head_sphere.x, renderer->head_sphere.y,
                                                           renderer->head_sphere.z));
        out->head_sphere = (hair_vec4){at.x, at.y, at.z, renderer->head_sphere.w};
    }
}

void hair_draw_cull_patches(const struct hair_renderer* renderer, const hair_view* view,
                            struct hair_draw_params* out)
{
    if (renderer->has_attached_roots && !out->culls) write_sides(renderer, view, out);
}
