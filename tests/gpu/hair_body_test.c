// hair_body_test.c - bodies that deform: the distance on the GPU agrees with the exact mesh, and
// costs nothing unless there is a body.
#include "tests/support/deforming.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "lib/collide/distance.h"

// Signs are right beyond this distance from the surface, in voxels. A column crosses triangles
// whose corners are moved across it by up to 1/64.
#define SNAPPED 0.03

// Maximum error beyond the band, relative to the distance.
#define MAX_FAR 0.16

struct errors {
    double near, far; // worst within the band, and beyond it relative to the distance, voxels
    uint32_t near_count;
};

static void place_of_node(const hair_collision_mesh* mesh, size_t node, double out[3])
{
    const size_t at[3] = {node % mesh->size[0], node / mesh->size[0] % mesh->size[1],
                          node / mesh->size[0] / mesh->size[1]};
    for (int k = 0; k < 3; ++k) out[k] = (double)mesh->origin[k] + (double)mesh->voxel * (double)at[k];
}

// Compare every node of a body with the exact mesh.
static struct errors compare_nodes(struct hair_test* test, const hair_body* body,
                                   const struct hair_test_mesh* mesh)
{
    const hair_collision_mesh* grid = body->mesh;
    struct hair_triangles triangles = hair_test_triangles(test, mesh);
    float* node = hair_test_body_nodes(body);
    struct errors errors = {0};
    double voxel = (double)grid->voxel;
    for (size_t i = 0; i < (size_t)grid->size[0] * grid->size[1] * grid->size[2]; ++i) {
        double at[3];
        place_of_node(grid, i, at);
        double exact = hair_test_exact(&triangles, at) / voxel, own = (double)node[i] / voxel;
        if (fabs(exact) > SNAPPED && (exact < 0) != (own < 0))
            fail_msg("node %zu is %g voxels from the surface, said to be %g", i, exact, own);
        double off = fabs(fabs(own) - fabs(exact));
        if (fabs(exact) < HAIR_BODY_BAND - 0.1) {
            errors.near = fmax(errors.near, off);
            ++errors.near_count;
        } else {
            errors.far = fmax(errors.far, off / fabs(exact));
        }
    }
    hair_triangles_free(&test->host.host, &triangles);
    free(node);
    print_message("    %u near nodes off by %.4f voxels, others by %.4f of the distance\n", errors.near_count,
                  errors.near, errors.far);
    return errors;
}

static void nodes_hold_the_distance_of_every_shape(void** state)
{
    struct hair_test* test = *state;
    for (int crossed = 0; crossed < 2; ++crossed) {
        struct hair_test_mesh mesh = hair_test_lump(30, 40, 0, crossed);
        hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 24);
        assert_true(body->mesh->info.is_closed);
        for (int shape = 0; shape < 3; ++shape) {
            hair_test_mesh_free(&mesh);
            mesh = hair_test_lump(30, 40, 0.9f * (float)shape, crossed);
            hair_test_deform(test, body, &mesh);
            struct errors errors = compare_nodes(test, body, &mesh);
            assert_true(errors.near_count > 1000);
            assert_true(errors.near < 0.002 && errors.far < MAX_FAR);
        }
        hair_body_destroy(body);
        hair_test_mesh_free(&mesh);
    }
}

// Check a mesh of few triangles, each of which reaches across the grid.
static void nodes_hold_the_distance_to_large_triangles(void** state)
{
    struct hair_test* test = *state;
    const float half[3] = {0.3f, 0.2f, 0.11f};
    struct hair_test_mesh mesh = hair_test_box_mesh(half);
    hair_body* body = hair_test_deforming(test, &mesh, 0.31f, 24);
    struct errors errors = compare_nodes(test, body, &mesh);
    assert_true(errors.near_count > 1000 && errors.near < 0.002 && errors.far < MAX_FAR);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        float *p = mesh.positions + 3 * i, x = p[0], y = p[1];
        p[0] = 0.8f * x - 0.3f * y, p[1] = 0.3f * x + 0.8f * y, p[2] += 0.3f * y;
    }
    hair_test_deform(test, body, &mesh);
    errors = compare_nodes(test, body, &mesh);
    assert_true(errors.near_count > 1000 && errors.near < 0.002 && errors.far < MAX_FAR);
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
}

