// rod_bodies_test.c - strands as rods on boxes, cylinders, cones and planes: at rest, swept, spun,
// and held by friction.
#include "lib/collide/distance.h"
#include "tests/support/live_hair.h"

#include <math.h>

#define SOLVERS HAIR_SOLVER_REDBLACK // The number of solvers before redblack.
#define MARGIN 1e-3

// Return the maximum depth of a vertex in a collider or its margin. A negative value is the
// distance.
static double depth(const struct hair_test_living* living, const hair_collider* collider)
{
    return MARGIN + hair_test_depth(living, collider);
}

static void live(struct hair_test* test, int solver, hair_vec3 way, const hair_physics* physics,
                 struct hair_test_strands* strands, struct hair_test_living* out)
{
    hair_desc desc = hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_AUTO, 0, physics);
    *strands = hair_test_straight(32, hair_v3(0, 0, 0), way, 0.3f);
    hair_test_live(test, strands, &desc, out);
}

// Check a strand that starts level and comes to hang over an edge, a curved surface, a flank, or
// the ground.
static void strand_on_any_shape_stays_outside_and_comes_to_rest(void** state)
{
    hair_collider bodies[] = {hair_test_body(HAIR_SHAPE_BOX, 0.08f, -0.05f, 0),
                              hair_test_body(HAIR_SHAPE_BOX, 0.08f, -0.05f, 0),
                              hair_test_body(HAIR_SHAPE_CYLINDER, 0.1f, -0.06f, 0),
                              hair_test_body(HAIR_SHAPE_CONE, 0.12f, -0.12f, 0),
                              hair_test_body(HAIR_SHAPE_PLANE, 0, -0.1f, 0),
                              hair_test_body(HAIR_SHAPE_ELLIPSOID, 0.1f, -0.06f, 0)};
    bodies[0].size[0] = 0.06f, bodies[0].size[1] = 0.03f, bodies[0].size[2] = 0.2f;
    bodies[1] = bodies[0];
    bodies[1].rounding = 0.01f;
    bodies[2].size[0] = 0.05f, bodies[2].size[1] = 0.2f;
    bodies[3].size[0] = 0.1f, bodies[3].size[1] = 0.1f;
    bodies[5].size[0] = 0.09f, bodies[5].size[1] = 0.05f, bodies[5].size[2] = 0.2f;
    hair_test_turn(&bodies[1], 2, 0.5);
    hair_test_turn(&bodies[2], 0, 1.5707963);
    hair_physics physics = hair_test_loose(0.3f);
    for (size_t n = 0; n < sizeof bodies / sizeof *bodies; ++n)
        for (int solver = 0; solver < (n % 3 ? 1 : SOLVERS); ++solver) {
            struct hair_test_living living;
            struct hair_test_strands strands;
            double deepest = -INFINITY;
            live(*state, solver, hair_v3(1, 0, 0.05f), &physics, &strands, &living);
            hair_test_set_colliders(&living, &bodies[n], 1);
            for (int k = 0; k < 150; ++k) {
                hair_test_wait(&living, 1);
                hair_test_read_guides(&living);
                deepest = fmax(deepest, depth(&living, &bodies[n]));
            }
            print_message(
                "    body %zu, solver %d: up to %.2g m deep in the margin, stretch %.2g, at last %.2g m/s\n",
                n, solver, deepest, hair_test_stretch(&living), 60 * hair_test_moved(&living));
            assert_true(deepest < (solver == HAIR_SOLVER_FOLLOW ? 4e-3 : 1e-3) &&
                        hair_test_stretch(&living) < 2e-3);
            // Follow-the-leader has no tension to keep a strand on an edge. The strand slides off
            // first.
            if (solver == HAIR_SOLVER_FOLLOW) {
                hair_test_wait(&living, 600);
                hair_test_read_guides(&living);
                hair_test_wait(&living, 1);
                hair_test_read_guides(&living);
            }
            assert_true(60 * hair_test_moved(&living) < 0.05);
            hair_test_die(&living);
            hair_test_strands_free(&strands);
        }
}

