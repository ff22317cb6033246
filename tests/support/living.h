// living.h - strands brought to life as guides, stepped and read; and the same strands as rods of the reference.
#ifndef HAIR_TESTS_SUPPORT_LIVING_H
#define HAIR_TESTS_SUPPORT_LIVING_H

#include "lib/reference/rod.h"
#include "tests/support/grooms.h"
#include "tests/support/support.h"

struct hair_test_living {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance* hair;
    hair_physics physics;
    hair_wind wind;
    uint32_t vertices; // of all guides
    float* positions; // where they were when read last, xyz
    float* before; // and the time before
};

// Every strand is a guide of as many vertices as it has. Uses desc.physics, or the defaults.
void hair_test_live(struct hair_test* test, const struct hair_test_strands* strands, const hair_desc* desc,
                    struct hair_test_living* out);
void hair_test_die(struct hair_test_living* living);

// Hair of 0.1 mm and 3 GPa, straight where nothing pulls at it, with nothing but gravity and a little drag.
hair_physics hair_test_bare(void);
// The defaults, but that nothing holds the groom's shape.
hair_physics hair_test_loose(float friction);
hair_desc hair_test_rods(hair_solver solver, hair_mapping mapping, double substep,
                         const hair_physics* physics);

// Straight, from `root` along `way`, which need not be unit; evenly spaced.
struct hair_test_strands hair_test_straight(uint32_t vertices, hair_vec3 root, hair_vec3 way, float length);
void hair_test_add_straight(struct hair_test_strands* strands, uint32_t vertices, hair_vec3 root,
                            hair_vec3 way, float length);

// The head is at `head` at the end of the step; NULL: it stays.
void hair_test_advance(struct hair_test_living* living, const struct hair_reference_rod_pose* head,
                       double dt);
// From the next step on; NULL: there is none.
void hair_test_blow(struct hair_test_living* living, const hair_wind* wind);
// Of `frames` frames of 1/60 s, the head as it is.
void hair_test_wait(struct hair_test_living* living, uint32_t frames);
// Into positions, which become `before`. All must be finite.
void hair_test_read_guides(struct hair_test_living* living);

hair_vec3 hair_test_at(const struct hair_test_living* living, uint32_t guide, uint32_t vertex);
hair_vec3 hair_test_tip(const struct hair_test_living* living, uint32_t guide);
double hair_test_length(const struct hair_test_living* living, uint32_t guide);
// Of what was read last: largest |length / rest length - 1| of a segment.
double hair_test_stretch(const struct hair_test_living* living);
// Farthest that a vertex is from where it was when read the time before. m.
double hair_test_moved(const struct hair_test_living* living);
// Farthest that a vertex is from its rest pose under the head at the origin. m.
double hair_test_from_rest(const struct hair_test_living* living);

// A solid at a place, turned by no angle and of no size; and turned about one of its axes.
hair_solid hair_test_body(hair_shape shape, float x, float y, float z);
void hair_test_turn(hair_solid* solid, int axis, double angle);
void hair_test_set_solids(struct hair_test_living* living, const hair_solid* solids, uint32_t count);
// How far a vertex is in a solid at most; negative: how near. A root that the scalp holds does not count. m.
double hair_test_depth(const struct hair_test_living* living, const hair_solid* solid);

hair_health hair_test_health(struct hair_test_living* living);
// No guide's substep was redone, none was put back.
void hair_test_healthy(struct hair_test_living* living);

// The guide as a rod of the reference: its rest shape, its physics, under the head `head` (NULL: at the origin).
// `hold` of the physics must be 0, or 1 of a clamped one.
struct hair_reference_rod* hair_test_reference(const struct hair_test_living* living, uint32_t guide,
                                               const struct hair_reference_rod_pose* head);
// Farthest that a vertex is from the reference's. m.
double hair_test_off(const struct hair_test_living* living, uint32_t guide,
                     const struct hair_reference_rod* rod);

struct hair_reference_rod_pose hair_test_pose_of(hair_vec3 position, hair_vec3 axis, double angle);

// The scene by which solvers are compared: a strand of 0.3 m, from 0.1 m beside the head's origin and 30 degrees below
// the horizontal; and the head at `time`, which yaws by 0.6 rad and back within a second.
struct hair_test_strands hair_test_slanting(uint32_t vertices);
struct hair_reference_rod_pose hair_test_shaken(double time);

#endif
