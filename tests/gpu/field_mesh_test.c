// field_mesh_test.c - collision meshes in the field: resampled where they move, and stored once for
// all colliders that use them.
#include "tests/support/fields.h"

#include <math.h>
#include <stdlib.h>

#include "lib/api/api.h"
#include "lib/collide/distance.h"
#include "tests/support/handmade.h"
#include "tests/support/meshes.h"

#define VOXEL 0.008f
#define COLLIDERS 6

static const struct hair_pose head = {{3, -2, 1}, {0.36f, 0.48f, 0, 0.8f}};

struct fixture {
    struct hair_test* test;
    hair_groom* groom;
    struct hair_collider_field field;
    hair_collision_mesh* meshes[2]; // A ball of 0.1 m and a box.
    hair_collider colliders[COLLIDERS];
    uint32_t random;
};

// Make overlapping colliders. Every other collider is a collision mesh.
static void begin(struct hair_test* test, struct fixture* out)
{
    static const float half[] = {0.05f, 0.08f, 0.03f};
    *out = (struct fixture){.test = test, .random = 3};
    out->groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    out->meshes[0] = hair_test_collision_mesh(test, hair_test_ball_mesh(0.1f, 24, 48), 40);
    out->meshes[1] = hair_test_collision_mesh(test, hair_test_box_mesh(half), 40);
    hair_field_create(&out->field, &test->context->sdf_pool, out->groom, VOXEL);
    hair_field_want_numbers(&out->field);
    for (int i = 0; i < COLLIDERS; ++i) {
        out->colliders[i] = hair_test_any_collider(&out->field.box, &head, 0.1f, &out->random);
        if (i % 2) continue;
        out->colliders[i].shape = HAIR_SHAPE_MESH;
        out->colliders[i].mesh = out->meshes[i / 2 % 2];
        out->colliders[i].scale = 0.6f + 0.3f * (float)i;
    }
}

static void end(struct fixture* f)
{
    hair_field_destroy(&f->field);
    assert_null(f->test->context->sdf_pool.pooled);
    assert_int_equal(f->test->context->sdf_pool.nodes, 0);
    hair_collision_mesh_destroy(f->meshes[0]);
    hair_collision_mesh_destroy(f->meshes[1]);
    hair_groom_destroy(f->groom);
}

static void update(struct fixture* f)
{
    hair_test_ok(f->test, hair_field_update(&f->field, f->colliders, COLLIDERS, &head));
}

static void check_voxels(struct fixture* f)
{
    struct hair_test_field read = hair_test_field_read(&f->field);
    double max = 0, voxel = (double)f->field.box.voxel;
    size_t of_meshes = 0;
    for (size_t i = 0; i < hair_test_field_count(&read); ++i) {
        double point[3];
        uint32_t number;
        hair_test_voxel(&f->field.box, &head, i, point);
        double right =
            fmin(hair_test_nearest(f->colliders, COLLIDERS, point, &number), (double)f->field.box.far);
        hair_test_near("voxel", i, (double)read.distance[i], right, 0.05 * voxel);
        max = fmax(max, fabs((double)read.distance[i] - right));
        of_meshes += read.number[i] < COLLIDERS && read.number[i] % 2 == 0;
    }
    print_message("    %zu voxels of meshes, off by at most %.4f of one\n", of_meshes, max / voxel);
    assert_true(of_meshes > 1000);
    hair_test_field_free(&read);
}

static void voxels_hold_the_distance_to_the_nearest_mesh_or_shape(void** state)
{
    struct fixture f;
    begin(*state, &f);
    update(&f);
    check_voxels(&f);
    f.colliders[2].rotation[0] *= -1;
    f.colliders[2].rounding = 0.01f;
    update(&f);
    check_voxels(&f);
    f.colliders[1].position[1] += 0.03f;
    f.colliders[4].mesh = f.colliders[2].mesh;
    update(&f);
    check_voxels(&f);
    end(&f);
}

// Compare a collision mesh of a ball with a sphere, to half a voxel of the field. The voxels of the
// mesh are finer.
static void mesh_of_a_ball_equals_a_sphere(void** state)
{
    struct fixture f;
    begin(*state, &f);
    hair_collider ball = f.colliders[0], sphere = f.colliders[0];
    struct hair_test_field read;
    ball.mesh = f.meshes[0];
    sphere.shape = HAIR_SHAPE_SPHERE;
    sphere.size[0] = 0.1f * ball.scale;
    double voxel = (double)f.field.box.voxel, max = 0;
    hair_test_ok(f.test, hair_field_update(&f.field, &ball, 1, &head));
    read = hair_test_field_read(&f.field);
    for (size_t i = 0; i < hair_test_field_count(&read); ++i) {
        double point[3];
        hair_test_voxel(&f.field.box, &head, i, point);
        double right = hair_distance_to_collider(&sphere, point, NULL);
        if (fabs(right) > 3 * voxel) continue;
        max = fmax(max, fabs((double)read.distance[i] - right));
    }
    print_message("    off by at most %.4f voxels\n", max / voxel);
    assert_true(max < 0.1 * voxel);
    hair_test_field_free(&read);
    end(&f);
}

