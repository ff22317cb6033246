// collision_mesh_test.c - distance fields of triangle meshes: exact near the surface, with the
// right sign, for any mesh that is not refused.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/collide/distance.h"
#include "tests/support/meshes.h"

static struct hair_test_host test;

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    return 0;
}

static int stop(void** state)
{
    (void)state;
    return test.blocks != 0 || test.errors != 0;
}

static hair_collision_mesh_desc desc_of(const struct hair_test_mesh* mesh, uint32_t resolution)
{
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    desc.host = &test.host;
    desc.positions = mesh->positions;
    desc.triangles = mesh->triangles;
    desc.vertex_count = mesh->vertex_count;
    desc.triangle_count = mesh->triangle_count;
    desc.resolution = resolution;
    return desc;
}

static hair_collision_mesh* mesh_of(const struct hair_test_mesh* mesh, uint32_t resolution)
{
    hair_collision_mesh_desc desc = desc_of(mesh, resolution);
    hair_collision_mesh* collision_mesh = NULL;
    assert_int_equal(hair_collision_mesh_create(&desc, &collision_mesh), HAIR_OK);
    return collision_mesh;
}

static void node_at(const hair_collision_mesh* collision_mesh, size_t node, double out[3])
{
    size_t at[3] = {node % collision_mesh->size[0], node / collision_mesh->size[0] % collision_mesh->size[1],
                    node / collision_mesh->size[0] / collision_mesh->size[1]};
    for (int k = 0; k < 3; ++k)
        out[k] = (double)collision_mesh->origin[k] + (double)collision_mesh->voxel * (double)at[k];
}

// Check the maximum error of the distance at the nodes. Within the band it is in voxels, and
// outside it is relative to the distance from the band. The sign must be right everywhere except on
// the surface.
static void compare(const char* what, const hair_collision_mesh* collision_mesh, hair_shape shape,
                    const float size[3], double limit)
{
    size_t nodes = (size_t)collision_mesh->size[0] * collision_mesh->size[1] * collision_mesh->size[2];
    double worst = 0, worst_far = 0, voxel = (double)collision_mesh->voxel;
    for (size_t i = 0; i < nodes; ++i) {
        double at[3], own = (double)collision_mesh->distance[i];
        node_at(collision_mesh, i, at);
        double exact = hair_distance_to_shape(shape, size, at, NULL);
        double off = fabs(own - exact) / voxel,
               beyond = fabs(exact) / voxel - (HAIR_COLLISION_MESH_BAND - 0.1);
        if (beyond < 0)
            worst = fmax(worst, off);
        else
            worst_far = fmax(worst_far, (off - limit) / (beyond + 1));
        if (fabs(exact) > (limit + 1e-3) * voxel && (own < 0) != (exact < 0))
            fail_msg("%s: node %zu is %g m from the surface, said to be %g", what, i, exact, own);
    }
    print_message("    %s: %.4f voxels, %.4f beyond the band\n", what, worst, worst_far);
    assert_true(worst <= limit);
    assert_true(worst_far <= 0.1);
}

static void distance_to_a_box_mesh_equals_a_box(void** state)
{
    (void)state;
    const float size[3] = {0.3f, 0.2f, 0.11f};
    struct hair_test_mesh mesh = hair_test_box_mesh(size);
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 48);
    assert_true(collision_mesh->info.is_closed);
    compare("box", collision_mesh, HAIR_SHAPE_BOX, size, 1e-3);
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
}

// Check a ball of many triangles. Its faces lie below the sphere by up to r (1 - cos(half a step)).
static void distance_to_a_ball_mesh_equals_a_sphere(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0, 0};
    struct hair_test_mesh mesh = hair_test_ball_mesh(0.1f, 64, 128);
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 40);
    assert_true(collision_mesh->info.is_closed);
    double sag = 0.1 * (1 - cos(3.14159265 / 64)) / (double)collision_mesh->voxel;
    compare("ball", collision_mesh, HAIR_SHAPE_SPHERE, size, 1.1 * sag + 1e-3);
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
}

static void mesh_inside_does_not_depend_on_winding(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0.1f, 0.1f};
    struct hair_test_mesh mesh = hair_test_box_mesh(size);
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        uint32_t a = mesh.triangles[3 * i];
        mesh.triangles[3 * i] = mesh.triangles[3 * i + 1], mesh.triangles[3 * i + 1] = a;
    }
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 16);
    compare("inside out", collision_mesh, HAIR_SHAPE_BOX, size, 1e-3);
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
}

