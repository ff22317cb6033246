// bricks.h - which bricks of the field are written again, and which solids reach into each of them.
#ifndef HAIR_FIELD_BRICKS_H
#define HAIR_FIELD_BRICKS_H

#include "lib/field/field.h"

// What a dispatch is to do: as many bricks as have few enough solids together.
struct hair_field_job {
    struct hair_field_brick* brick;
    uint32_t* member;
    struct hair_field_solid* solid;
    uint32_t bricks, members, solids;
    uint32_t with_forms; // of bricks: the last ones
    uint32_t next, end; // bricks of the field: the first that has not been looked at, and all
};

// Mark the bricks that the band around a solid touches.
void hair_field_mark(struct hair_solid_field* field, const struct hair_placed* placed);

// All that is marked, dispatch after dispatch; after the last one job->bricks is 0. `end` is called in any case.
void hair_field_begin(struct hair_solid_field* field, struct hair_field_job* job);
hair_result hair_field_next(struct hair_solid_field* field, struct hair_field_job* job);
void hair_field_end(struct hair_solid_field* field, struct hair_field_job* job);

#endif
