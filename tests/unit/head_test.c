// head_test.c - the bust that tools draw, on the built-in scalp and around its colliders.
#include "tests/support/host.h"

#include <hair/hair_asset.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

// Tools are not linked into tests.
#include "tools/common/head.c"
#include "tools/common/head_cut.c"
#include "tools/common/head_shape.c"

static point load_point(const float* p)
{
    return (point){p[0], p[1], p[2]};
}

static hair_asset* make_scalp(hair_asset_info* info)
{
    hair_style_desc desc = hair_style_desc_default();
    hair_asset* asset;
    desc.guide_count = 1000;
    desc.length = 0.1f;
    *info = hair_asset_info_default();
    assert_int_equal(hair_asset_generate(&desc, &asset), HAIR_OK);
    assert_int_equal(hair_asset_describe(asset, info), HAIR_OK);
    return asset;
}

static void roots_lie_on_the_skin(void** state)
{
    (void)state;
    hair_asset_info info;
    hair_asset* asset = make_scalp(&info);
    for (uint32_t i = 0; i < info.scalp_vertex_count; ++i)
        assert_true(fabsf(head_distance(load_point(info.scalp_positions + 3 * i))) < 1e-3f);
    hair_asset_destroy(asset);
}

static void the_mesh_lies_on_the_surface_and_faces_outwards(void** state)
{
    (void)state;
    struct head_mesh mesh;
    assert_int_equal(head_mesh_create(&mesh), 0);
    assert_true(mesh.triangle_count > 30000 && mesh.triangle_count < 80000);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        point p = load_point(mesh.positions + 3 * i), n = load_point(mesh.normals + 3 * i);
        if (p.y > HEAD_BOTTOM + 0.01f) assert_true(fabsf(head_distance(p)) < 1.5e-3f);
        // Normals are not normalized between two vertices.
        assert_true(fabsf(dot(n, n) - 1) < 0.2f);
        for (int k = 0; k < 3; ++k) assert_true(mesh.colors[3 * i + k] > 0 && mesh.colors[3 * i + k] < 1);
    }
    // The garment exists, and only below the collar.
    uint32_t worn = 0;
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        // Cloth is blue, and skin never is.
        int is_cloth = mesh.colors[3 * i] < mesh.colors[3 * i + 2];
        float below = head_below_collar(load_point(mesh.positions + 3 * i));
        assert_true(is_cloth ? below > -1e-3f : below < 1e-3f);
        worn += (uint32_t)is_cloth;
    }
    assert_true(worn > 3000);
    // The volume under a closed, outward-facing surface is positive. It is about the volume of a
    // bust of 25 kg.
    double volume = 0;
    uint32_t cloth = 0;
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const uint32_t* corner = mesh.triangles + 3 * i;
        for (int k = 0; k < 3; ++k) assert_true(corner[k] < mesh.vertex_count);
        cloth += mesh.colors[3 * corner[0]] < mesh.colors[3 * corner[0] + 2];
        const float *a = mesh.positions + 3 * corner[0], *b = mesh.positions + 3 * corner[1];
        const float* c = mesh.positions + 3 * corner[2];
        volume += a[0] * ((double)b[1] * c[2] - (double)b[2] * c[1]) +
                  a[1] * ((double)b[2] * c[0] - (double)b[0] * c[2]) +
                  a[2] * ((double)b[0] * c[1] - (double)b[1] * c[0]);
    }
    assert_true(cloth > 6000);
    assert_true(volume / 6 > 0.01 && volume / 6 < 0.03);
    head_mesh_free(&mesh);
}

static float collider_distance(const hair_collider* collider, point p)
{
    // The axis is +y rotated by the quaternion.
    const float* q = collider->rotation;
    point axis = {2 * (q[0] * q[1] - q[3] * q[2]), 1 - 2 * (q[0] * q[0] + q[2] * q[2]),
                  2 * (q[1] * q[2] + q[3] * q[0])};
    point d = sub(p, load_point(collider->position));
    float t = clamp(dot(d, axis), -collider->size[1], collider->size[1]);
    return length(sub(d, (point){axis.x * t, axis.y * t, axis.z * t})) - collider->size[0];
}

// Check that roots are outside the colliders, and that the skull is at the place where it is drawn.
static void colliders_fill_the_scalp_from_inside(void** state)
{
    (void)state;
    hair_collider colliders[HEAD_COLLIDERS];
    uint32_t count = head_colliders(colliders, HEAD_COLLIDERS);
    hair_asset_info info;
    hair_asset* asset = make_scalp(&info);
    assert_in_range(count, 1, HEAD_COLLIDERS);
    for (uint32_t i = 0; i < info.scalp_vertex_count; ++i) {
        float nearest = INFINITY;
        for (uint32_t k = 0; k < count; ++k)
            nearest =
                fminf(nearest, collider_distance(&colliders[k], load_point(info.scalp_positions + 3 * i)));
        assert_true(nearest > -0.0005f && nearest < 0.0035f);
    }
    hair_asset_destroy(asset);
}

static void colliders_beyond_the_capacity_are_only_counted(void** state)
{
    (void)state;
    hair_collider colliders[2];
    memset(colliders, 0, sizeof colliders);
    assert_int_equal(head_colliders(colliders, 1), head_colliders(NULL, 0));
    assert_true(colliders[0].size[0] > 0);
    assert_true(colliders[1].size[0] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_lie_on_the_skin),
        cmocka_unit_test(the_mesh_lies_on_the_surface_and_faces_outwards),
        cmocka_unit_test(colliders_fill_the_scalp_from_inside),
        cmocka_unit_test(colliders_beyond_the_capacity_are_only_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