// Check a mesh whose triangles share no vertices. Vertices with equal positions are taken as equal.
static void triangle_soup_is_closed_by_equal_positions(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0.15f, 0.1f};
    struct hair_test_mesh mesh = hair_test_box_mesh(size), soup = {0};
    soup.triangle_count = mesh.triangle_count;
    soup.vertex_count = 3 * mesh.triangle_count;
    soup.positions = malloc(soup.vertex_count * 3 * sizeof(float));
    soup.triangles = malloc(soup.vertex_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < soup.vertex_count; ++i) {
        soup.triangles[i] = i;
        memcpy(soup.positions + 3 * i, mesh.positions + 3 * mesh.triangles[i], 3 * sizeof(float));
    }
    hair_collision_mesh* collision_mesh = mesh_of(&soup, 16);
    assert_true(collision_mesh->info.is_closed);
    compare("soup", collision_mesh, HAIR_SHAPE_BOX, size, 1e-3);
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&soup);
}

// Check a box without its last triangle. It has no inside, so all distances are from a shell.
static void an_open_mesh_is_a_shell_and_the_log_warns(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0.1f, 0.1f}, bare[3] = {0, 0, 0};
    struct hair_test_mesh mesh = hair_test_box_mesh(size);
    --mesh.triangle_count;
    hair_collision_mesh_desc desc = desc_of(&mesh, 32);
    desc.thickness = 0.03f;
    hair_collision_mesh* collision_mesh = NULL;
    assert_int_equal(hair_collision_mesh_create(&desc, &collision_mesh), HAIR_OK);
    assert_int_equal(test.warnings, 1);
    assert_false(collision_mesh->info.is_closed);
    const double in[3] = {0, 0, 0}, wall[3] = {0, 0.1, 0}, near[3] = {0, 0.12, 0};
    hair_test_near("centre", 0, hair_distance_to_mesh(collision_mesh, in, NULL), 0.1 - 0.015, 1e-3);
    hair_test_near("wall", 0, hair_distance_to_mesh(collision_mesh, wall, NULL), -0.015, 2e-3);
    hair_test_near("near", 0, hair_distance_to_mesh(collision_mesh, near, NULL), 0.005, 2e-3);
    hair_collision_mesh_destroy(collision_mesh);
    (void)bare;
    hair_test_mesh_free(&mesh);
}

// Check a ball in a ball, whose inner one is inverted and makes a cavity.
static void hollow_of_a_mesh_is_outside(void** state)
{
    (void)state;
    struct hair_test_mesh mesh = hair_test_ball_mesh(0.1f, 16, 32),
                          inner = hair_test_ball_mesh(0.05f, 16, 32);
    hair_test_mesh_append(&mesh, &inner, 1);
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 32);
    const double middle[3] = {0, 0, 0}, wall[3] = {0.075, 0, 0}, out[3] = {0.2, 0, 0};
    assert_true(collision_mesh->info.is_closed);
    hair_test_near("middle", 0, hair_distance_to_mesh(collision_mesh, middle, NULL), 0.05, 2e-3);
    hair_test_near("wall", 0, hair_distance_to_mesh(collision_mesh, wall, NULL), -0.025, 2e-3);
    hair_test_near("out", 0, hair_distance_to_mesh(collision_mesh, out, NULL), 0.1, 2e-3);
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&inner);
}

static void intersecting_balls_have_one_inside(void** state)
{
    (void)state;
    struct hair_test_mesh mesh = hair_test_ball_mesh(0.1f, 16, 32), other = hair_test_ball_mesh(0.1f, 16, 32);
    for (uint32_t i = 0; i < other.vertex_count; ++i) other.positions[3 * i] += 0.1f;
    hair_test_mesh_append(&mesh, &other, 0);
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 32);
    const double middle[3] = {0.05, 0, 0}, left[3] = {-0.05, 0, 0};
    assert_true(hair_distance_to_mesh(collision_mesh, middle, NULL) < -0.03);
    assert_true(hair_distance_to_mesh(collision_mesh, left, NULL) < -0.04);
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&other);
}

