// cull.c - view culling of a whole instance by its maximum extent, without reading vertices.
#include "lib/draw/params.h"

#include <string.h>

#define GIVE 1.1f // Allowance for stretched hair, as in glsl/strands/lod.glsl.
#define EDGE 8.0 // Margin in pixels, because ribbons are widened to the pixels that they touch.

double hair_draw_edge(float pixels, float jitter)
{
    return 1 + 2 * (EDGE + fabs((double)jitter)) / fmax((double)pixels, 1);
}

void hair_draw_find_extent(struct hair_renderer* renderer, const struct hair_groom* groom)
{
    struct hair_extent* extent = &renderer->extent;
    extent->lower = hair_v3(INFINITY, INFINITY, INFINITY);
    extent->upper = hair_v3(-INFINITY, -INFINITY, -INFINITY);
    for (uint32_t i = 0; i < groom->info.guide_count; ++i) {
        hair_vec3 root = hair_guide_root(groom, i);
        extent->lower = hair_v3(fminf(extent->lower.x, root.x), fminf(extent->lower.y, root.y),
                                fminf(extent->lower.z, root.z));
        extent->upper = hair_v3(fmaxf(extent->upper.x, root.x), fmaxf(extent->upper.y, root.y),
                                fmaxf(extent->upper.z, root.z));
        extent->reach = fmaxf(extent->reach, groom->guides[i].arc_length);
    }
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        extent->reach = fmaxf(extent->reach, groom->patches[i].reach);
        extent->length = fmaxf(extent->length, groom->patches[i].longest);
        extent->importance = fmaxf(extent->importance, groom->patches[i].importance);
    }
}

// Return the maximum factor by which a level of detail widens strands. Segments that cut curls off
// are wider too.
static double max_widening(const struct hair_renderer* renderer, const hair_lod* lod)
{
    float slope, rate;
    if (!lod) return 1;
    hair_lighting_find_curl(renderer->lighting, &renderer->geometry->look, &slope, &rate);
    return pow(fmax((double)(lod->strand_fraction * (lod->per_patch ? lod->min_strand_fraction : 1)), 1e-6),
               -(double)lod->width_exponent) *
           (1 + (double)slope);
}

double hair_draw_max_radius(const struct hair_renderer* renderer, const hair_lod* lod)
{
    return hair_geometry_max_radius(renderer->geometry) * max_widening(renderer, lod);
}

double hair_draw_max_look_radius(const struct hair_renderer* renderer, const hair_lod* lod)
{
    const hair_look* look = &renderer->geometry->look;
    return (double)(look->strand.radius * hair_curve_max(&look->strand.taper)) * max_widening(renderer, lod);
}

// Return how far hair reaches beyond the box of roots, in metres.
static double hair_reach_beyond(const struct hair_renderer* renderer, const hair_lod* lod)
{
    const hair_look* look = &renderer->geometry->look;
    double reach = (double)(GIVE * fmaxf(hair_curve_max(&look->clump.width), 1) * renderer->extent.reach);
    return reach +
           (double)(hair_look_max_stray(look) * renderer->extent.length +
                    hair_geometry_max_offset(renderer->geometry)) +
           hair_draw_max_radius(renderer, lod);
}

static hair_vec3 corner_of(const struct hair_extent* e, double reach, int i)
{
    float r = (float)reach;
    HAIR_ASSERT(reach >= 0);
    return hair_v3(i & 1 ? e->upper.x + r : e->lower.x - r, i & 2 ? e->upper.y + r : e->lower.y - r,
                   i & 4 ? e->upper.z + r : e->lower.z - r);
}

// Transform a corner to clip space. Use doubles, because far from the world's origin the head's
// position and the view matrix nearly cancel.
static void find_corner(const hair_view* view, const struct hair_pose* head, hair_vec3 corner, double clip[4])
{
    hair_vec3 at = hair_rotate(head->rotation, corner);
    const double world[4] = {head->position[0] + (double)at.x, head->position[1] + (double)at.y,
                             head->position[2] + (double)at.z, 1};
    double eye[4] = {0};
    for (int i = 0; i < 16; ++i) eye[i % 4] += (double)view->view[i] * world[i / 4];
    for (int i = 0; i < 4; ++i) clip[i] = 0;
    for (int i = 0; i < 16; ++i) clip[i % 4] += (double)view->projection[i] * eye[i / 4];
}

// Bits of the clip planes. A box whose corners are all outside one plane is wholly outside it,
// because each plane is linear in clip space.
enum { LEFT, RIGHT, BELOW, ABOVE, BEHIND, FAR, NEAR, SIDES };

static unsigned outside_planes(const double clip[4], const double edge[2])
{
    double x = clip[0], y = clip[1], z = clip[2], w = clip[3];
    return (unsigned)(x < -w * edge[0]) << LEFT | (unsigned)(x > w * edge[0]) << RIGHT |
           (unsigned)(y < -w * edge[1]) << BELOW | (unsigned)(y > w * edge[1]) << ABOVE |
           (unsigned)(w < 0) << BEHIND | (unsigned)(z > w) << FAR | (unsigned)(z < -w) << NEAR;
}

bool hair_draw_is_out_of_view(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view)
{
    const struct hair_gl_draw_state* state = &renderer->gl->draw_state;
    double edge[2], reach = hair_reach_beyond(renderer, view->lod);
    unsigned outside = (1u << SIDES) - 1;
    for (int k = 0; k < 2; ++k) edge[k] = hair_draw_edge(state->viewport[2 + k], view->jitter[k]);
    for (int i = 0; i < 8 && outside; ++i) {
        double clip[4];
        find_corner(view, head, corner_of(&renderer->extent, reach, i), clip);
        outside &= outside_planes(clip, edge);
    }
    // If depth clamping is enabled, the near and far planes cut nothing off.
    if (state->clamps_depth) outside &= ~(1u << FAR | 1u << NEAR);
    return outside != 0;
}

double hair_draw_min_w(const struct hair_renderer* renderer, const struct hair_pose* head,
                       const hair_view* view)
{
    double min = INFINITY, reach = hair_reach_beyond(renderer, view->lod);
    for (int i = 0; i < 8; ++i) {
        double clip[4];
        find_corner(view, head, corner_of(&renderer->extent, reach, i), clip);
        min = fmin(min, clip[3]);
    }
    return min;
}

void hair_draw_find_window(const struct hair_renderer* renderer, const struct hair_pose* head,
                           const hair_lod* lod, const hair_mat4* to_texture, float window[4])
{
    float matrix[16], all[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    double reach = hair_reach_beyond(renderer, lod);
    memcpy(matrix, to_texture, sizeof matrix);
    for (int i = 0; i < 8; ++i) {
        hair_vec3 at = hair_rotate(head->rotation, corner_of(&renderer->extent, reach, i));
        float placed[4] = {at.x, at.y, at.z, 1}, out[4] = {0};
        for (int k = 0; k < 16; ++k) out[k % 4] += matrix[k] * placed[k / 4];
        // Hair beside or behind the eye may be anywhere, so the window stays as it is.
        if (!(out[3] > 0)) return;
        for (int k = 0; k < 2; ++k) {
            all[k] = fminf(all[k], out[k] / out[3]);
            all[2 + k] = fmaxf(all[2 + k], out[k] / out[3]);
        }
    }
    for (int k = 0; k < 2; ++k) {
        window[k] = fmaxf(window[k], all[k]);
        window[2 + k] = fminf(window[2 + k], all[2 + k]);
    }
}
