// cells.h - which of any number of solids hair can meet where: a grid of lists, for one step, from the head's origin.
//
// The list of a cell has what comes, at some time of the step, as near to it as `give` says. Cells at the grid's faces
// go on without end, so that every place has a list. A list of too many keeps the nearest.
#ifndef HAIR_COLLIDE_CELLS_H
#define HAIR_COLLIDE_CELLS_H

#include "lib/collide/solid.h"

struct hair_cells_desc {
    float reach; // no hair is farther from the head's origin along any axis, m
    float give; // m
    float margin; // m
    float share_start; // of the step that has been done, may be below 0: solids move from there to 1
    uint32_t most_rounds; // of walks in a list together: see hair_member_rounds
};

struct hair_cell_bounds {
    float lower[3], upper[3]; // m
};

struct hair_cells {
    struct hair_contact* contact; // those in reach, in the order of solids
    uint32_t* solid; // which of them each is
    uint32_t* member; // how lists have it,
    struct hair_cell_bounds* bounds; // and where
    uint32_t contacts, room;
    uint32_t bodies; // of them, that are no spheres or capsules
    uint32_t* entry; // as HAIR_UNIT_CELL has it
    uint32_t entries, entry_room;
    struct hair_contact* last; // that the lists are of, and what else they depend on
    uint32_t last_contacts, last_room;
    struct hair_cells_desc made_for;
    hair_vec3 lower; // corner, m
    float size; // of a cell, m
    uint32_t cells[3];
    uint32_t rounds, longest; // of walks in the worst list, and solids in the longest
    uint32_t left_out; // solids that are missing in some list
};

// The contacts, without the places of forms' nodes. On failure there are none.
hair_result hair_cells_gather(const hair_host* host, struct hair_cells* cells,
                              const struct hair_solids* solids, const struct hair_pose* head_before,
                              const struct hair_pose* head_now, const struct hair_cells_desc* desc);

// Their lists. `changed`: 0 when they and the contacts are what they were the last time.
hair_result hair_cells_list(const hair_host* host, struct hair_cells* cells,
                            const struct hair_cells_desc* desc, int* changed);
void hair_cells_free(const hair_host* host, struct hair_cells* cells);

// How often loops go round at most to get out of a solid that is walked through, beside once to look at it.
uint32_t hair_member_rounds(uint32_t member);

#endif
