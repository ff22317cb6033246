// hair_body_motion_test.c - the surface of a body moves over a step: friction carries hair, and no
// hair is left inside a fast body.
#include "tests/support/deforming.h"

#include <math.h>

// Move a plate under a strand, or against it, by its vertices or by its pose.
static void move_plate(struct hair_test* test, bool by_vertices, int frames, hair_vec3 step,
                       const float half[3], hair_vec3 start, struct hair_test_living* living)
{
    struct hair_test_mesh rest = hair_test_box_mesh(half), mesh = hair_test_box_mesh(half);
    hair_body* body = hair_test_deforming(test, &rest, 0.28f, 36);
    hair_collider collider = hair_test_body(HAIR_SHAPE_MESH, start.x, start.y, start.z);
    collider.mesh = hair_body_get_mesh(body);
    for (int frame = 0; frame <= frames; ++frame) {
        hair_vec3 moved = hair_scale(step, (float)frame);
        for (uint32_t i = 0; i < 3 * rest.vertex_count; ++i)
            mesh.positions[i] = rest.positions[i] + (i % 3 == 0 ? moved.x : i % 3 == 1 ? moved.y : moved.z);
        if (by_vertices) {
            hair_test_deform(test, body, &mesh);
        } else {
            collider.position[0] = start.x + moved.x;
            collider.position[1] = start.y + moved.y;
            collider.position[2] = start.z + moved.z;
        }
        hair_test_set_colliders(living, &collider, 1);
        hair_test_wait(living, frame ? 1 : 60);
    }
    hair_test_read_guides(living);
    hair_body_destroy(body);
    hair_test_mesh_free(&rest);
    hair_test_mesh_free(&mesh);
}

// Compare hair on a plate that moves by its vertices with hair on a plate that moves by its pose.
// Return the maximum distance between vertices, m. `moved` receives the motion of the tip.
static double compare_plates(struct hair_test* test, hair_solver solver, float friction, hair_vec3 way,
                             int frames, hair_vec3 step, const float half[3], hair_vec3 start,
                             hair_vec3* moved)
{
    hair_physics physics = hair_test_loose(friction);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    struct hair_test_strands strands = hair_test_straight(32, hair_v3(0, 0, 0), way, 0.3f);
    struct hair_test_living livings[2];
    double far = 0;
    for (int k = 0; k < 2; ++k) {
        hair_test_live(test, &strands, &desc, &livings[k]);
        move_plate(test, k == 0, frames, step, half, start, &livings[k]);
    }
    for (uint32_t i = 0; i < livings[0].vertices; ++i)
        far = fmax(far, (double)hair_distance(hair_load3(livings[0].positions + 3 * i),
                                              hair_load3(livings[1].positions + 3 * i)));
    *moved = hair_test_tip(&livings[0], 0);
    for (int k = 0; k < 2; ++k) hair_test_die(&livings[k]);
    hair_test_strands_free(&strands);
    return far;
}

// Check a plate under a strand that moves sideways by 2 mm a frame. Friction carries the strand.
static void surface_that_deforms_carries_hair_by_friction(void** state)
{
    const float half[3] = {0.2f, 0.02f, 0.2f};
    hair_vec3 tip;
    double far = compare_plates(*state, HAIR_SOLVER_DIRECT, 1, hair_v3(1, 0, 0.05f), 30,
                                hair_v3(0, 0, 0.002f), half, hair_v3(0.2f, -0.05f, 0), &tip);
    print_message("    the tip ends at z = %.4f m, %.2g m from hair on a plate that moves rigidly\n",
                  (double)tip.z, far);
    assert_true(tip.z > 0.04f && far < 2e-3);
}

// Check a plate of 30 mm, three segments of the strand, that moves 80 mm in a frame.
static void plate_that_deforms_far_in_a_frame_takes_hair_along(void** state)
{
    const float half[3] = {0.015f, 0.1f, 0.1f};
    hair_vec3 tip;
    double far = compare_plates(*state, HAIR_SOLVER_DIRECT, 0.3f, hair_v3(0, -1, 0), 2, hair_v3(0.08f, 0, 0),
                                half, hair_v3(-0.06f, -0.25f, 0), &tip);
    print_message("    the tip ends at x = %.4f m, %.2g m from hair before a plate that moves rigidly\n",
                  (double)tip.x, far);
    assert_true(tip.x > 0.1f && far < 1e-2);
}

