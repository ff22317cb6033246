// rod_any_test.c - strands as rods with collision meshes and a thousand colliders, which sweep,
// spin, contain the hair at the start, or appear on it.
#include "lib/collide/distance.h"
#include "tests/support/live_hair.h"
#include "tests/support/meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SOLVERS HAIR_SOLVER_REDBLACK // The number of solvers before redblack.
#define MARGIN 1e-3
#define VOXEL 5e-3 // Default voxel of the field, in metres.

// Return a box with these half sides. With `is_mesh` it is a collision mesh of half the size,
// scaled by two.
static hair_collider box_of(struct hair_test* test, int is_mesh, float x, float y, float z)
{
    const float half[] = {x / 2, y / 2, z / 2};
    hair_collider collider = hair_test_body(is_mesh ? HAIR_SHAPE_MESH : HAIR_SHAPE_BOX, 0, 0, 0);
    if (is_mesh) {
        collider.mesh = hair_test_collision_mesh(test, hair_test_box_mesh(half), 48);
        collider.scale = 2;
    } else
        collider.size[0] = x, collider.size[1] = y, collider.size[2] = z;
    return collider;
}

static hair_collider ball_of(struct hair_test* test, int is_mesh, float radius)
{
    hair_collider collider = hair_test_body(is_mesh ? HAIR_SHAPE_MESH : HAIR_SHAPE_SPHERE, 0, 0, 0);
    if (is_mesh)
        collider.mesh = hair_test_collision_mesh(test, hair_test_ball_mesh(radius, 24, 48), 48);
    else
        collider.size[0] = radius;
    return collider;
}

static void at(hair_collider* collider, double x, double y, double z)
{
    collider->position[0] = (float)x, collider->position[1] = (float)y, collider->position[2] = (float)z;
}

