// collided.h - hair whose followers are in colliders, on the GPU and in the reference.
#ifndef HAIR_TESTS_SUPPORT_COLLIDED_H
#define HAIR_TESTS_SUPPORT_COLLIDED_H

#include "tests/support/scene.h"

#define HAIR_TEST_COLLIDED_COLLIDERS 3

// Hair with scattered guides and colliders among them, also smoothed by the reference.
struct hair_test_collided {
    struct hair_test_scene scene;
    hair_look look;
    struct hair_reference_sample* samples;
    hair_collider colliders[HAIR_TEST_COLLIDED_COLLIDERS];
};

// Create the hair. With `alone`, each follower has one guide. Otherwise a follower's guides lie
// anywhere on the ball, and followers do not resemble hair.
struct hair_test_collided hair_test_collided_start(struct hair_test* test, int alone);
// Free all.
void hair_test_collided_finish(struct hair_test_collided* f);
// Find the follower's point at t in [0, 1].
void hair_test_collided_point(const struct hair_test_collided* f, uint32_t number, double t,
                              const struct hair_reference_repair* repair, struct hair_reference_point* out);
// Return the distance to the nearest collider, by closed forms.
double hair_test_collided_distance(const struct hair_test_collided* f, const double p[3]);
// Read the vertices of followers under that law, to be freed.
float* hair_test_collided_read(struct hair_test_collided* f, hair_follower_collision collision);
// Read `each` bytes per follower from a buffer.
void hair_test_collided_read_buffer(struct hair_test_collided* f, GLuint buffer, size_t each, void* out);

#endif