static void distance_beyond_the_grid_is_to_the_surface(void** state)
{
    (void)state;
    struct hair_test_mesh mesh = hair_test_ball_mesh(0.1f, 32, 64);
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 32);
    uint32_t seed = 3;
    for (int i = 0; i < 1000; ++i) {
        double p[3], gradient[3], far = 0;
        for (int k = 0; k < 3; ++k) p[k] = 2 * (double)hair_random(&seed) - 1;
        for (int k = 0; k < 3; ++k) far += p[k] * p[k];
        far = sqrt(far);
        if (far < 0.2) continue;
        // Beyond the grid, the nearest point of the surface differs. The distance is too large by
        // little.
        double own = hair_distance_to_mesh(collision_mesh, p, gradient), exact = far - 0.1;
        assert_true(own > exact - 1e-3 && own < 1.06 * exact + 1e-3);
        assert_true(gradient[0] * p[0] + gradient[1] * p[1] + gradient[2] * p[2] > 0.95 * far);
    }
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
}

static void mesh_lives_as_long_as_its_last_user(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0.1f, 0.1f};
    struct hair_test_mesh mesh = hair_test_box_mesh(size);
    hair_collision_mesh* collision_mesh = mesh_of(&mesh, 8);
    hair_collision_mesh_hold(collision_mesh);
    hair_collision_mesh_destroy(collision_mesh);
    assert_true(test.blocks > 0);
    assert_true(collision_mesh->distance[0] > 0);
    hair_collision_mesh_release(collision_mesh);
    assert_int_equal(test.blocks, 0);
    hair_collision_mesh_destroy(NULL);
    hair_test_mesh_free(&mesh);
}

static void refused(const hair_collision_mesh_desc* desc, const char* words)
{
    hair_collision_mesh* collision_mesh = NULL;
    if (hair_collision_mesh_create(desc, &collision_mesh) != HAIR_ERROR_ARGUMENT)
        fail_msg("not refused: %s", words);
    assert_null(collision_mesh);
    assert_int_equal(test.errors, 1);
    if (!strstr(test.sentence, words)) fail_msg("\"%s\" does not say \"%s\"", test.sentence, words);
    assert_int_equal(test.blocks, 0);
    test.errors = 0;
}

static void invalid_mesh_is_refused(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0.1f, 0.1f};
    struct hair_test_mesh mesh = hair_test_box_mesh(size);
    hair_collision_mesh_desc good = desc_of(&mesh, 16), desc = good;
    desc.positions = NULL;
    refused(&desc, "positions is NULL");
    desc = good, desc.triangles = NULL;
    refused(&desc, "triangles is NULL");
    desc = good, desc.triangle_count = 0;
    refused(&desc, "triangle_count is 0, not in [1, 16777216]");
    desc = good, desc.triangle_count = 16777217;
    refused(&desc, "triangle_count is 16777217, not in [1, 16777216]");
    desc = good, desc.vertex_count = 0;
    refused(&desc, "vertex_count is 0");
    desc = good, desc.resolution = 257;
    refused(&desc, "resolution is 257, not in [8, 256]");
    desc = good, desc.voxel_size = NAN;
    refused(&desc, "voxel_size is ");
    desc = good, desc.thickness = -1;
    refused(&desc, "thickness is -1");
    desc = good, --desc.vertex_count;
    refused(&desc, ", but there are 7 vertices");
    mesh.positions[4] = NAN;
    refused(&good, "hair_collision_mesh_desc.positions[4] is ");
    mesh.positions[4] = 1e7f;
    refused(&good, "hair_collision_mesh_desc.positions[4] is 1e+07, not in [-1e6, 1e6]");
    for (int i = 0; i < 24; ++i) mesh.positions[i] = 0.5f;
    refused(&good, "none of 12 triangles has three different corners");
    for (int i = 0; i < 24; ++i) mesh.positions[i] = 1e-8f * (float)i;
    refused(&good, "less than 1e-06 m");
    for (int i = 0; i < 24; ++i) mesh.positions[i] = 9e5f + (float)(i % 3 * i) * 0.01f;
    refused(&good, "too far for voxels");
    hair_test_mesh_free(&mesh);
}

