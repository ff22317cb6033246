// redblack.h - hair with a state and parameters for the solver redblack and for its reference.
#ifndef HAIR_TESTS_SUPPORT_REDBLACK_H
#define HAIR_TESTS_SUPPORT_REDBLACK_H

#include "tests/support/scene.h"

#define HAIR_TEST_REDBLACK_STATES 4096 // Maximum number of guide vertices in a test.

// Hair with its state and the parameters of a step, which switch parts of the solver on or off.
struct hair_test_redblack {
    struct hair_test_scene scene;
    struct hair_step_params params;
    struct hair_state state[HAIR_TEST_REDBLACK_STATES];
    uint32_t random;
};

// Start with all of the solver switched off. Only pinned vertices move.
struct hair_test_redblack hair_test_redblack_start_with(struct hair_test* test,
                                                        struct hair_test_handmade wanted);
// Start so with one guide of each number of vertices up to `max`.
struct hair_test_redblack hair_test_redblack_start(struct hair_test* test, uint32_t max);
// Move every vertex at random, by up to `away` along each axis and `moved` in its last motion.
void hair_test_redblack_scatter(struct hair_test_redblack* f, float away, float moved);
// Rotate and move the head during the step.
void hair_test_redblack_move_head(struct hair_test_redblack* f);
// Put three capsules into the hair.
void hair_test_redblack_add_colliders(struct hair_test_redblack* f);
// Switch all of the solver on, with a moving head and colliders.
void hair_test_redblack_switch_on(struct hair_test_redblack* f);
// Return the maximum error of a position by the probabilistic bound of Higham and Mary 2019 ("A
// New Approach to Probabilistic Rounding Error Analysis").
//
// After n operations the error is at most l sqrt(n) u |x|, except for a fraction 2 exp(-l^2 / 2) of
// all cases. Here u = 2^-24 is the unit roundoff. |x| is at most 1 m, the distance from the head's
// origin. A million comparisons need l = 6.
//
// n counts operations that round at the size of a position. All others work on differences between
// neighbours, which are a hundredth of it. A substep has 4 operations to integrate, and 4 for the
// angular force. An iteration has 1 for each of two distance and two bend links, and 2 for each
// collider.
//
// Constraints hardly increase errors. A link divides errors among its ends, and no collider here
// pushes by more than half its radius. Hence the factor 2.
double hair_test_redblack_tolerance(const struct hair_test_redblack* f);
// Run a pass of the solver with the state, and read the state back.
void hair_test_redblack_run_pass(struct hair_test_redblack* f, hair_gl_pass pass);
// Run the pass that the library selects.
void hair_test_redblack_run(struct hair_test_redblack* f);
// Convert a vertex for the reference.
struct hair_reference_vertex hair_test_redblack_vertex(const struct hair_state* state);
// Step the GPU and the reference from one state. Check that their results agree.
void hair_test_redblack_compare(struct hair_test_redblack* f, const char* what);

#endif
