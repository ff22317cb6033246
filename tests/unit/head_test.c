// head_test.c - the bust that tools draw, on the built-in scalp and around its colliders.
#include "lib/collide/distance.h"
#include "lib/groom/style_scalp.h"
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
#include "tools/common/head_collision.c"
#include "tools/common/head_eyes.c"
#include "tools/common/head_parts.c"
#include "tools/common/head_pose.c"
#include "tools/common/head_subdivide.c"
#undef COLUMNS
#undef ROWS
#include "tools/common/head_tie.c"

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

// Check that each root has skin within a millimetre and a half, which is about half the distance of
// neighbouring vertices of the mesh.
static void roots_lie_on_the_skin(void** state)
{
    (void)state;
    hair_asset_info info;
    hair_asset* asset = make_scalp(&info);
    struct head_mesh mesh;
    assert_int_equal(head_mesh_create(NULL, &mesh), 0);
    for (uint32_t i = 0; i < info.scalp_vertex_count; ++i) {
        point root = point_of(info.scalp_positions + 3 * i);
        float nearest = INFINITY, height = INFINITY;
        for (uint32_t k = 0; k < mesh.vertex_count; ++k) {
            point d = head_add(root, point_of(mesh.positions + 3 * k), -1);
            float square = head_dot(d, d);
            if (square >= nearest || mesh.surface[3 * k] < 1) continue;
            nearest = square;
            height = head_dot(d, point_of(mesh.normals + 3 * k));
        }
        assert_true(fabsf(height) < 1e-3f);
    }
    head_mesh_free(&mesh);
    hair_asset_destroy(asset);
}

// Check the hairline of the paint and of the fine hairs.
static void paint_follows_the_hairline(void** state)
{
    (void)state;
    for (int i = 0; i <= 180; ++i) {
        float azimuth = (float)i * (PI / 180), height = hair_scalp_hairline(azimuth);
        point p = {0.077f * sinf(azimuth), height, 0.096f * cosf(azimuth)};
        assert_true(fabsf(head_above_hairline(p)) < 1e-4f);
    }
}

// Return the squared distance of a vertex from the centre of the nearer eye.
static float square_from_eye(const float* p)
{
    point d = head_add((point){fabsf(p[0]), p[1], p[2]}, HEAD_EYE, -1);
    return head_dot(d, d);
}

#define HEM 1.15f // Height of the lower edges of the garment, m.

static void the_mesh_is_sound_and_faces_outwards(void** state)
{
    (void)state;
    struct head_mesh mesh;
    assert_int_equal(head_mesh_create(NULL, &mesh), 0);
    assert_true(mesh.triangle_count > 100000 && mesh.triangle_count < 300000);
    uint32_t skin = 0, wet = 0, cloth = 0, hem = 0, hairs = 0;
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        const float *p = mesh.positions + 3 * i, *color = mesh.colors + 3 * i,
                    *surface = mesh.surface + 3 * i;
        point n = point_of(mesh.normals + 3 * i);
        assert_true(fabsf(p[0]) < 0.3f && p[1] > HEM - 1e-4f && p[1] < 1.74f && fabsf(p[2]) < 0.2f);
        assert_true(fabsf(head_dot(n, n) - 1) < 1e-3f);
        for (int k = 0; k < 3; ++k) assert_true(color[k] > 0 && color[k] < 1 && surface[k] >= 0);
        assert_true(surface[2] <= 1);
        skin += surface[0] >= 1;
        hairs += surface[0] == HEAD_KIND_HAIR;
        // Hair covers skin above the hairline and at the brows.
        if (surface[0] > 1)
            assert_true(head_above_hairline(point_of(p)) > -0.002f || head_brow(point_of(p)) > 0);
        // Cloth is blue, and skin never is. Eyes are wet.
        bool is_cloth = surface[0] == 0 && color[0] < color[2];
        cloth += is_cloth;
        hem += is_cloth && p[1] < HEM + 1e-4f;
        wet += surface[1] > 2;
        if (surface[1] > 2) assert_true(square_from_eye(p) < 0.017f * 0.017f);
        assert_false(surface[0] > 0 && color[0] < color[2]);
    }
    print_message("    vertices of the hem: %u\n", hem);
    assert_true(hem > 100); // The garment ends in level edges.
    assert_true(skin > 50000 && cloth > 5000 && wet > 1000 && hairs > 10000);
    // The volume under the surface is about that of a bust of 25 kg, and positive only if triangles
    // face outwards. The surface is open below.
    double volume = 0;
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
        const uint32_t* corner = mesh.triangles + 3 * i;
        for (int k = 0; k < 3; ++k) assert_true(corner[k] < mesh.vertex_count);
        const float *a = mesh.positions + 3 * corner[0], *b = mesh.positions + 3 * corner[1];
        const float* c = mesh.positions + 3 * corner[2];
        // Height from the bottom, so that the missing lid has no share.
        double y[3] = {a[1] - HEM, b[1] - HEM, c[1] - HEM};
        volume += a[0] * (y[1] * c[2] - b[2] * y[2]) + y[0] * ((double)b[2] * c[0] - (double)b[0] * c[2]) +
                  a[2] * (b[0] * y[2] - y[1] * c[0]);
    }
    assert_true(volume / 6 > 0.01 && volume / 6 < 0.04);
    head_mesh_free(&mesh);
}