// Check a triangle without area, which acts like a line.
static void degenerate_triangles_are_accepted(void** state)
{
    (void)state;
    float positions[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 0, 0};
    uint32_t triangles[] = {0, 1, 2, 1, 2, 3, 0, 0, 1};
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    hair_collision_mesh* collision_mesh = NULL;
    desc.host = &test.host;
    desc.positions = positions;
    desc.triangles = triangles;
    desc.vertex_count = 4;
    desc.triangle_count = 3;
    desc.resolution = 32;
    assert_int_equal(hair_collision_mesh_create(&desc, &collision_mesh), HAIR_OK);
    assert_int_equal(collision_mesh->info.unused, 2);
    size_t nodes = (size_t)collision_mesh->size[0] * collision_mesh->size[1] * collision_mesh->size[2];
    for (size_t i = 0; i < nodes; ++i) assert_true(isfinite(collision_mesh->distance[i]));
    const double over[3] = {1, 0.3, 0};
    hair_test_near("over", 0, hair_distance_to_mesh(collision_mesh, over, NULL),
                   0.3 - (double)collision_mesh->info.thickness / 2, 0.01);
    hair_collision_mesh_destroy(collision_mesh);
}

// Check random meshes. Each gives a finite field or an error.
static void random_meshes_have_finite_distances(void** state)
{
    (void)state;
    uint32_t seed = 1, made = 0;
    for (int n = 0; n < 60; ++n) {
        float positions[60];
        uint32_t triangles[90];
        for (int i = 0; i < 60; ++i)
            positions[i] = ldexpf(hair_random(&seed) - 0.5f, n % 3 ? 0 : (int)(40 * hair_random(&seed)) - 20);
        for (int i = 0; i < 90; ++i) triangles[i] = (uint32_t)(20 * hair_random(&seed));
        hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
        hair_collision_mesh* collision_mesh = NULL;
        desc.host = &test.host, desc.positions = positions, desc.triangles = triangles;
        desc.vertex_count = 20, desc.triangle_count = 30, desc.resolution = 12;
        desc.voxel_size = n % 4 ? 0 : ldexpf(1, (int)(40 * hair_random(&seed)) - 20);
        desc.thickness = n % 5 ? 0 : ldexpf(1, (int)(40 * hair_random(&seed)) - 20);
        desc.thickness = fminf(desc.thickness, 1e6f), desc.voxel_size = fminf(desc.voxel_size, 1e6f);
        // Fine grids take long.
        if (desc.voxel_size > 0 && desc.voxel_size < 0.01f) desc.voxel_size = 0;
        hair_result result = hair_collision_mesh_create(&desc, &collision_mesh);
        assert_true(result == HAIR_OK || result == HAIR_ERROR_ARGUMENT);
        if (result) continue;
        size_t nodes = (size_t)collision_mesh->size[0] * collision_mesh->size[1] * collision_mesh->size[2];
        for (size_t i = 0; i < nodes; ++i) assert_true(isfinite(collision_mesh->distance[i]));
        hair_collision_mesh_destroy(collision_mesh);
        ++made;
    }
    test.errors = 0;
    assert_true(made > 30);
}

static void refused_allocations_are_errors_that_leak_nothing(void** state)
{
    (void)state;
    const float size[3] = {0.1f, 0.1f, 0.1f};
    struct hair_test_mesh mesh = hair_test_box_mesh(size);
    hair_collision_mesh_desc desc = desc_of(&mesh, 8);
    hair_collision_mesh* collision_mesh = NULL;
    uint32_t n = 0;
    for (hair_result result = HAIR_ERROR_MEMORY; result;) {
        test.allocations = 0;
        test.refuse = ++n;
        result = hair_collision_mesh_create(&desc, &collision_mesh);
        if (result) assert_int_equal(test.blocks, 0);
        assert_true(result == HAIR_OK || result == HAIR_ERROR_MEMORY);
    }
    assert_true(n > 6);
    test.errors = 0;
    hair_collision_mesh_destroy(collision_mesh);
    hair_test_mesh_free(&mesh);
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, start, stop)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(distance_to_a_box_mesh_equals_a_box),
        TEST(distance_to_a_ball_mesh_equals_a_sphere),
        TEST(mesh_inside_does_not_depend_on_winding),
        TEST(triangle_soup_is_closed_by_equal_positions),
        TEST(an_open_mesh_is_a_shell_and_the_log_warns),
        TEST(hollow_of_a_mesh_is_outside),
        TEST(intersecting_balls_have_one_inside),
        TEST(distance_beyond_the_grid_is_to_the_surface),
        TEST(mesh_lives_as_long_as_its_last_user),
        TEST(invalid_mesh_is_refused),
        TEST(degenerate_triangles_are_accepted),
        TEST(random_meshes_have_finite_distances),
        TEST(refused_allocations_are_errors_that_leak_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
