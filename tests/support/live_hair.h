// live_hair.h - strands brought to life as guides, stepped and read, and the same strands as rods
// of the reference.
#ifndef HAIR_TESTS_SUPPORT_LIVE_HAIR_H
#define HAIR_TESTS_SUPPORT_LIVE_HAIR_H

#include "tests/reference/rod.h"
#include "tests/support/grooms.h"
#include "tests/support/support.h"

struct hair_test_living {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance* hair;
    hair_physics physics;
    hair_wind wind;
    uint32_t vertices; // number of all guides' vertices
    float* positions; // xyz, as read last
    float* before; // xyz, as read the time before
};

// Make every strand a guide with as many vertices as it has. Uses desc.physics, or the defaults.
void hair_test_live(struct hair_test* test, const struct hair_test_strands* strands, const hair_desc* desc,
                    struct hair_test_living* out);
void hair_test_die(struct hair_test_living* living);

// Return hair of 0.1 mm and 3 GPa, straight at rest, with only gravity and a little drag.
hair_physics hair_test_bare(void);
// Return the defaults without the gravity preload.
hair_physics hair_test_loose(float friction);
hair_desc hair_test_rods(hair_solver solver, hair_thread_mapping mapping, double substep,
                         const hair_physics* physics);

// Return a straight strand from `root` along `way`, which need not be a unit vector, with even
// spacing.
struct hair_test_strands hair_test_straight(uint32_t vertices, hair_vec3 root, hair_vec3 way, float length);
void hair_test_add_straight(struct hair_test_strands* strands, uint32_t vertices, hair_vec3 root,
                            hair_vec3 way, float length);

// Return a straight strand and a curl, which their rest strain supports.
struct hair_test_strands hair_test_straight_and_curl(void);

// Step. The head is at `head` at the end of the step. NULL keeps it in place.
void hair_test_advance(struct hair_test_living* living, const struct hair_reference_rod_pose* head,
                       double dt);
// Set the wind from the next step on. NULL disables it.
void hair_test_wind_coupling(struct hair_test_living* living, const hair_wind* wind);
// Step `frames` frames of 1/60 s without moving the head.
void hair_test_wait(struct hair_test_living* living, uint32_t frames);
// Read the guides into `positions`. The previous positions become `before`. All must be finite.
void hair_test_read_guides(struct hair_test_living* living);

hair_vec3 hair_test_at(const struct hair_test_living* living, uint32_t guide, uint32_t vertex);
hair_vec3 hair_test_tip(const struct hair_test_living* living, uint32_t guide);
double hair_test_length(const struct hair_test_living* living, uint32_t guide);
// Return the maximum |length / rest length - 1| of a segment, as read last.
double hair_test_stretch(const struct hair_test_living* living);
// Return the maximum distance of a vertex between the last two reads, m.
double hair_test_moved(const struct hair_test_living* living);
// Return the maximum distance of a vertex from its rest pose under the head at the origin, m.
double hair_test_from_rest(const struct hair_test_living* living);

// Return a collider at a place, without rotation and size.
hair_collider hair_test_body(hair_shape shape, float x, float y, float z);
// Rotate a collider about one of its axes.
void hair_test_turn(hair_collider* collider, int axis, double angle);
void hair_test_set_colliders(struct hair_test_living* living, const hair_collider* colliders, uint32_t count);
// Return the maximum depth of a vertex in a collider, m. A negative value is the distance. Roots
// fixed to the scalp do not count.
double hair_test_depth(const struct hair_test_living* living, const hair_collider* collider);

// Check that the first guide slides down a slope of 0.4 rad about z by Coulomb's law, for half a
// second. `friction` is the product of both coefficients.
void hair_test_check_slide(struct hair_test_living* living, const hair_collider* slope, double friction);

hair_solver_stats hair_test_solver_stats(struct hair_test_living* living);
// Check that no guide's substep was repeated and none was reset.
void hair_test_healthy(struct hair_test_living* living);

// Return the guide as a rod of the reference, with its rest shape and physics under the head
// `head`. NULL is the head at the origin. `gravity_preload` of the physics must be 0, or 1 for a
// clamped guide.
struct hair_reference_rod* hair_test_reference(const struct hair_test_living* living, uint32_t guide,
                                               const struct hair_reference_rod_pose* head);
// Return the maximum distance of a vertex from that of the reference, m.
double hair_test_off(const struct hair_test_living* living, uint32_t guide,
                     const struct hair_reference_rod* rod);

struct hair_reference_rod_pose hair_test_pose_of(hair_vec3 position, hair_vec3 axis, double angle);

// Return the strand of the scene by which solvers are compared. It is 0.3 m long and starts 0.1 m
// beside the head's origin, 30 degrees below the horizontal.
struct hair_test_strands hair_test_slanting(uint32_t vertices);
// Return the head of that scene at `time`. It yaws by 0.6 rad and back within a second.
struct hair_reference_rod_pose hair_test_shaken(double time);

#endif