static double random_number(uint32_t* seed)
{
    *seed = *seed * 1664525 + 1013904223;
    return (double)(*seed >> 8) / 16777216;
}

// Check points within a voxel per axis of vertices. Distances are interpolated between nodes there.
static void distance_near_the_surface_is_within_half_a_voxel(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(40, 60, 0.5f, 0);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 32);
    hair_collision_mesh grid = *body->mesh;
    struct hair_triangles triangles = hair_test_triangles(test, &mesh);
    double max = 0, voxel = (double)grid.voxel;
    uint32_t seed = 1;
    grid.distance = hair_test_body_nodes(body);
    for (uint32_t i = 0; i < 5000; ++i) {
        const float* vertex = mesh.positions + 3 * (size_t)(random_number(&seed) * mesh.vertex_count);
        double at[3];
        for (int k = 0; k < 3; ++k) at[k] = (double)vertex[k] + (2 * random_number(&seed) - 1) * voxel;
        max =
            fmax(max, fabs(hair_distance_to_mesh(&grid, at, NULL) - hair_test_exact(&triangles, at)) / voxel);
    }
    print_message("    off by at most %.3f voxels\n", max);
    assert_true(max <= 0.5);
    free(grid.distance);
    hair_triangles_free(&test->host.host, &triangles);
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
}

static void check_shell(struct hair_test* test, const struct hair_test_mesh* mesh, hair_body* body)
{
    const hair_collision_mesh* grid = hair_body_get_mesh(body);
    struct hair_triangles triangles = hair_test_triangles(test, mesh);
    float* node = hair_test_body_nodes(body);
    assert_false(grid->info.is_closed);
    assert_true(grid->info.thickness == 2 * grid->voxel);
    for (size_t i = 0; i < (size_t)grid->size[0] * grid->size[1] * grid->size[2]; i += 7) {
        double at[3];
        place_of_node(grid, i, at);
        double exact = fabs(hair_test_exact(&triangles, at)), voxel = (double)grid->voxel;
        hair_test_near("node", i, (double)node[i], exact - voxel,
                       exact < 1.9 * voxel ? 0.01 * voxel : MAX_FAR * exact);
    }
    free(node);
    hair_triangles_free(&test->host.host, &triangles);
    hair_body_destroy(body);
}

// Check a body whose last triangle is missing. It has no inside, so all distances are from a shell.
static void open_body_is_a_shell(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(20, 30, 0, 0);
    --mesh.triangle_count;
    check_shell(test, &mesh, hair_test_deforming(test, &mesh, 0.16f, 32));
    hair_test_mesh_free(&mesh);
}

static void two_sided_body_is_a_shell(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(20, 30, 0, 0);
    hair_body_desc desc = hair_test_body_desc(&mesh, 0.16f, 32);
    hair_body* body = NULL;
    uint32_t warnings = test->host.warnings;
    desc.two_sided = true;
    hair_test_ok(test, hair_body_create(test->context, &desc, &body));
    assert_int_equal(test->host.warnings, warnings);
    check_shell(test, &mesh, body);
    hair_test_mesh_free(&mesh);
}

// Return how many columns of nodes the last shape of a body computed.
static uint32_t changed_columns(const hair_body* body)
{
    struct hair_body_change change;
    glGetNamedBufferSubData(body->grid.change, 0, sizeof change, &change);
    if (change.first_y > change.last_y || change.first_z > change.last_z) return 0;
    return (change.last_y - change.first_y + 1) * (change.last_z - change.first_z + 1);
}

// Return the maximum motion of the surface that a node has, m.
static float max_motion(const hair_body* body)
{
    const struct hair_sdf_pool* pool = body->grid.pool;
    size_t nodes = (size_t)body->mesh->size[0] * body->mesh->size[1] * body->mesh->size[2];
    float *motion = malloc(3 * nodes * sizeof *motion), max = 0;
    assert_non_null(motion);
    glGetNamedBufferSubData(pool->nodes,
                            (GLintptr)((pool->pooled[body->grid.place].first + nodes) * sizeof *motion),
                            (GLsizeiptr)(3 * nodes * sizeof *motion), motion);
    for (size_t i = 0; i < 3 * nodes; ++i) max = fmaxf(max, fabsf(motion[i]));
    free(motion);
    return max;
}

