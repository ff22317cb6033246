// guides.h - Guides of a groom: their vertices, their rods of the reference, and their contacts.
#ifndef HAIR_TOOLS_VIEW_GUIDES_H
#define HAIR_TOOLS_VIEW_GUIDES_H

#include <hair/hair.h>

#include "tests/reference/rod.h"

#include <stdbool.h>

// Vertices of a guide among those of all guides.
struct view_guide {
    uint32_t first, count;
};
struct view_guide view_guide_of(const hair_groom* groom, uint32_t guide);

// Return a guide vertex at rest in the head's frame: xyz, and the distance to the next vertex, m.
const float* view_guide_rest(const hair_groom* groom, uint32_t vertex);

// Create a guide at rest as a rod of the reference, with the stiffness by which the library lets it
// hold its groom. Return NULL if the guide cannot hold its groom, or if it is no rod.
struct hair_reference_rod* view_guide_rod(const hair_instance* hair, const hair_groom* groom, uint32_t guide,
                                          const hair_physics* physics, const hair_wind* wind,
                                          const struct hair_reference_rod_pose* head);

// Return whether a vertex of a guide touches a collider. The scalp holds the first two vertices.
bool view_guide_touches(const double* positions, uint32_t vertices, const hair_collider* colliders,
                        uint32_t count, double margin);
// Return the distance of a point from the nearest collider, m.
double view_guide_distance(const double point[3], const hair_collider* colliders, uint32_t count);

// Return whether a collider is the mesh of a hair_body, whose distances only the GPU knows.
bool view_is_body(const hair_collider* collider);

// Write the index of the patch of each follower.
void view_find_patches(const hair_groom* groom, uint32_t* out);

#endif