static bool find_tie(hair_style style, struct head_tie* out)
{
    hair_style_desc desc = hair_style_desc_default();
    hair_groom_desc groom_desc = hair_groom_desc_default();
    hair_asset* asset = NULL;
    hair_groom* groom = NULL;
    desc.style = style;
    assert_int_equal(hair_asset_generate(&desc, &asset), HAIR_OK);
    assert_int_equal(hair_asset_to_groom_desc(asset, &groom_desc), HAIR_OK);
    assert_int_equal(hair_groom_create(&groom_desc, &groom), HAIR_OK);
    bool is_tied = head_find_tie(groom, out);
    hair_groom_destroy(groom);
    hair_asset_destroy(asset);
    return is_tied;
}

// Check that only tied haircuts have a tie, and the places of those of a ponytail and of a braid.
static void ties_are_where_hair_is_tied(void** state)
{
    (void)state;
    struct head_tie tie;
    for (int style = 0; style < HAIR_STYLE_COUNT; ++style) {
        bool is_tied = style == HAIR_STYLE_PONYTAIL || style == HAIR_STYLE_BUN || style == HAIR_STYLE_BRAID;
        assert_int_equal(find_tie((hair_style)style, &tie), is_tied);
        if (style != HAIR_STYLE_PONYTAIL && style != HAIR_STYLE_BRAID) continue;
        bool is_high = style == HAIR_STYLE_PONYTAIL; // Above the ears, behind the head.
        point way = head_add(point_of(tie.at), (point){0, is_high ? 1.672f : 1.590f, -0.105f}, -1);
        assert_true(head_dot(way, way) < 0.015f * 0.015f);
        assert_true(tie.axis[2] < -0.5f); // Hair goes away from the head.
        assert_true(tie.radius > 0.004f && tie.radius < 0.012f);
    }
}

// Check that a tie leaves some fine hairs loose, of which none is far from the head.
static void tie_leaves_short_hairs_loose(void** state)
{
    (void)state;
    const struct head_tie tie = {{0, 1.67f, -0.11f}, {0, 0, -1}, 0.008f};
    struct head_mesh loose, tied;
    assert_int_equal(head_mesh_create(NULL, &loose), 0);
    assert_int_equal(head_mesh_create(&tie, &tied), 0);
    uint32_t band = 2 * 64 * 16, coarse = loose.triangle_count - loose.fine_count;
    assert_int_equal(tied.triangle_count - tied.fine_count, coarse + band);
    assert_true(tied.fine_count > loose.fine_count + 5000);
    for (uint32_t i = loose.vertex_count; i < tied.vertex_count; ++i) {
        const float* p = tied.positions + 3 * i;
        assert_true(fabsf(p[0]) < 0.11f && p[1] > 1.51f && p[1] < 1.72f && fabsf(p[2]) < 0.14f);
    }
    head_mesh_free(&tied);
    head_mesh_free(&loose);
}

// Check that the band is closed and faces outwards, by the volume of a torus.
static void band_is_a_torus(void** state)
{
    (void)state;
    const struct head_tie tie = {{0.1f, 1.5f, -0.2f}, {0.6f, 0, -0.8f}, 0.01f};
    struct head_builder builder = {0};
    head_put_tie(&builder, &tie);
    const struct head_mesh* mesh = &builder.mesh;
    assert_false(builder.failed);
    double volume = 0, radius = 0.01 + 0.5 * (double)THICKNESS;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        point p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = head_add(point_of(mesh->positions + 3 * (size_t)mesh->triangles[3 * i + (uint32_t)k]),
                            point_of(tie.at), -1);
        volume += (double)head_dot(p[0], head_cross(p[1], p[2])) / 6;
    }
    double exact = 2 * PI * PI * radius * (double)THICKNESS * (double)THICKNESS;
    assert_true(fabs(volume / exact - 1) < 0.04);
    head_mesh_free(&builder.mesh);
}