// Check a plate of 30 mm, three segments of the strand, that moves 80 mm in a frame.
static void plate_swept_through_hair_takes_it_along(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living;
        struct hair_test_strands strands;
        double deepest = -INFINITY;
        live(*state, solver, hair_v3(0, -1, 0), &physics, &strands, &living);
        for (double x = -0.3; x < 0.1; x += 5.0 / 60) {
            hair_collider plate = hair_test_body(HAIR_SHAPE_BOX, (float)x, -0.2f, 0);
            plate.size[0] = 0.015f, plate.size[1] = plate.size[2] = 0.15f;
            hair_test_set_colliders(&living, &plate, 1);
            hair_test_wait(&living, 1);
            hair_test_read_guides(&living);
            deepest = fmax(deepest, depth(&living, &plate) - MARGIN);
            for (uint32_t i = 8; i < living.vertices; ++i) {
                hair_vec3 p = hair_test_at(&living, 0, i);
                if (p.y < -0.06f && !((double)p.x > x))
                    fail_msg("solver %d: vertex %u at (%g, %g) is left of %g", solver, i, (double)p.x,
                             (double)p.y, x);
            }
        }
        print_message("    solver %d: up to %.2g m deep\n", solver, deepest);
        // The strand is deepest at the edge that holds it. Follow-the-leader lets it enter by half
        // of the plate.
        assert_true(deepest < (solver == HAIR_SOLVER_FOLLOW ? 15e-3 : 12e-3));
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

static void spinning_box_leaves_no_strand_inside(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living;
        struct hair_test_strands strands;
        double deepest = -INFINITY;
        hair_collider box = hair_test_body(HAIR_SHAPE_BOX, 0.03f, -0.18f, 0);
        box.size[0] = 0.08f, box.size[1] = 0.02f, box.size[2] = 0.05f;
        live(*state, solver, hair_v3(0, -1, 0), &physics, &strands, &living);
        for (int k = 0; k < 90; ++k) {
            if (k < 80) hair_test_turn(&box, 2, 0.35 * k); // At 21 rad/s, and then stopped.
            hair_test_set_colliders(&living, &box, 1);
            hair_test_wait(&living, 1);
            hair_test_read_guides(&living);
            if (k > 10) deepest = fmax(deepest, depth(&living, &box) - MARGIN);
        }
        print_message("    solver %d: up to %.2g m deep, at last %.2g m, stretch %.2g\n", solver, deepest,
                      depth(&living, &box) - MARGIN, hair_test_stretch(&living));
        assert_true(depth(&living, &box) - MARGIN < 1e-3);
        assert_true(hair_test_stretch(&living) < 0.02);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

// Check a slope of 0.4 rad. Coulomb friction holds strands if the coefficient exceeds its tangent,
// 0.42.
static void each_collider_has_its_own_friction(void** state)
{
    static const float factors[] = {0, 0.5f, 2};
    hair_physics physics = hair_test_loose(0.3f);
    physics.root = HAIR_ROOT_FREE;
    physics.damping = 0;
    for (int n = 0; n < 3; ++n) {
        struct hair_test_living living;
        struct hair_test_strands strands;
        hair_collider slope = hair_test_body(HAIR_SHAPE_PLANE, 0, -(float)MARGIN / cosf(0.4f), 0);
        hair_test_turn(&slope, 2, 0.4);
        slope.friction = factors[n];
        live(*state, 0, hair_v3(0, 0, 1), &physics, &strands, &living);
        hair_test_check_slide(&living, &slope, 0.3 * (double)factors[n]);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(strand_on_any_shape_stays_outside_and_comes_to_rest),
        HAIR_TEST(plate_swept_through_hair_takes_it_along),
        HAIR_TEST(spinning_box_leaves_no_strand_inside),
        HAIR_TEST(each_collider_has_its_own_friction),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