// Push the vertices within 30 mm of one of them towards or away from the centre.
static void push_part(struct hair_test_mesh* mesh, uint32_t vertex, uint32_t* seed)
{
    const size_t middle = 3 * (size_t)vertex;
    const float at[3] = {mesh->positions[middle], mesh->positions[middle + 1], mesh->positions[middle + 2]};
    float scale = 0.8f + 0.35f * (float)random_number(seed);
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        float* p = mesh->positions + 3 * i;
        float far = hypotf(hypotf(p[0] - at[0], p[1] - at[1]), p[2] - at[2]);
        for (int k = 0; k < 3 && far < 0.03f; ++k) p[k] *= scale;
    }
}

// Move one part of a body many times, and then others. Only nodes around them are computed, and the
// others stay right.
static void only_nodes_around_moved_triangles_are_computed(void** state)
{
    enum { SHAPES = 24 };
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(30, 40, 0, 0);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 32);
    const uint32_t columns = body->mesh->size[1] * body->mesh->size[2];
    uint32_t seed = 1, computed[2] = {0};
    assert_int_equal(changed_columns(body), columns);
    for (int shape = 0; shape < SHAPES; ++shape) {
        bool is_other = shape >= SHAPES / 2;
        push_part(&mesh, is_other ? (uint32_t)(random_number(&seed) * mesh.vertex_count) : 0, &seed);
        hair_test_deform(test, body, &mesh);
        computed[is_other] += changed_columns(body);
        struct errors errors = compare_nodes(test, body, &mesh);
        assert_true(errors.near < 0.002 && errors.far < MAX_FAR);
    }
    for (int i = 0; i < 2; ++i) computed[i] /= SHAPES / 2;
    print_message("    %u and %u of %u columns\n", computed[0], computed[1], columns);
    assert_true(computed[0] > 0 && computed[0] < columns * 3 / 5 && computed[1] < columns * 9 / 10);

    // A vertex that moves by a thousandth of a millimetre ends the motion of the last shape.
    for (uint32_t i = 0; i < mesh.vertex_count; ++i)
        mesh.positions[3 * i + 1] += mesh.positions[3 * i + 1] > 0.05f ? 0.004f : 0;
    hair_test_deform(test, body, &mesh);
    compare_nodes(test, body, &mesh);
    assert_true(max_motion(body) > 1e-3f);
    mesh.positions[0] += 1e-6f;
    hair_test_deform(test, body, &mesh);
    assert_true(max_motion(body) > 0 && max_motion(body) < 2e-6f);
    compare_nodes(test, body, &mesh);
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
}

// Bodies and meshes share a buffer, which grows and is compacted.
static void nodes_survive_growth_of_their_pool(void** state)
{
    struct hair_test* test = *state;
    struct hair_sdf_pool* pool = &test->context->sdf_pool;
    struct hair_test_mesh mesh = hair_test_lump(20, 30, 0, 0), other = hair_test_lump(20, 30, 0, 0);
    hair_body* bodies[3];
    for (int i = 0; i < 3; ++i) bodies[i] = hair_test_deforming(test, &mesh, 0.16f, 16 + 4 * (uint32_t)i);
    hair_test_mesh_free(&other);
    other = hair_test_lump(20, 30, 1, 0);
    hair_test_deform(test, bodies[2], &other);
    GLuint nodes = pool->nodes;
    hair_body_destroy(bodies[0]);
    bodies[0] = hair_test_deforming(test, &mesh, 0.16f, 40);
    assert_int_not_equal(pool->nodes, nodes);
    compare_nodes(test, bodies[0], &mesh);
    compare_nodes(test, bodies[1], &mesh);
    compare_nodes(test, bodies[2], &other);
    for (int i = 0; i < 3; ++i) hair_body_destroy(bodies[i]);
    assert_int_equal(pool->nodes, 0);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&other);
}