// Check the rules of Catmull and Clark on a cube of side 2, and on an open square.
static void a_cube_is_subdivided_by_the_rules(void** state)
{
    (void)state;
    static const uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    struct head_surface cube = {.vertex_count = 8, .face_count = 6};
    cube.vertices = calloc(8, sizeof *cube.vertices);
    cube.faces = malloc(sizeof sides);
    memcpy(cube.faces, sides, sizeof sides);
    for (uint32_t i = 0; i < 8; ++i)
        for (uint32_t k = 0; k < 3; ++k) cube.vertices[i][k] = i >> k & 1 ? 1.0f : -1.0f;
    assert_int_equal(head_subdivide(&cube), 0);
    assert_int_equal(cube.vertex_count, 26);
    assert_int_equal(cube.face_count, 24);
    for (uint32_t i = 0; i < 8; ++i)
        for (uint32_t k = 0; k < 3; ++k) assert_float_equal(fabsf(cube.vertices[i][k]), 5.0f / 9, 1e-6f);
    for (uint32_t i = 14; i < 26; ++i) {
        const float* p = cube.vertices[i];
        assert_float_equal(fabsf(p[0]) + fabsf(p[1]) + fabsf(p[2]), 1.5f, 1e-6f);
    }
    head_surface_free(&cube);

    struct head_surface square = {.vertex_count = 4, .face_count = 1};
    square.vertices = calloc(4, sizeof *square.vertices);
    square.faces = malloc(sizeof *square.faces);
    memcpy(square.faces, (const uint32_t[4]){0, 1, 2, 3}, sizeof *square.faces);
    square.vertices[1][0] = square.vertices[2][0] = square.vertices[2][1] = square.vertices[3][1] = 8;
    assert_int_equal(head_subdivide(&square), 0);
    assert_float_equal(square.vertices[0][0], 1, 1e-6f);
    assert_float_equal(square.vertices[0][1], 1, 1e-6f);
    assert_float_equal(square.vertices[4][0], 4, 1e-6f);
    head_surface_free(&square);
}

static float collider_distance(const hair_collider* collider, point p)
{
    // The axis is +y rotated by the quaternion.
    const float* q = collider->rotation;
    point axis = {2 * (q[0] * q[1] - q[3] * q[2]), 1 - 2 * (q[0] * q[0] + q[2] * q[2]),
                  2 * (q[1] * q[2] + q[3] * q[0])};
    point d = head_add(p, point_of(collider->position), -1);
    float t = fminf(fmaxf(head_dot(d, axis), -collider->size[1]), collider->size[1]);
    d = head_add(d, axis, -t);
    return sqrtf(head_dot(d, d)) - collider->size[0];
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
                fminf(nearest, collider_distance(&colliders[k], point_of(info.scalp_positions + 3 * i)));
        assert_true(nearest > -0.0005f && nearest < 0.0035f);
    }
    hair_asset_destroy(asset);
}

// Check the distances of the drawn vertices of a part to the surface of a collision mesh.
static void check_surface(const hair_collision_mesh* mesh, const struct cut* cut,
                          const struct hair_head_pose* pose, double voxel)
{
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_MESH;
    collider.mesh = mesh;
    double sum = 0, furthest = 0;
    uint32_t count = 0;
    struct head_surface part = {0};
    assert_int_equal(head_load_part(cut->part, &part), 0);
    for (uint32_t k = 0; k < part.vertex_count; ++k) {
        point p = point_of(part.vertices[k]);
        float moved[3];
        if (p.y < cut->lowest + 0.01f || p.y > cut->highest) continue;
        if (cut->part == HEAD_SKIN) p = head_on_skull(p);
        const float rest[3] = {p.x, p.y, p.z};
        if (cut->is_inside_collar && !is_inside_collar(rest)) continue;
        hair_head_pose_move(pose, rest, moved);
        const double at[3] = {(double)moved[0], (double)moved[1], (double)moved[2]};
        double distance = fabs(hair_distance_to_collider(&collider, at, NULL));
        furthest = fmax(furthest, distance);
        sum += distance;
        ++count;
    }
    print_message("    %u vertices, off by %.2f mm on average, by %.2f mm at most\n", count,
                  1e3 * sum / count, 1e3 * furthest);
    assert_true(count > 200);
    assert_true(sum / count < 1e-3 && furthest < voxel);
    head_surface_free(&part);
}

