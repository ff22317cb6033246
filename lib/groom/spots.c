// spots.c - the closest point on the scalp to each root.
#include "lib/groom/surface.h"

#include <float.h>

static float share_along(hair_vec3 a, hair_vec3 b, hair_vec3 p)
{
    hair_vec3 way = hair_sub(b, a);
    float squared = hair_dot(way, way);
    return squared > 0 ? fminf(fmaxf(hair_dot(hair_sub(p, a), way) / squared, 0), 1) : 0;
}

// Compute the barycentric weights of the point of a triangle closest to p. The triangle may have no
// area.
static void find_foot(const hair_vec3 corner[3], hair_vec3 p, float weight[3])
{
    hair_vec3 u = hair_sub(corner[1], corner[0]), v = hair_sub(corner[2], corner[0]),
              w = hair_sub(p, corner[0]);
    hair_vec3 normal = hair_cross(u, v);
    float area = hair_dot(normal, normal), nearest = FLT_MAX;
    if (area > 1e-12f * hair_dot(u, u) * hair_dot(v, v)) {
        weight[1] = hair_dot(hair_cross(w, v), normal) / area;
        weight[2] = hair_dot(hair_cross(u, w), normal) / area;
        weight[0] = 1 - weight[1] - weight[2];
        if (fminf(weight[0], fminf(weight[1], weight[2])) >= 0) return;
    }
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3;
        float share = share_along(corner[i], corner[j], p);
        float away = hair_distance(hair_lerp(corner[i], corner[j], share), p);
        if (!(away < nearest)) continue;
        nearest = away;
        weight[i] = 1 - share;
        weight[j] = share;
        weight[(i + 2) % 3] = 0;
    }
}

hair_result hair_surface_build(const struct hair_draft* draft, struct hair_surface* out)
{
    uint32_t count = draft->desc->scalp_triangle_count;
    *out = (struct hair_surface){.draft = draft};
    out->corners = hair_alloc(draft->host, count, 9 * sizeof *out->corners);
    out->indices = hair_alloc(draft->host, count, 3 * sizeof *out->indices);
    if (!out->corners || !out->indices) return hair_fail_memory(draft->host, "the scalp");
    for (uint32_t i = 0; i < 3 * count; ++i) {
        out->indices[i] = i;
        hair_store3(out->corners + 3 * (size_t)i, hair_scalp_corner(draft, i / 3, i % 3));
    }
    return hair_triangles_build(draft->host, out->corners, out->indices, count, &out->triangles);
}

void hair_surface_free(struct hair_surface* surface)
{
    const hair_host* host = surface->draft->host;
    hair_triangles_free(host, &surface->triangles);
    hair_free(host, surface->corners);
    hair_free(host, surface->indices);
}

struct hair_spot hair_surface_spot(struct hair_surface* surface, hair_vec3 root)
{
    HAIR_ASSERT(surface->triangles.count > 0);
    float distance = FLT_MAX;
    uint32_t nearest = 0;
    struct hair_spot spot = {0};
    hair_triangles_find(&surface->triangles, hair_sub(root, surface->triangles.center), &distance, &nearest);
    HAIR_ASSERT(nearest < surface->triangles.count);
    spot.triangle = surface->triangles.indices[nearest][0] / 3;
    hair_vec3 corner[3];
    for (uint32_t k = 0; k < 3; ++k) corner[k] = hair_scalp_corner(surface->draft, spot.triangle, k);
    find_foot(corner, root, spot.weight);
    return spot;
}

hair_vec3 hair_sprout_root(const struct hair_draft* draft, uint32_t plot, uint32_t sprout)
{
    // Followers around a guide count as rooted there.
    if (!draft->strand_of) return hair_guide_root(draft->groom, plot);
    HAIR_ASSERT(draft->strand_of[sprout] < draft->strands.strand_count);
    return hair_load3(draft->strands.positions + 3 * (size_t)draft->first[draft->strand_of[sprout]]);
}

hair_result hair_draft_spots(struct hair_draft* draft)
{
    if (!draft->scalp || draft->spots) return HAIR_OK;
    struct hair_surface surface;
    hair_result result = hair_surface_build(draft, &surface);
    draft->spots = hair_alloc(draft->host, draft->sprout_count, sizeof *draft->spots);
    if (!result && !draft->spots) result = hair_fail_memory(draft->host, "the roots of followers");
    int there = !result && surface.triangles.count > 0; // All triangles may be degenerate.
    for (uint32_t plot = 0; plot < draft->plot_count && there; ++plot)
        for (uint32_t i = 0; i < draft->plot_sprouts[plot]; ++i) {
            uint32_t sprout = draft->plot_first[plot] + i;
            draft->spots[sprout] = hair_surface_spot(&surface, hair_sprout_root(draft, plot, sprout));
        }
    if (!there) {
        hair_free(draft->host, draft->spots);
        draft->spots = NULL;
    }
    hair_surface_free(&surface);
    return result;
}
