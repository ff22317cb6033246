// curled_contact_test.c - curled strands over edges, balls, and walls thinner than a voxel. All
// vertices stay outside, and strands come to rest.
#include "tests/support/live_hair.h"
#include "tests/support/meshes.h"

#include <math.h>

#define STRANDS 16
#define VERTICES 32
#define LENGTH 0.3f
#define MARGIN 1e-3 // Default collision margin, m
#define FAR_COLLIDERS 40 // Colliders that nothing touches, by which a grid lists all colliders

// Two boxes have parallel tops, of which the second is lower.
enum { BOX, BALL, TWO_BOXES, WALL, SHAPES };
static const char* const shape_names[] = {"box", "ball", "two boxes", "wall"};

static const struct way {
    const char* name;
    hair_solver solver;
    hair_thread_mapping mapping;
    uint32_t far_colliders;
} ways[] = {
    {"direct", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0},
    {"by thread", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 0},
    {"grid", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, FAR_COLLIDERS},
    {"accurate", HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0},
};

// Create a row of wavy strands that start level. The mixed scheme solves them.
static void live_row(struct hair_test* test, const struct way* way, struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, VERTICES);
    hair_physics physics = hair_test_loose(0.3f);
    for (int k = 0; k < STRANDS; ++k) {
        for (int i = 0; i < VERTICES; ++i) {
            float t = (float)i / (VERTICES - 1), phase = 25 * t + (float)k;
            hair_store3(strands.positions + 3 * strands.vertex_count++,
                        hair_v3(LENGTH * t, 0.006f * cosf(phase), 0.006f * (float)k + 0.006f * sinf(phase)));
        }
        strands.vertices[strands.count++] = VERTICES;
    }
    hair_desc desc = hair_test_rods(way->solver, way->mapping, 0, &physics);
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

// Return a collider below the middle of the row. The wall is thinner than a voxel of its mesh.
static hair_collider collider_of(struct hair_test* test, int shape, hair_collision_mesh** mesh)
{
    hair_collider collider = hair_test_body(HAIR_SHAPE_BOX, 0.1f, -0.06f, 0.05f);
    *mesh = NULL;
    if (shape == BOX || shape == TWO_BOXES) {
        collider.size[0] = 0.04f, collider.size[1] = 0.04f, collider.size[2] = 0.1f;
    } else if (shape == BALL) {
        collider.shape = HAIR_SHAPE_SPHERE;
        collider.size[0] = 0.05f;
    } else {
        const float half[] = {0.002f, 0.05f, 0.1f};
        collider.shape = HAIR_SHAPE_MESH;
        collider.mesh = *mesh = hair_test_collision_mesh(test, hair_test_box_mesh(half), 40);
    }
    return collider;
}

static void check(struct hair_test* test, const struct way* way, int shape)
{
    struct hair_test_living living;
    hair_collider all[1 + FAR_COLLIDERS];
    hair_collision_mesh* mesh;
    double deepest = -INFINITY, fastest = 0;
    all[0] = collider_of(test, shape, &mesh);
    for (int i = 1; i <= FAR_COLLIDERS; ++i) {
        all[i] = hair_test_body(HAIR_SHAPE_SPHERE, 0.2f * (float)i, -3, 0);
        all[i].size[0] = 0.01f;
    }
    live_row(test, way, &living);
    // Strands then meet the edges at other places along their segments.
    hair_test_turn(&all[0], 1, 0.5);
    if (shape == TWO_BOXES) {
        all[1] = all[0];
        all[1].position[1] -= 1e-3f;
    }
    hair_test_set_colliders(&living, all, (shape == TWO_BOXES ? 2 : 1) + way->far_colliders);
    hair_test_wait(&living, 150);
    hair_test_read_guides(&living);
    for (int k = 0; k < 30; ++k) {
        hair_test_wait(&living, 1);
        hair_test_read_guides(&living);
        deepest = fmax(deepest, MARGIN + hair_test_depth(&living, &all[0]));
        fastest = fmax(fastest, 60 * hair_test_moved(&living));
    }
    hair_solver_stats stats = hair_test_solver_stats(&living);
    print_message("    %s over the %s: %.2g m deep in the margin, %.2g m/s, %u led\n", way->name,
                  shape_names[shape], deepest, fastest, stats.follow_fallbacks);
    assert_true(deepest > -MARGIN && deepest < 5e-5);
    assert_true(fastest < 0.1);
    assert_int_equal(stats.follow_fallbacks, 0);
    hair_test_die(&living);
    hair_collision_mesh_destroy(mesh);
}

static void curled_strands_lie_on_colliders(void** state)
{
    for (size_t n = 0; n < sizeof ways / sizeof *ways; ++n)
        for (int shape = n ? WALL : BOX; shape < SHAPES; ++shape) check(*state, &ways[n], shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(curled_strands_lie_on_colliders)};
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
