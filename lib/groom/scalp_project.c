// scalp_project.c - the closest point on the scalp to each root.
#include "lib/groom/surface.h"

#include <float.h>

static float fraction_along(hair_vec3 a, hair_vec3 b, hair_vec3 p)
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
        float fraction = fraction_along(corner[i], corner[j], p);
        float away = hair_distance(hair_lerp(corner[i], corner[j], fraction), p);
        if (!(away < nearest)) continue;
        nearest = away;
        weight[i] = 1 - fraction;
        weight[j] = fraction;
        weight[(i + 2) % 3] = 0;
    }
}

hair_result hair_surface_build(const struct hair_groom_builder* builder, struct hair_surface* out)
{
    uint32_t count = builder->desc->scalp_triangle_count;
    *out = (struct hair_surface){.builder = builder};
    out->corners = hair_alloc(builder->host, count, 9 * sizeof *out->corners);
    out->indices = hair_alloc(builder->host, count, 3 * sizeof *out->indices);
    if (!out->corners || !out->indices) return hair_fail_memory(builder->host, "the scalp");
    for (uint32_t i = 0; i < 3 * count; ++i) {
        out->indices[i] = i;
        hair_store3(out->corners + 3 * (size_t)i, hair_scalp_corner(builder, i / 3, i % 3));
    }
    return hair_triangles_build(builder->host, out->corners, out->indices, count, &out->triangles);
}

void hair_surface_free(struct hair_surface* surface)
{
    const hair_host* host = surface->builder->host;
    hair_triangles_free(host, &surface->triangles);
    hair_free(host, surface->corners);
    hair_free(host, surface->indices);
}

struct hair_scalp_point hair_surface_find_point(const struct hair_surface* surface, hair_vec3 root)
{
    struct hair_triangles triangles = surface->triangles; // The search counts its work in a copy.
    HAIR_ASSERT(triangles.count > 0);
    float distance = FLT_MAX;
    uint32_t nearest = 0;
    struct hair_scalp_point scalp_point = {0};
    hair_triangles_find(&triangles, hair_sub(root, triangles.center), &distance, &nearest);
    HAIR_ASSERT(nearest < triangles.count);
    scalp_point.triangle = triangles.indices[nearest][0] / 3;
    hair_vec3 corner[3];
    for (uint32_t k = 0; k < 3; ++k) corner[k] = hair_scalp_corner(surface->builder, scalp_point.triangle, k);
    find_foot(corner, root, scalp_point.weight);
    return scalp_point;
}

hair_vec3 hair_candidate_root(const struct hair_groom_builder* builder, uint32_t bin, uint32_t candidate)
{
    // Followers around a guide count as rooted there.
    if (!builder->strand_of) return hair_guide_root(builder->groom, bin);
    HAIR_ASSERT(builder->strand_of[candidate] < builder->strands.strand_count);
    return hair_load3(builder->strands.positions + 3 * (size_t)builder->first[builder->strand_of[candidate]]);
}

struct projection {
    const struct hair_groom_builder* builder;
    const struct hair_surface* surface;
    struct hair_division division; // of the root bins
};

static void project_bins(uint32_t index, void* data)
{
    const struct projection* projection = data;
    const struct hair_groom_builder* builder = projection->builder;
    uint32_t end = hair_division_end(&projection->division, index);
    for (uint32_t bin = index * projection->division.each; bin < end; ++bin)
        for (uint32_t i = 0; i < builder->bin_candidates[bin]; ++i) {
            uint32_t candidate = builder->bin_first[bin] + i;
            builder->scalp_points[candidate] =
                hair_surface_find_point(projection->surface, hair_candidate_root(builder, bin, candidate));
        }
}

hair_result hair_build_scalp_points(struct hair_groom_builder* builder)
{
    if (!builder->scalp || builder->scalp_points) return HAIR_OK;
    struct hair_surface surface;
    hair_result result = hair_surface_build(builder, &surface);
    builder->scalp_points =
        hair_alloc(builder->host, builder->candidate_count, sizeof *builder->scalp_points);
    if (!result && !builder->scalp_points) result = hair_fail_memory(builder->host, "the roots of followers");
    int there = !result && surface.triangles.count > 0; // All triangles may be degenerate.
    struct projection projection = {
        .builder = builder, .surface = &surface, .division = hair_divide(builder->bin_count, 1)};
    if (there) {
        hair_run_tasks(&builder->groom->tasks, project_bins, &projection, projection.division.tasks);
    } else {
        hair_free(builder->host, builder->scalp_points);
        builder->scalp_points = NULL;
    }
    hair_surface_free(&surface);
    return result;
}
