// place.h - where the field is, and where solids are in it.
#ifndef HAIR_FIELD_PLACE_H
#define HAIR_FIELD_PLACE_H

#include "lib/base/pose.h"
#include "lib/collide/form.h"
#include "lib/groom/groom.h"

#define HAIR_FIELD_BAND 4 // voxels around a solid that know how far it is
#define HAIR_FIELD_SHORTEST 32 // voxels along the longest side,
#define HAIR_FIELD_LONGEST 256
#define HAIR_FIELD_LEAST 1e-4f // m: a voxel

struct hair_field_box {
    hair_vec3 lower; // corner, m, in the head's frame
    float voxel; // m
    float far; // m: stands for every distance beyond it
    uint32_t bricks[3];
};

// The box in which hair of the groom is, as a rule: see place.c.
struct hair_field_box hair_field_box_of(const struct hair_groom* groom, float voxel);

static inline uint32_t hair_field_bricks(const struct hair_field_box* box)
{
    return box->bricks[0] * box->bricks[1] * box->bricks[2];
}

// A solid in the head's frame, and the bricks from `first` up to, not including, `end` that the band around it touches:
// none where they are alike.
struct hair_placed {
    struct hair_field_solid solid;
    const hair_form* form; // NULL: it is none, or one without its mesh
    uint32_t place; // of the form among hair_forms
    uint16_t first[3], end[3];
};

struct hair_placed hair_field_place(const struct hair_field_box* box, const hair_solid* solid,
                                    uint32_t number, const struct hair_pose* head);

// Whether a solid has moved or changed by more than a field can show.
int hair_field_has_moved(const struct hair_field_box* box, const struct hair_placed* from,
                         const struct hair_placed* to);

// The box around a solid in its own axes; of a plane, as much as is worth drawing.
void hair_field_shown_extent(const struct hair_placed* placed, hair_vec3* lower, hair_vec3* upper);

// From the centres of a brick's voxels to the solid's surface: no less and no more than this. m, below 0 inside.
struct hair_field_span {
    float least, most;
};
struct hair_field_span hair_field_span_of(const struct hair_field_box* box, const struct hair_placed* placed,
                                          uint32_t x, uint32_t y, uint32_t z);

static inline int hair_field_is_inside(const struct hair_placed* placed)
{
    return placed->first[0] < placed->end[0];
}

#endif
