// field_bounds.h - box of the field, and colliders placed in it.
#ifndef HAIR_FIELD_FIELD_BOUNDS_H
#define HAIR_FIELD_FIELD_BOUNDS_H

#include "lib/base/pose.h"
#include "lib/collide/collision_mesh.h"
#include "lib/groom/groom.h"

#define HAIR_FIELD_BAND 4 // Voxels around a collider that hold its distance.
#define HAIR_FIELD_MIN_VOXELS 32 // Minimum number of voxels along the longest side.
// Maximum number of voxels along the longest side.
#define HAIR_FIELD_MAX_VOXELS 256
#define HAIR_FIELD_MIN_VOXEL 1e-4f // Minimum size of a voxel, in metres.

struct hair_field_box {
    hair_vec3 lower; // Lower corner in the head's frame, in metres.
    float voxel; // Size of a voxel, in metres.
    float far; // Distance in metres that stands for all greater ones.
    uint32_t bricks[3];
};

// Return the box that usually contains the hair of a groom. See field_bounds.c.
struct hair_field_box hair_field_box_of(const struct hair_groom* groom, float voxel);

static inline uint32_t hair_field_bricks(const struct hair_field_box* box)
{
    return box->bricks[0] * box->bricks[1] * box->bricks[2];
}

// Collider in the head's frame. The band around it touches the bricks from `first` up to, not
// including, `end`. Equal bounds mean no bricks.
struct hair_placed_collider {
    struct hair_field_collider collider;
    // NULL if the collider is no collision mesh, or one without data.
    const hair_collision_mesh* mesh;
    uint32_t place; // Place of the mesh in hair_sdf_pool.
    uint32_t generation; // Number of shapes that the mesh of a body had then.
    uint16_t first[3], end[3];
};

struct hair_placed_collider hair_field_place(const struct hair_field_box* box, const hair_collider* collider,
                                             uint32_t number, const struct hair_pose* head);

// Return nonzero if a collider has moved or changed by more than the field can resolve.
int hair_field_has_moved(const struct hair_field_box* box, const struct hair_placed_collider* from,
                         const struct hair_placed_collider* to);

// Return whether two placed colliders differ in any bit.
bool hair_field_differs(const struct hair_placed_collider* a, const struct hair_placed_collider* b);

// Move a collider to the pose of an earlier one.
void hair_field_keep_pose(const struct hair_field_box* box, const struct hair_placed_collider* earlier,
                          struct hair_placed_collider* placed);

// Compute the box around a collider in its own axes. A plane gets a part that is worth drawing.
void hair_field_shown_extent(const struct hair_placed_collider* placed, hair_vec3* lower, hair_vec3* upper);

// Bounds of the distances from the voxel centres of a brick to a collider's surface, in metres.
// Distances inside are negative.
struct hair_field_span {
    float min, max;
};
struct hair_field_span hair_field_find_span(const struct hair_field_box* box,
                                            const struct hair_placed_collider* placed, uint32_t x, uint32_t y,
                                            uint32_t z);

static inline int hair_field_is_inside(const struct hair_placed_collider* placed)
{
    return placed->first[0] < placed->end[0];
}

#endif