// Return the pose of a head that is turned about the vertical axis.
static struct hair_head_pose turned(float turn, float breath)
{
    float c = cosf(turn), s = sinf(turn);
    const float transform[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
    return hair_head_pose_at(transform, breath, false);
}

static void check_closed(const hair_collision_mesh* mesh)
{
    hair_collision_mesh_info info = hair_collision_mesh_info_default();
    assert_int_equal(hair_collision_mesh_describe(mesh, &info), HAIR_OK);
    assert_true(info.is_closed);
    assert_int_equal(info.unused, 0);
}

// Check that surfaces to collide with are those of the drawn skin and garment, to a millimetre on
// average. Lids, lips and nostrils are finer than the voxels.
static void surfaces_are_those_that_are_drawn(void** state)
{
    struct hair_test_host* host = *state;
    hair_collision_mesh* made;
    struct hair_head_pose rest = turned(0, 0);
    assert_int_equal(head_collision_mesh_create(&host->host, &made), 0);
    check_closed(made);
    check_surface(made, &head_cut, &rest, (double)VOXEL);
    hair_collision_mesh_destroy(made);

    struct head_solid body;
    assert_int_equal(head_body_create(&body), 0);
    float* moved = malloc((size_t)body.vertex_count * 3 * sizeof *moved);
    for (int turn = 0; turn < 2; ++turn) {
        struct hair_head_pose pose = turned(0.6f * (float)turn, 0.01f * (float)turn);
        for (size_t i = 0; i < body.vertex_count; ++i)
            hair_head_pose_move(&pose, body.positions + 3 * i, moved + 3 * i);
        hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
        desc.host = &host->host;
        desc.positions = moved;
        desc.triangles = body.triangles;
        desc.vertex_count = body.vertex_count;
        desc.triangle_count = body.triangle_count;
        desc.voxel_size = 0.008f;
        assert_int_equal(hair_collision_mesh_create(&desc, &made), HAIR_OK);
        check_closed(made);
        for (size_t i = 0; i < sizeof body_cuts / sizeof *body_cuts; ++i)
            check_surface(made, &body_cuts[i], &pose, (double)desc.voxel_size);
        hair_collision_mesh_destroy(made);
    }
    free(moved);
    head_solid_free(&body);
}

static void breath_widens_the_chest_only(void** state)
{
    (void)state;
    struct hair_head_pose pose = turned(0.5f, 0.008f), still = turned(0.5f, 0);
    static const float rest[][3] = {
        {0, 1.25f, 0.095f}, {0.1f, 1.28f, -0.03f}, {0, 1.45f, 0.02f}, {0, 1.6f, 0.1f}};
    static const float move[][3] = {{0, 0.002f, 0.008f}, {0.0016f, 0.002f, 0}, {0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < sizeof rest / sizeof *rest; ++i) {
        float breathing[3], held[3];
        hair_head_pose_move(&pose, rest[i], breathing);
        hair_head_pose_move(&still, rest[i], held);
        for (int k = 0; k < 3; ++k) assert_float_equal(breathing[k] - held[k], move[i][k], 1e-6);
    }
    struct hair_head_pose whole = hair_head_pose_at(pose.transform, 0.008f, true);
    float moved[3];
    hair_head_pose_move(&whole, rest[0], moved);
    assert_float_equal(moved[0], sinf(0.5f) * rest[0][2], 1e-6);
    assert_float_equal(moved[1], rest[0][1], 1e-6);
}

static void mesh_without_memory_is_not_made(void** state)
{
    struct hair_test_host* host = *state;
    hair_collision_mesh* made;
    assert_int_equal(head_collision_mesh_create(&host->host, &made), 0);
    hair_collision_mesh_destroy(made);
    uint32_t allocations = host->allocations;
    made = NULL;
    for (uint32_t refuse = 1; refuse <= allocations; ++refuse) {
        host->refuse = host->allocations + refuse;
        assert_int_equal(head_collision_mesh_create(&host->host, &made), -1);
        assert_null(made);
    }
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
    struct hair_test_host host;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_lie_on_the_skin),
        cmocka_unit_test(paint_follows_the_hairline),
        cmocka_unit_test(the_mesh_is_sound_and_faces_outwards),
        cmocka_unit_test(ties_are_where_hair_is_tied),
        cmocka_unit_test(tie_leaves_short_hairs_loose),
        cmocka_unit_test(band_is_a_torus),
        cmocka_unit_test(a_cube_is_subdivided_by_the_rules),
        cmocka_unit_test(colliders_fill_the_scalp_from_inside),
        HAIR_TEST_WITH_HOST(surfaces_are_those_that_are_drawn, &host),
        cmocka_unit_test(breath_widens_the_chest_only),
        HAIR_TEST_WITH_HOST(mesh_without_memory_is_not_made, &host),
        cmocka_unit_test(colliders_beyond_the_capacity_are_only_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