static void live(struct hair_test* test, int solver, hair_vec3 way, const hair_physics* physics,
                 struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_straight(32, hair_v3(0, 0, 0), way, 0.3f);
    hair_desc desc = hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

// Create four strands that hang from a row.
static void live_row(struct hair_test* test, int solver, const hair_physics* physics,
                     struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_strands_make(4, 32);
    for (int k = 0; k < 4; ++k)
        hair_test_add_straight(&strands, 32, hair_v3(0, 0, 0.02f * (float)k - 0.03f), hair_v3(0, -1, 0),
                               0.3f);
    hair_desc desc = hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_AUTO, 0, physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

// Rest --------------------------------------------------------------------------------------------

// Check a strand that starts level and comes to hang over an edge, or over a ball.
static void strand_on_a_mesh_stays_outside_and_comes_to_rest(void** state)
{
    hair_physics physics = hair_test_loose(0.5f);
    physics.damping = 10;
    for (int n = 0; n < 4; ++n) {
        int solver = n == 3 ? HAIR_SOLVER_FOLLOW : HAIR_SOLVER_DIRECT;
        struct hair_test_living living;
        hair_collider collider = n % 2 ? ball_of(*state, 1, 0.06f) : box_of(*state, 1, 0.06f, 0.03f, 0.2f);
        double deepest = -INFINITY;
        at(&collider, 0.08, n % 2 ? -0.08 : -0.05, 0);
        if (n == 2) hair_test_turn(&collider, 2, 0.3);
        live(*state, solver, hair_v3(1, 0, 0.05f), &physics, &living);
        hair_test_set_colliders(&living, &collider, 1);
        for (int k = 0; k < 150; ++k) {
            hair_test_wait(&living, 1);
            hair_test_read_guides(&living);
            deepest = fmax(deepest, hair_test_depth(&living, &collider) + MARGIN);
        }
        double touching = hair_test_depth(&living, &collider) + MARGIN;
        // Follow-the-leader has no tension to keep a strand on a ball. The strand slides off, and
        // hangs.
        int slides = solver == HAIR_SOLVER_FOLLOW;
        if (slides) {
            hair_test_wait(&living, 600);
            hair_test_read_guides(&living);
        }
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        print_message(
            "    form %d: up to %.2g m deep in the margin, at last %.2g m, in the last half second %.2g m\n",
            n, deepest, touching, hair_test_moved(&living));
        assert_true(deepest < 1e-3);
        assert_true(slides || touching > -1e-3);
        assert_true(hair_test_moved(&living) < 1e-4);
        hair_test_die(&living);
        hair_collision_mesh_destroy((hair_collision_mesh*)(uintptr_t)collider.mesh);
    }
}

// Check a slope of 0.4 rad. Coulomb friction holds strands if the coefficient exceeds its tangent,
// 0.42.
static void mesh_has_friction(void** state)
{
    static const float factors[] = {0, 0.5f, 2};
    hair_physics physics = hair_test_loose(0.3f);
    physics.root = HAIR_ROOT_FREE;
    physics.damping = 0;
    hair_collider slope = box_of(*state, 1, 1, 0.1f, 0.5f);
    hair_test_turn(&slope, 2, 0.4);
    at(&slope, (0.1 + MARGIN) * sin(0.4), -(0.1 + MARGIN) * cos(0.4), 0);
    for (int n = 0; n < 3; ++n) {
        struct hair_test_living living;
        slope.friction = factors[n];
        live(*state, 0, hair_v3(0, 0, 1), &physics, &living);
        hair_test_check_slide(&living, &slope, 0.3 * (double)factors[n]);
        hair_test_die(&living);
    }
    hair_collision_mesh_destroy((hair_collision_mesh*)(uintptr_t)slope.mesh);
}

static void moving_and_spinning_meshes_carry_hair_along(void** state)
{
    hair_physics physics = hair_test_loose(0.8f);
    physics.root = HAIR_ROOT_FREE;
    physics.damping = 0;
    for (int spins = 0; spins < 2; ++spins) {
        struct hair_test_living living;
        hair_collider collider = spins ? ball_of(*state, 1, 0.5f) : box_of(*state, 1, 0.5f, 0.1f, 0.5f);
        double below = spins ? 0.5 : 0.1, way = 0;
        struct hair_test_strands strands = hair_test_straight(5, hair_v3(0, 0, 0), hair_v3(0, 0, 1), 0.04f);
        hair_desc desc =
            hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        at(&collider, 0, -below - MARGIN, 0);
        hair_test_set_colliders(&living, &collider, 1);
        hair_test_wait(&living, 10);
        for (int k = 1; k <= 30; ++k) {
            way += 0.2 * fmin(k / 10.0, 1) / 60;
            if (spins)
                hair_test_turn(&collider, 2, -way / below);
            else
                at(&collider, way, -below - MARGIN, 0);
            hair_test_set_colliders(&living, &collider, 1);
            hair_test_wait(&living, 1);
        }
        hair_test_read_guides(&living);
        double carried = (double)hair_test_at(&living, 0, 2).x,
               expected = spins ? below * sin(way / below) : way;
        print_message("    carried %.5f m of %.5f m\n", carried, expected);
        assert_true(fabs(carried / expected - 1) < 0.03);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
        hair_collision_mesh_destroy((hair_collision_mesh*)(uintptr_t)collider.mesh);
    }
}

// Stress ------------------------------------------------------------------------------------------

// Check strands 0.1 s after the stress: none is deeper than a voxel, and all have their length. A
// second after the collider is removed, all hang.
static void check_after(struct hair_test_living* living, const hair_collider* collider, const char* what,
                        int solver)
{
    hair_test_wait(living, 6);
    hair_test_read_guides(living);
    double left = hair_test_depth(living, collider), stretch = hair_test_stretch(living);
    hair_solver_stats solver_stats = hair_test_solver_stats(living);
    hair_test_set_colliders(living, NULL, 0);
    hair_test_wait(living, 60);
    hair_test_read_guides(living);
    double highest = -INFINITY;
    for (uint32_t g = 0; g < living->groom->info.guide_count; ++g)
        highest = fmax(highest, (double)hair_test_tip(living, g).y);
    print_message("    %s, shape %d, solver %d: 0.1 s later %.2g m deep, stretch %.2g, resets %u, then tips "
                  "at %.3f m\n",
                  what, (int)collider->shape, solver, left, stretch, solver_stats.reset, highest);
    assert_true(left < VOXEL);
    assert_true(stretch < 0.02);
    assert_true(highest < -0.25);
}

static void fast_colliders_leave_no_strand_inside_or_stuck(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    for (int n = 0; n < 8; ++n)
        for (int solver = 0; solver < (n == 1 ? SOLVERS : 1); ++solver) {
            static const char* const names[] = {"swept", "spun", "begun inside", "came upon"};
            struct hair_test_living living;
            int is_mesh = n % 2, what = n / 2;
            hair_collider collider =
                what == 1 ? box_of(*state, is_mesh, 0.08f, 0.02f, 0.05f) : ball_of(*state, is_mesh, 0.05f);
            live_row(*state, solver, &physics, &living);
            if (what == 0) // At 5 m/s, and then stopped.
                for (double x = -0.3; x < 0.1; x += 5.0 / 60) {
                    at(&collider, x, -0.15, 0);
                    hair_test_set_colliders(&living, &collider, 1);
                    hair_test_wait(&living, 1);
                }
            if (what == 1) // At 21 rad/s.
                for (int k = 0; k < 45; ++k) {
                    at(&collider, 0.03, -0.18, 0);
                    hair_test_turn(&collider, 2, 0.35 * k);
                    hair_test_set_colliders(&living, &collider, 1);
                    hair_test_wait(&living, 1);
                }
            if (what == 2) at(&collider, 0.004, -0.15, 0), hair_test_set_colliders(&living, &collider, 1);
            if (what == 3) {
                at(&collider, 2, 3, 1);
                hair_test_set_colliders(&living, &collider, 1);
                hair_test_wait(&living, 2);
                at(&collider, 0.004, -0.15, 0);
                hair_test_set_colliders(&living, &collider, 1);
            }
            check_after(&living, &collider, names[what], solver);
            hair_test_die(&living);
            if (is_mesh) hair_collision_mesh_destroy((hair_collision_mesh*)(uintptr_t)collider.mesh);
        }
}

// Many colliders ----------------------------------------------------------------------------------

#define MANY 1000

static void place_many(hair_collider* colliders, const hair_collision_mesh* collision_mesh)
{
    uint32_t random = 5;
    for (int i = 0; i < MANY; ++i) {
        float p[3];
        for (int k = 0; k < 3; ++k) {
            random = random * 1664525u + 1013904223u;
            p[k] = (float)(random >> 8) / 16777216.0f - 0.5f;
        }
        colliders[i] = hair_test_body(i % 50 == 7 ? HAIR_SHAPE_MESH
                                      : i % 3     ? HAIR_SHAPE_SPHERE
                                                  : HAIR_SHAPE_BOX,
                                      0.5f * p[0], -0.17f + 0.2f * p[1], 0.5f * p[2]);
        if (colliders[i].shape == HAIR_SHAPE_MESH) {
            colliders[i].mesh = collision_mesh;
            continue;
        }
        for (int k = 0; k < 3; ++k) colliders[i].size[k] = i % 3 && k ? 0 : 0.012f;
    }
}

static void hair_stays_out_of_1000_colliders_and_loads_bit_for_bit(void** state)
{
    static hair_collider colliders[MANY];
    hair_physics physics = hair_test_loose(0.3f);
    hair_collision_mesh* collision_mesh =
        hair_test_collision_mesh(*state, hair_test_ball_mesh(0.015f, 12, 24), 24);
    place_many(colliders, collision_mesh);
    struct hair_test_living living[2];
    size_t size = 0;
    void* bytes;
    for (int run = 0; run < 2; ++run) {
        struct hair_test_strands strands = hair_test_strands_make(8, 32);
        for (int k = 0; k < 8; ++k)
            hair_test_add_straight(&strands, 32, hair_v3(-0.1f + 0.03f * (float)k, 0, 0.003f * (float)k),
                                   hair_v3(1, -0.1f, 0.1f * (float)(k - 3)), 0.3f);
        hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
        hair_test_live(*state, &strands, &desc, &living[run]);
        hair_test_strands_free(&strands);
        hair_test_set_colliders(&living[run], colliders, MANY);
    }
    hair_test_wait(&living[0], 20);
    hair_save(living[0].hair, NULL, 0, &size);
    bytes = malloc(size);
    hair_test_ok(*state, hair_save(living[0].hair, bytes, size, &size));
    hair_test_ok(*state, hair_load(living[1].hair, bytes, size));
    free(bytes);
    for (int run = 0; run < 2; ++run) {
        hair_test_wait(&living[run], 40);
        hair_test_read_guides(&living[run]);
    }
    double deepest = -INFINITY;
    for (int i = 0; i < MANY; ++i) deepest = fmax(deepest, hair_test_depth(&living[0], &colliders[i]));
    print_message("    up to %.2g m deep, stretch %.2g\n", deepest, hair_test_stretch(&living[0]));
    assert_true(deepest < 1e-3);
    assert_true(hair_test_stretch(&living[0]) < 0.02);
    assert_memory_equal(living[0].positions, living[1].positions, 12 * living[0].vertices);
    hair_test_die(&living[0]);
    hair_test_die(&living[1]);
    hair_collision_mesh_destroy(collision_mesh);
}

#define POST_BALLS 100

// Create hair that starts inside a post and around it, between its axis and its surface.
static void live_in_post(struct hair_test* test, hair_thread_mapping mapping, const hair_collider* colliders,
                         uint32_t count, struct hair_test_living* out)
{
    hair_physics physics = hair_test_loose(0.3f);
    struct hair_test_strands strands = hair_test_strands_make(8, 32);
    for (int k = 0; k < 8; ++k)
        hair_test_add_straight(&strands, 32, hair_v3(-0.0175f + 0.005f * (float)k, 0, 0.003f),
                               hair_v3(0, -1, 0), 0.3f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, mapping, 0, &physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
    hair_test_set_colliders(out, colliders, count);
}

// Compare a row of balls with the post that they form. Each ball alone would also push strands up
// and down.
static void strand_leaves_a_row_of_balls_like_a_capsule(void** state)
{
    static const char* const names[] = {"post", "balls", "balls, a work group per guide"};
    static hair_collider balls[POST_BALLS];
    hair_collider post = hair_test_body(HAIR_SHAPE_CAPSULE, 0, -0.15f, 0);
    post.size[0] = 0.02f, post.size[1] = 0.09f;
    for (int i = 0; i < POST_BALLS; ++i) {
        float fraction = (float)i / (POST_BALLS - 1);
        balls[i] = hair_test_body(HAIR_SHAPE_SPHERE, 0, -0.24f + 0.18f * fraction, 0);
        balls[i].size[0] = 0.02f;
    }
    uint32_t fallbacks[3];
    for (int kind = 0; kind < 3; ++kind) {
        struct hair_test_living living;
        live_in_post(*state,
                     kind == 2 ? HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE
                               : HAIR_THREAD_MAPPING_THREAD_PER_GUIDE,
                     kind ? balls : &post, kind ? POST_BALLS : 1, &living);
        hair_test_wait(&living, 6);
        hair_test_read_guides(&living);
        double soon = hair_test_depth(&living, &post);
        hair_solver_stats then = hair_test_solver_stats(&living);
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        hair_solver_stats now = hair_test_solver_stats(&living);
        fallbacks[kind] = now.euler_fallbacks + now.parts + now.follow_fallbacks;
        print_message(
            "    %s: %.2g m deep 0.1 s later, %.2g m 1 s later; %u fallbacks, %u of them after 0.1 s\n",
            names[kind], soon, hair_test_depth(&living, &post), fallbacks[kind],
            fallbacks[kind] - then.euler_fallbacks - then.parts - then.follow_fallbacks);
        assert_true(soon < VOXEL);
        assert_true(hair_test_depth(&living, &post) < 1e-3);
        assert_true(hair_test_stretch(&living) < 0.02);
        hair_test_die(&living);
    }
    for (int kind = 1; kind < 3; ++kind) assert_true(fallbacks[kind] <= 2 * fallbacks[0] + 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(strand_on_a_mesh_stays_outside_and_comes_to_rest),
        HAIR_TEST(mesh_has_friction),
        HAIR_TEST(moving_and_spinning_meshes_carry_hair_along),
        HAIR_TEST(fast_colliders_leave_no_strand_inside_or_stuck),
        HAIR_TEST(hair_stays_out_of_1000_colliders_and_loads_bit_for_bit),
        HAIR_TEST(strand_leaves_a_row_of_balls_like_a_capsule),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
