// grid.h - the colliders that hair can touch in one step, as a grid of lists. Positions are
// relative to the head.
//
// The list of a cell has every collider that comes within `slack` of the cell at some time of the
// step. Cells at the grid's faces extend to infinity, so that every point has a list. A list that
// would be too long keeps the nearest colliders.
#ifndef HAIR_COLLIDE_GRID_H
#define HAIR_COLLIDE_GRID_H

#include "lib/collide/collider.h"

struct hair_collider_grid_desc {
    float reach; // maximum distance of hair from the head's origin along any axis, m
    float slack; // distance from a cell within which its list has colliders, m
    float margin; // further distance around colliders, m
    // Fraction of the step that is already done. It may be negative. Colliders move from there to
    // 1.
    float fraction_start;
    uint32_t max_rounds; // maximum sum of hair_entry_rounds() over a list
};

struct hair_cell_bounds {
    float lower[3], upper[3]; // m
};

struct hair_collider_grid {
    struct hair_contact* contact; // colliders in reach, in the order of the application
    uint32_t* collider; // number of each contact's collider
    uint32_t* member; // entry of each contact in lists
    struct hair_cell_bounds* bounds; // of each contact
    uint32_t contacts, room;
    uint32_t bodies; // number of contacts that are no spheres or capsules
    uint32_t* entry; // lists, in the layout of HAIR_UNIT_CELL
    uint32_t entries, entry_room;
    struct hair_contact* last; // contacts that the lists were made from
    uint32_t last_contacts, last_room;
    struct hair_collider_grid_desc made_for; // settings that the lists were made with
    hair_vec3 lower; // corner of the grid, m
    float size; // side of a cell, m
    uint32_t cells[3];
    uint32_t rounds, longest; // sum of rounds in the worst list, and colliders in the longest list
    uint32_t left_out; // maximum number of colliders missing in a list
};

// Gather the contacts, without the offsets of collision meshes' nodes. On failure there are none.
hair_result hair_collider_grid_gather(const hair_host* host, struct hair_collider_grid* grid,
                                      const struct hair_colliders* colliders,
                                      const struct hair_pose* head_before, const struct hair_pose* head_now,
                                      const struct hair_collider_grid_desc* desc);

// Make the lists of the contacts. `changed` becomes 0 if lists and contacts are the same as in the
// last call.
hair_result hair_collider_grid_build(const hair_host* host, struct hair_collider_grid* grid,
                                     const struct hair_collider_grid_desc* desc, int* changed);
void hair_collider_grid_free(const hair_host* host, struct hair_collider_grid* grid);

// Return the maximum number of iterations that move a vertex out of a collider, apart from the
// first test. It is 0 for spheres and capsules.
uint32_t hair_entry_rounds(uint32_t member);

#endif
