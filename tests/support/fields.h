// fields.h - the field read back, and its expected values by closed forms in double precision.
#ifndef HAIR_TESTS_SUPPORT_FIELDS_H
#define HAIR_TESTS_SUPPORT_FIELDS_H

#include "tests/support/support.h" // before what includes OpenGL's own header

#include "lib/field/field.h"

struct hair_test_field {
    uint32_t size[3];
    float* distance;
    uint32_t* number;
};

// Read back a field that exists.
struct hair_test_field hair_test_field_read(const struct hair_collider_field* field);
void hair_test_field_free(struct hair_test_field* read);

static inline size_t hair_test_field_count(const struct hair_test_field* read)
{
    return (size_t)read->size[0] * read->size[1] * read->size[2];
}

// Return the distance to the nearest collider, or INFINITY without colliders. `number` receives the
// collider's index.
double hair_test_nearest(const hair_collider* colliders, uint32_t count, const double point[3],
                         uint32_t* number);

// Compute the position of the centre of the i-th voxel in the world.
void hair_test_voxel(const struct hair_field_box* box, const struct hair_pose* head, size_t i,
                     double point[3]);

// Return a random collider of any shape except a plane or a collision mesh, within `reach` of the
// middle of the box.
hair_collider hair_test_any_collider(const struct hair_field_box* box, const struct hair_pose* head,
                                     float reach, uint32_t* random);

#endif
