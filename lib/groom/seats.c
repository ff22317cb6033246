// seats.c - root bindings: the roots of guides and followers bound to the scalp's triangles.
#include "lib/groom/seats.h"
#include "lib/groom/surface.h"

#include <string.h>

struct hair_seats* hair_seats_hold(struct hair_seats* seats)
{
    HAIR_ASSERT(!seats || atomic_load(&seats->holders) > 0);
    if (seats) atomic_fetch_add_explicit(&seats->holders, 1, memory_order_relaxed);
    return seats;
}

void hair_seats_release(struct hair_seats* seats)
{
    HAIR_ASSERT(!seats || atomic_load(&seats->holders) > 0);
    if (!seats || atomic_fetch_sub_explicit(&seats->holders, 1, memory_order_acq_rel) != 1) return;
    hair_host host = seats->host;
    hair_free(&host, seats->positions);
    hair_free(&host, seats->seat);
    hair_free(&host, seats->uv);
    hair_free(&host, seats);
}

static struct hair_seat seat_of(const struct hair_draft* draft, const struct hair_spot* spot, hair_vec3 root)
{
    const uint32_t* corner = draft->desc->scalp_triangles + 3 * (size_t)spot->triangle;
    hair_vec3 foot = {0};
    for (uint32_t k = 0; k < 3; ++k)
        foot = hair_add(foot, hair_scale(hair_scalp_corner(draft, spot->triangle, k), spot->weight[k]));
    hair_vec3 away = hair_sub(root, foot);
    return (struct hair_seat){.corner0 = corner[0],
                              .corner1 = corner[1],
                              .corner2 = corner[2],
                              .weight1 = spot->weight[1],
                              .weight2 = spot->weight[2],
                              .away_x = away.x,
                              .away_y = away.y,
                              .away_z = away.z};
}

static void seat_followers(const struct hair_draft* draft, struct hair_seat* seat)
{
    for (uint32_t plot = 0; plot < draft->plot_count; ++plot)
        for (uint32_t i = 0; i < draft->plot_sprouts[plot]; ++i) {
            uint32_t sprout = draft->plot_first[plot] + i;
            const struct hair_spot* spot = &draft->spots[sprout];
            hair_vec3 root = {0};
            if (draft->plot_density) // Root bins are triangles, so the root is on one.
                for (uint32_t k = 0; k < 3; ++k)
                    root = hair_add(root,
                                    hair_scale(hair_scalp_corner(draft, spot->triangle, k), spot->weight[k]));
            else
                root = hair_sprout_root(draft, plot, sprout);
            HAIR_ASSERT(draft->place[sprout] < draft->groom->info.follower_count);
            seat[draft->place[sprout]] = seat_of(draft, spot, root);
        }
}

static void place_followers(const struct hair_draft* draft, float* uv)
{
    for (uint32_t sprout = 0; sprout < draft->sprout_count; ++sprout) {
        const struct hair_spot* spot = &draft->spots[sprout];
        const uint32_t* corner = draft->desc->scalp_triangles + 3 * (size_t)spot->triangle;
        float* own = uv + 2 * (size_t)draft->place[sprout];
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 0; i < 2; ++i)
                own[i] += spot->weight[k] * draft->desc->scalp_uvs[2 * (size_t)corner[k] + i];
    }
}

static hair_result seat_guides(const struct hair_draft* draft, struct hair_seat* seat)
{
    struct hair_surface surface;
    hair_result result = hair_surface_build(draft, &surface);
    for (uint32_t i = 0; i < draft->groom->info.guide_count && !result; ++i) {
        hair_vec3 root = hair_guide_root(draft->groom, i);
        struct hair_spot spot = hair_surface_spot(&surface, root);
        seat[i] = seat_of(draft, &spot, root);
    }
    hair_surface_free(&surface);
    return result;
}

hair_result hair_draft_seats(struct hair_draft* draft)
{
    const hair_groom_info* info = &draft->groom->info;
    if (!draft->spots) return HAIR_OK;
    struct hair_seats* seats = hair_alloc(draft->host, 1, sizeof *seats);
    if (!seats) return hair_fail_memory(draft->host, "the seats of roots");
    seats->host = *draft->host;
    seats->vertex_count = draft->desc->scalp_vertex_count;
    seats->count = info->guide_count + info->follower_count;
    atomic_init(&seats->holders, 1);
    HAIR_ASSERT(!draft->groom->seats);
    draft->groom->seats = seats;
    seats->positions = hair_alloc(draft->host, seats->vertex_count, 3 * sizeof *seats->positions);
    seats->seat = hair_alloc(draft->host, seats->count, sizeof *seats->seat);
    if (!seats->positions || !seats->seat) return hair_fail_memory(draft->host, "the seats of roots");
    memcpy(seats->positions, draft->scalp, 3 * (size_t)seats->vertex_count * sizeof *seats->positions);
    seat_followers(draft, seats->seat + info->guide_count);
    if (draft->desc->scalp_uvs) {
        seats->uv = hair_alloc(draft->host, info->follower_count, 2 * sizeof *seats->uv);
        if (!seats->uv) return hair_fail_memory(draft->host, "the places of roots");
        place_followers(draft, seats->uv);
    }
    return seat_guides(draft, seats->seat);
}
