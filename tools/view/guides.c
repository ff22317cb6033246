// guides.c - Guides of a groom: their vertices, their rods of the reference, and their contacts.
#include "tools/view/guides.h"

#include "lib/api/api.h"
#include "lib/collide/distance.h"
#include "tests/reference/guide_rod.h"

#include <math.h>

struct view_guide view_guide_of(const hair_groom* groom, uint32_t guide)
{
    return (struct view_guide){groom->guides[guide].first, groom->guides[guide].count};
}

const float* view_guide_rest(const hair_groom* groom, uint32_t vertex)
{
    return &groom->rest[vertex].position.x;
}

struct hair_reference_rod* view_guide_rod(const hair_instance* hair, const hair_groom* groom, uint32_t guide,
                                          const hair_physics* physics, const hair_wind* wind,
                                          const struct hair_reference_rod_pose* head)
{
    struct hair_guide alone = groom->guides[guide];
    const struct hair_rest* rest = groom->rest + alone.first;
    struct hair_rod_borne borne[HAIR_MAX_GUIDE_VERTICES] = {0};
    double stiffen[HAIR_MAX_GUIDE_VERTICES];
    struct hair_rods_report report;
    alone.first = 0;
    if (hair_rods_preload_gravity(NULL, &alone, rest, 1, physics, borne, &report) || report.sagging)
        return NULL;
    for (uint32_t i = 0; i < alone.count; ++i) stiffen[i] = borne[i].stiffen;
    const struct hair_reference_guide_rod desc = {.guide = &alone,
                                                  .rest = rest,
                                                  .physics = physics,
                                                  .wind = wind,
                                                  .stiffen = stiffen,
                                                  .is_mixed = hair_sim_is_mixed(&hair->sim),
                                                  .head = head};
    return hair_reference_guide_rod_create(&desc);
}

bool view_is_body(const hair_collider* collider)
{
    return collider->shape == HAIR_SHAPE_MESH && collider->mesh && collider->mesh->home;
}

double view_guide_distance(const double point[3], const hair_collider* colliders, uint32_t count)
{
    double nearest = INFINITY;
    for (uint32_t k = 0; k < count; ++k)
        nearest = fmin(nearest, hair_distance_to_collider(colliders + k, point, NULL));
    return nearest;
}

bool view_guide_touches(const double* positions, uint32_t vertices, const hair_collider* colliders,
                        uint32_t count, double margin)
{
    for (uint32_t i = 2; i < vertices; ++i)
        if (view_guide_distance(positions + 3 * i, colliders, count) < margin) return true;
    return false;
}

void view_find_patches(const hair_groom* groom, uint32_t* out)
{
    for (uint32_t i = 0; i < groom->info.patch_count; ++i) {
        const struct hair_patch* patch = &groom->patches[i];
        for (uint32_t k = patch->first; k < patch->first + patch->count; ++k) out[k] = i;
    }
}
