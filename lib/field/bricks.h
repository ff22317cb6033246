// bricks.h - selection of the bricks of the field to write again, and of the colliders that reach
// into each.
#ifndef HAIR_FIELD_BRICKS_H
#define HAIR_FIELD_BRICKS_H

#include "lib/field/field.h"

// Work of one dispatch, which is as many bricks as together have few enough colliders.
struct hair_field_job {
    // By round, which the shader explains. Bricks with collision meshes come after all others.
    struct hair_field_brick* brick;
    uint32_t* brick_collider;
    struct hair_field_collider* collider;
    uint32_t bricks, brick_colliders, colliders;
    uint32_t with_meshes; // Number of bricks with collision meshes.
    // First brick of the field that has not been examined, and the number of all bricks.
    uint32_t next, end;
};

// Mark the bricks that the band around a collider touches.
void hair_field_mark_dirty(struct hair_collider_field* field, const struct hair_placed_collider* placed);

// Begin the dispatches for all marked bricks.
void hair_field_begin(struct hair_collider_field* field, struct hair_field_job* job);
// Free the last dispatch and prepare the next. job->bricks is 0 after the last one.
hair_result hair_field_next(struct hair_collider_field* field, struct hair_field_job* job);
// Free a job. Call this in any case.
void hair_field_end(struct hair_collider_field* field, struct hair_field_job* job);

#endif
