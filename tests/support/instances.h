// instances.h - instances that a program tests by every solver and mapping.
#ifndef HAIR_TESTS_SUPPORT_INSTANCES_H
#define HAIR_TESTS_SUPPORT_INSTANCES_H

#include "tests/support/scene.h"

// Solver and mapping of this run.
extern int hair_test_instance_way;
// Run all tests for every solver and mapping. Return the number of failures, for main().
int hair_test_run_every_way(const struct CMUnitTest* tests, size_t count);

// Set the identity.
void hair_test_set_identity(float out[16]);
// Make a rotation about the y axis and a translation.
void hair_test_set_pose(float angle, float x, float y, float z, float out[16]);
// Make an instance by the solver and the mapping of this run.
hair_instance* hair_test_instance_make(struct hair_test* test, const hair_groom* groom);
// Swing the head to and fro around x, for `steps` steps of 1/60 s.
void hair_test_instance_swing(struct hair_test* test, hair_instance* hair, float x, int steps);

#endif
