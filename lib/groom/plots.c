// plots.c - root bins, which followers grow on. They are guides or scalp triangles.
#include "lib/groom/draft.h"

static hair_result make_room(struct hair_draft* draft, uint32_t count)
{
    draft->plot_count = count;
    draft->plot_sprouts = hair_alloc(draft->host, count, sizeof *draft->plot_sprouts);
    draft->plot_first = hair_alloc(draft->host, count, sizeof *draft->plot_first);
    draft->plot_centres = hair_alloc(draft->host, count, 3 * sizeof *draft->plot_centres);
    if (!draft->plot_sprouts || !draft->plot_first || !draft->plot_centres)
        return hair_fail_memory(draft->host, "followers");
    return HAIR_OK;
}

hair_result hair_guide_plots(struct hair_draft* draft)
{
    uint32_t guides = draft->groom->info.guide_count;
    hair_result result = make_room(draft, guides);
    if (result) return result;
    for (uint32_t i = 0; i < guides; ++i)
        hair_store3(draft->plot_centres + 3 * (size_t)i, hair_guide_root(draft->groom, i));
    return HAIR_OK;
}

hair_result hair_scalp_plots(struct hair_draft* draft)
{
    uint32_t triangles = draft->desc->scalp_triangle_count;
    hair_result result = make_room(draft, triangles);
    if (result) return result;
    draft->plot_density = draft->density;
    for (uint32_t i = 0; i < triangles; ++i) {
        hair_vec3 a = hair_scalp_corner(draft, i, 0), b = hair_scalp_corner(draft, i, 1);
        hair_vec3 sum = hair_add(hair_scalp_corner(draft, i, 2), hair_add(a, b));
        hair_store3(draft->plot_centres + 3 * (size_t)i, hair_scale(sum, 1.0f / 3));
    }
    return HAIR_OK;
}

void hair_number_sprouts(struct hair_draft* draft)
{
    HAIR_ASSERT(draft->sprout_count == 0);
    for (uint32_t i = 0; i < draft->plot_count; ++i) {
        draft->plot_first[i] = draft->sprout_count;
        draft->sprout_count += draft->plot_sprouts[i];
    }
}

hair_vec3 hair_guide_root(const struct hair_groom* groom, uint32_t guide)
{
    HAIR_ASSERT(guide < groom->info.guide_count);
    hair_vec4 p = groom->rest[groom->guides[guide].first].position;
    return hair_v3(p.x, p.y, p.z);
}

hair_vec3 hair_scalp_corner(const struct hair_draft* draft, uint32_t triangle, uint32_t corner)
{
    HAIR_ASSERT(triangle < draft->desc->scalp_triangle_count && corner < 3);
    uint32_t vertex = draft->desc->scalp_triangles[3 * (size_t)triangle + corner];
    return hair_load3(draft->scalp + 3 * (size_t)vertex);
}