static void equal_positions_run_no_pass(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(20, 30, 0, 0);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    const struct hair_gl_program* program = hair_gl_find(&test->context->gl, HAIR_GL_BODY_SCATTER);
    uint32_t generation = body->mesh->generation;
    assert_non_null(program);
    hair_test_deform(test, body, &mesh);
    assert_int_equal(body->mesh->generation, generation);
    mesh.positions[0] += 0.001f;
    hair_test_deform(test, body, &mesh);
    assert_int_equal(body->mesh->generation, generation + 1);
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
}

// Collapse a body to a line, and then to a point. The nodes stay finite.
static void degenerate_triangles_give_finite_distances(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(12, 16, 0, 0);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    for (int axes = 2; axes >= 0; --axes) {
        for (uint32_t i = 0; i < mesh.vertex_count; ++i) mesh.positions[3 * i + (uint32_t)axes] = 0.05f;
        hair_test_deform(test, body, &mesh);
        float* node = hair_test_body_nodes(body);
        const uint32_t* size = body->mesh->size;
        for (uint32_t i = 0; i < size[0] * size[1] * size[2]; ++i)
            assert_true(node[i] > -1e-3f && node[i] < 1);
        free(node);
    }
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
}

// Give positions in a buffer, of which some are outside the box or not finite.
static void positions_in_a_buffer_equal_an_array(void** state)
{
    enum { STRIDE = 20, FIRST = 8 };
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(20, 30, 0, 0), next = hair_test_lump(20, 30, 1, 0);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 24);
    size_t size = FIRST + STRIDE * (size_t)next.vertex_count;
    unsigned char* bytes = malloc(size);
    GLuint buffer;
    memset(bytes, 0xff, size); // Numbers between positions are NaN.
    for (uint32_t i = 0; i < next.vertex_count; ++i)
        memcpy(bytes + FIRST + STRIDE * (size_t)i, next.positions + 3 * i, 12);
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, bytes, GL_DYNAMIC_STORAGE_BIT);
    hair_test_ok(test, hair_body_set_position_buffer(body, buffer, FIRST, STRIDE));
    compare_nodes(test, body, &next);
    assert_int_equal(body->mesh->generation, 2);

    const float away[3] = {0.01f, 5, 0.02f}, wrong[3] = {NAN, 0, 0};
    glNamedBufferSubData(buffer, FIRST, 12, away);
    glNamedBufferSubData(buffer, FIRST + 7 * STRIDE, 12, wrong);
    hair_test_ok(test, hair_body_set_position_buffer(body, buffer, FIRST, STRIDE));
    memcpy(next.positions, away, sizeof away);
    next.positions[1] = 0.16f;
    compare_nodes(test, body, &next);

    hair_test_deform(test, body, &mesh); // The array equals the last one, but the body has moved.
    compare_nodes(test, body, &mesh);
    hair_test_refused(test, hair_body_set_position_buffer(body, buffer, FIRST + 24, STRIDE),
                      HAIR_ERROR_ARGUMENT,
                      "hair_body: offset is 32, not a multiple of 4 from which on gl_buffer's");
    hair_test_refused(test, hair_body_set_position_buffer(body, 0, 0, 12), HAIR_ERROR_ARGUMENT,
                      "hair_body: gl_buffer is 0, not a buffer");
    glDeleteBuffers(1, &buffer);
    free(bytes);
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&next);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(nodes_hold_the_distance_of_every_shape),
        HAIR_TEST(nodes_hold_the_distance_to_large_triangles),
        HAIR_TEST(distance_near_the_surface_is_within_half_a_voxel),
        HAIR_TEST(open_body_is_a_shell),
        HAIR_TEST(two_sided_body_is_a_shell),
        HAIR_TEST(only_nodes_around_moved_triangles_are_computed),
        HAIR_TEST(nodes_survive_growth_of_their_pool),
        HAIR_TEST(equal_positions_run_no_pass),
        HAIR_TEST(degenerate_triangles_give_finite_distances),
        HAIR_TEST(positions_in_a_buffer_equal_an_array),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
