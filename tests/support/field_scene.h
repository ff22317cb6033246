// field_scene.h - a field of colliders around hair, and a check of its voxels.
#ifndef HAIR_TESTS_SUPPORT_FIELD_SCENE_H
#define HAIR_TESTS_SUPPORT_FIELD_SCENE_H

#include "tests/support/fields.h" // before what includes OpenGL's own header

#define HAIR_TEST_FIELD_VOXEL 0.008f // m
#define HAIR_TEST_FIELD_COLLIDERS 20

// A field around the hair of a handmade groom.
struct hair_test_field_scene {
    struct hair_test* test;
    hair_groom* groom;
    struct hair_collider_field field;
    struct hair_pose head;
    hair_collider colliders[HAIR_TEST_FIELD_COLLIDERS];
    uint32_t random;
};

// Create the field with random colliders, which are not in the field yet.
void hair_test_field_begin(struct hair_test* test, struct hair_pose head, struct hair_test_field_scene* out);
// Free the field and the groom.
void hair_test_field_end(struct hair_test_field_scene* f);
// Update the field with the first `count` colliders.
void hair_test_field_update(struct hair_test_field_scene* f, uint32_t count);
// Check the contents of every voxel against the distance to the first `count` colliders.
void hair_test_field_check(struct hair_test_field_scene* f, uint32_t count);

#endif