// Hang a strand inside a closed box of cloth whose bottom moves sideways. Cloth takes the strand
// along. No segment of the strand crosses the cloth at first.
static void hair_stays_inside_two_sided_body(void** state)
{
    struct hair_test* test = *state;
    const float half[3] = {0.06f, 0.275f, 0.06f}, shift = 0.2f, down = 0.225f;
    hair_physics physics = hair_test_loose(0.3f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    struct hair_test_strands strands = hair_test_straight(32, hair_v3(0, 0, 0), hair_v3(0, -1, 0), 0.3f);
    struct hair_test_mesh rest = hair_test_box_mesh(half), mesh = hair_test_box_mesh(half);
    struct hair_test_living living;
    hair_body_desc body_desc = hair_test_body_desc(&rest, 0.3f, 48);
    hair_body* body = NULL;
    body_desc.two_sided = true;
    hair_test_ok(test, hair_body_create(test->context, &body_desc, &body));
    hair_test_live(test, &strands, &desc, &living);
    hair_collider collider = hair_test_body(HAIR_SHAPE_MESH, 0, -down, 0);
    collider.mesh = hair_body_get_mesh(body);
    hair_test_set_colliders(&living, &collider, 1);
    hair_test_wait(&living, 10);
    for (int frame = 1; frame <= 60; ++frame) {
        for (uint32_t i = 0; i < 3 * rest.vertex_count; i += 3) {
            float depth = 0.5f - 0.5f * rest.positions[i + 1] / half[1]; // From 0 at the top to 1.
            mesh.positions[i] = rest.positions[i] + shift * (float)frame / 60 * depth;
        }
        hair_test_deform(test, body, &mesh);
        hair_test_wait(&living, 1);
    }
    hair_test_read_guides(&living);
    hair_vec3 tip = hair_test_tip(&living, 0);
    float wall = shift * (half[1] - down - tip.y) / (2 * half[1]) - half[0];
    print_message("    the tip is at x = %.4f m, the wall at %.4f m\n", (double)tip.x, (double)wall);
    assert_true(wall > 0.04f && tip.x > wall && tip.x < wall + 2 * half[0] && fabsf(tip.z) < half[2]);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
    hair_body_destroy(body);
    hair_test_mesh_free(&rest);
    hair_test_mesh_free(&mesh);
}

// Hang strands from the top of a lump that nods three times a second by 0.3 rad and breathes.
static void nodding_body_has_no_hair_inside(void** state)
{
    enum { STRANDS = 12, VERTICES = 24, FRAMES = 60 };
    struct hair_test* test = *state;
    struct hair_test_mesh rest = hair_test_lump(20, 30, 0, 0), mesh = hair_test_lump(20, 30, 0, 0);
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, STRANDS * VERTICES);
    struct hair_test_living living;
    hair_physics physics = hair_test_loose(0.3f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    for (int i = 0; i < STRANDS; ++i) {
        float turn = 6.2831853f * (float)i / STRANDS, x = cosf(turn), z = sinf(turn);
        hair_test_add_straight(&strands, VERTICES, hair_v3(0.02f * x, 0.135f, 0.02f * z),
                               hair_v3(x, -0.3f, z), 0.25f);
    }
    hair_test_live(test, &strands, &desc, &living);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 32);
    hair_collider collider = hair_test_body(HAIR_SHAPE_MESH, 0, 0, 0);
    collider.mesh = hair_body_get_mesh(body);
    hair_test_set_colliders(&living, &collider, 1);
    hair_test_wait(&living, 30);
    double deepest = -INFINITY;
    for (int frame = 0; frame < FRAMES; ++frame) {
        float nod = 0.3f * sinf(0.314159f * (float)frame), breath = 1 + 0.03f * sinf(0.136f * (float)frame);
        for (uint32_t i = 0; i < rest.vertex_count; ++i) {
            const float* p = rest.positions + 3 * i;
            float* to = mesh.positions + 3 * i;
            to[0] = breath * p[0];
            to[1] = cosf(nod) * p[1] - sinf(nod) * breath * p[2];
            to[2] = sinf(nod) * p[1] + cosf(nod) * breath * p[2];
        }
        hair_test_deform(test, body, &mesh);
        hair_test_wait(&living, 1);
        hair_test_read_guides(&living);
        struct hair_triangles triangles = hair_test_triangles(test, &mesh);
        deepest = fmax(deepest, hair_test_depth_in_body(&living, &triangles, &collider));
        hair_triangles_free(&test->host.host, &triangles);
    }
    print_message("    up to %.2g m deep\n", deepest);
    assert_true(deepest < 1e-3 && deepest > -0.01);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
    hair_body_destroy(body);
    hair_test_mesh_free(&rest);
    hair_test_mesh_free(&mesh);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(surface_that_deforms_carries_hair_by_friction),
        HAIR_TEST(plate_that_deforms_far_in_a_frame_takes_hair_along),
        HAIR_TEST(hair_stays_inside_two_sided_body),
        HAIR_TEST(nodding_body_has_no_hair_inside),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
