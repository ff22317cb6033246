// scalp_binding.c - root bindings: the roots of guides and followers bound to the scalp's
// triangles.
#include "lib/groom/scalp_binding.h"
#include "lib/groom/surface.h"

#include <string.h>

struct hair_root_bindings* hair_root_bindings_retain(struct hair_root_bindings* root_bindings)
{
    HAIR_ASSERT(!root_bindings || atomic_load(&root_bindings->holders) > 0);
    if (root_bindings) atomic_fetch_add_explicit(&root_bindings->holders, 1, memory_order_relaxed);
    return root_bindings;
}

void hair_root_bindings_release(struct hair_root_bindings* root_bindings)
{
    HAIR_ASSERT(!root_bindings || atomic_load(&root_bindings->holders) > 0);
    if (!root_bindings || atomic_fetch_sub_explicit(&root_bindings->holders, 1, memory_order_acq_rel) != 1)
        return;
    hair_host host = root_bindings->host;
    hair_free(&host, root_bindings->positions);
    hair_free(&host, root_bindings->binding);
    hair_free(&host, root_bindings);
}

static struct hair_root_binding find_root_binding(const struct hair_groom_builder* builder,
                                                  const struct hair_scalp_point* scalp_point, hair_vec3 root)
{
    const uint32_t* corner = builder->desc->scalp_triangles + 3 * (size_t)scalp_point->triangle;
    hair_vec3 foot = {0};
    for (uint32_t k = 0; k < 3; ++k)
        foot = hair_add(
            foot, hair_scale(hair_scalp_corner(builder, scalp_point->triangle, k), scalp_point->weight[k]));
    hair_vec3 away = hair_sub(root, foot);
    return (struct hair_root_binding){.corner0 = corner[0],
                                      .corner1 = corner[1],
                                      .corner2 = corner[2],
                                      .weight1 = scalp_point->weight[1],
                                      .weight2 = scalp_point->weight[2],
                                      .away_x = away.x,
                                      .away_y = away.y,
                                      .away_z = away.z};
}

static void bind_followers(const struct hair_groom_builder* builder, struct hair_root_binding* root_binding)
{
    for (uint32_t bin = 0; bin < builder->bin_count; ++bin)
        for (uint32_t i = 0; i < builder->bin_candidates[bin]; ++i) {
            uint32_t candidate = builder->bin_first[bin] + i;
            const struct hair_scalp_point* scalp_point = &builder->scalp_points[candidate];
            hair_vec3 root = {0};
            if (builder->bin_density) // Root bins are triangles, so the root is on one.
                for (uint32_t k = 0; k < 3; ++k)
                    root = hair_add(root, hair_scale(hair_scalp_corner(builder, scalp_point->triangle, k),
                                                     scalp_point->weight[k]));
            else
                root = hair_candidate_root(builder, bin, candidate);
            HAIR_ASSERT(builder->place[candidate] < builder->groom->info.follower_count);
            root_binding[builder->place[candidate]] = find_root_binding(builder, scalp_point, root);
        }
}

static void place_followers(const struct hair_groom_builder* builder, float* uv)
{
    for (uint32_t candidate = 0; candidate < builder->candidate_count; ++candidate) {
        const struct hair_scalp_point* scalp_point = &builder->scalp_points[candidate];
        const uint32_t* corner = builder->desc->scalp_triangles + 3 * (size_t)scalp_point->triangle;
        float* own = uv + 2 * (size_t)builder->place[candidate];
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 0; i < 2; ++i)
                own[i] += scalp_point->weight[k] * builder->desc->scalp_uvs[2 * (size_t)corner[k] + i];
    }
}

struct guide_binding {
    const struct hair_groom_builder* builder;
    struct hair_surface surface;
    struct hair_root_binding* root_binding;
    struct hair_division division; // of the guides
};

static void bind_some_guides(uint32_t index, void* data)
{
    const struct guide_binding* binding = data;
    uint32_t end = hair_division_end(&binding->division, index);
    for (uint32_t i = index * binding->division.each; i < end; ++i) {
        hair_vec3 root = hair_guide_root(binding->builder->groom, i);
        struct hair_scalp_point scalp_point = hair_surface_find_point(&binding->surface, root);
        binding->root_binding[i] = find_root_binding(binding->builder, &scalp_point, root);
    }
}

static hair_result bind_guides(const struct hair_groom_builder* builder,
                               struct hair_root_binding* root_binding)
{
    struct guide_binding binding = {.builder = builder,
                                    .root_binding = root_binding,
                                    .division =
                                        hair_divide(builder->groom->info.guide_count, HAIR_MIN_TASK_STRANDS)};
    hair_result result = hair_surface_build(builder, &binding.surface);
    if (!result) hair_run_tasks(&builder->groom->tasks, bind_some_guides, &binding, binding.division.tasks);
    hair_surface_free(&binding.surface);
    return result;
}

hair_result hair_build_root_bindings(struct hair_groom_builder* builder)
{
    const hair_groom_info* info = &builder->groom->info;
    if (!builder->scalp_points) return HAIR_OK;
    struct hair_root_bindings* root_bindings = hair_alloc(builder->host, 1, sizeof *root_bindings);
    if (!root_bindings) return hair_fail_memory(builder->host, "the root bindings");
    root_bindings->host = *builder->host;
    root_bindings->vertex_count = builder->desc->scalp_vertex_count;
    root_bindings->count = info->guide_count + info->follower_count;
    atomic_init(&root_bindings->holders, 1);
    HAIR_ASSERT(!builder->groom->root_bindings);
    builder->groom->root_bindings = root_bindings;
    root_bindings->positions =
        hair_alloc(builder->host, root_bindings->vertex_count, 3 * sizeof *root_bindings->positions);
    root_bindings->binding = hair_alloc(builder->host, root_bindings->count, sizeof *root_bindings->binding);
    if (!root_bindings->positions || !root_bindings->binding)
        return hair_fail_memory(builder->host, "the root bindings");
    memcpy(root_bindings->positions, builder->scalp,
           3 * (size_t)root_bindings->vertex_count * sizeof *root_bindings->positions);
    bind_followers(builder, root_bindings->binding + info->guide_count);
    if (builder->desc->scalp_uvs) {
        float* uvs = hair_alloc(builder->host, info->follower_count, 2 * sizeof *uvs);
        if (!uvs) return hair_fail_memory(builder->host, "the places of roots");
        place_followers(builder, uvs);
        builder->groom->root_uvs = uvs;
    }
    return bind_guides(builder, root_bindings->binding);
}