static void mesh_is_uploaded_once_for_all_instances(void** state)
{
    struct fixture f;
    struct hair_collider_field other;
    begin(*state, &f);
    const struct hair_sdf_pool* collision_meshes = &f.test->context->sdf_pool;
    hair_field_create(&other, &f.test->context->sdf_pool, f.groom, VOXEL);
    update(&f);
    size_t used = collision_meshes->used;
    assert_int_equal(collision_meshes->count, 2);
    hair_test_ok(f.test, hair_field_update(&other, f.colliders, COLLIDERS, &head));
    assert_int_equal(collision_meshes->used, used);
    hair_field_destroy(&other);
    assert_int_equal(collision_meshes->pooled[0].users + collision_meshes->pooled[1].users, 3);
    // The first mesh is released, and another takes its place.
    for (int i = 0; i < COLLIDERS; i += 2) f.colliders[i].mesh = f.meshes[1];
    update(&f);
    assert_int_equal(collision_meshes->pooled[0].users + collision_meshes->pooled[1].users, 3);
    assert_true(!collision_meshes->pooled[0].mesh || !collision_meshes->pooled[1].mesh);
    check_voxels(&f);
    end(&f);
}

// Check meshes that replace each other repeatedly. A released mesh makes room.
static void meshes_that_come_and_go_reuse_their_memory(void** state)
{
    struct fixture f;
    begin(*state, &f);
    size_t max = 0;
    for (int round = 0; round < 40; ++round) {
        for (int i = 0; i < COLLIDERS; i += 2) f.colliders[i].mesh = f.meshes[round % 2];
        update(&f);
        max = f.test->context->sdf_pool.room > max ? f.test->context->sdf_pool.room : max;
    }
    size_t nodes = 0;
    for (int i = 0; i < 2; ++i)
        nodes += (size_t)f.meshes[i]->size[0] * f.meshes[i]->size[1] * f.meshes[i]->size[2];
    assert_true(max <= 3 * nodes + 65536);
    check_voxels(&f);
    end(&f);
}

static void mesh_stays_alive_while_a_field_uses_it(void** state)
{
    struct fixture f;
    begin(*state, &f);
    update(&f);
    hair_collision_mesh_destroy(f.meshes[0]);
    f.meshes[0] = NULL;
    f.colliders[1].position[1] += 0.03f;
    update(&f);
    check_voxels(&f);
    end(&f);
}

static void collider_without_its_mesh_is_ignored(void** state)
{
    struct fixture f;
    begin(*state, &f);
    f.colliders[0].mesh = NULL;
    hair_test_ok(f.test, hair_field_update(&f.field, f.colliders, 1, &head));
    assert_false(hair_field_is_near(&f.field));
    end(&f);
}

static void refused_memory_is_an_error_and_leaves_no_mesh(void** state)
{
    struct fixture f;
    begin(*state, &f);
    size_t bytes = f.test->host.live;
    uint32_t refused = 0;
    for (;; ++refused) {
        f.test->host.refuse = f.test->host.allocations + 1 + refused;
        hair_result result = hair_field_update(&f.field, f.colliders, COLLIDERS, &head);
        f.test->host.refuse = 0;
        if (result == HAIR_OK) break;
        hair_test_refused(f.test, result, HAIR_ERROR_MEMORY, "out of memory for");
        assert_int_equal(f.test->host.live, bytes);
    }
    assert_true(refused > 7);
    check_voxels(&f);
    end(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(voxels_hold_the_distance_to_the_nearest_mesh_or_shape),
        HAIR_TEST(mesh_of_a_ball_equals_a_sphere),
        HAIR_TEST(mesh_is_uploaded_once_for_all_instances),
        HAIR_TEST(meshes_that_come_and_go_reuse_their_memory),
        HAIR_TEST(mesh_stays_alive_while_a_field_uses_it),
        HAIR_TEST(collider_without_its_mesh_is_ignored),
        HAIR_TEST(refused_memory_is_an_error_and_leaves_no_mesh),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
