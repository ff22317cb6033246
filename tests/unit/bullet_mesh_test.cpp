// bullet_mesh_test.cpp - shapes of Bullet that become collision meshes, compared with Bullet's own
// distance, or with that to their triangles.
#include "tests/support/bullet.h"

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/CollisionShapes/btUniformScalingShape.h>

#include <vector>

static double voxel_of(const hair_collider& collider)
{
    hair_collision_mesh_info info = hair_collision_mesh_info_default();
    assert_int_equal(hair_collision_mesh_describe(collider.mesh, &info), HAIR_OK);
    assert_true(info.is_closed);
    return static_cast<double>(info.voxel_size * collider.scale);
}

// Compare distances near the surface, in voxels. Interpolated distances have an error of up to 0.87
// voxels over a sharp edge.
static void compare_mesh(const char* what, const btConvexShape& shape)
{
    take(shape, btTransform::getIdentity());
    const double voxel = voxel_of(colliders(1)[0]);
    const error error = compare(what, shape, std::fmax(0.9 * voxel, GJK_ERROR),
                                static_cast<double>(shape.getMargin()) + 2 * voxel);
    const double rms = std::sqrt(error.squares / error.count);
    print_message("    %s: off by up to %.3f voxels, rms %.3f\n", what, error.worst / voxel, rms / voxel);
    assert_true(rms <= 0.25 * voxel);
}

static void distances_to_convex_shapes_equal_gjk(void**)
{
    randoms random;
    std::vector<btVector3> points;
    for (int i = 0; i < 40; ++i) points.push_back(random.vector(btScalar(0.3)));
    btConvexHullShape hull(&points[0].x(), static_cast<int>(points.size()));
    compare_mesh("hull", hull);
    hull.setLocalScaling(btVector3(2, 1, btScalar(0.5)));
    hull.setMargin(btScalar(0.01));
    compare_mesh("scaled hull", hull);
    btConvexPointCloudShape cloud(points.data(), static_cast<int>(points.size()), btVector3(1, 2, 1));
    compare_mesh("point cloud", cloud);
    btBU_Simplex1to4 tetrahedron(btVector3(0, 0, 0), btVector3(btScalar(0.5), 0, 0),
                                 btVector3(0, btScalar(0.4), 0), btVector3(btScalar(0.1), 0, btScalar(0.6)));
    compare_mesh("tetrahedron", tetrahedron);
    btTriangleMesh triangles;
    for (int i = 0; i + 2 < 40; ++i) triangles.addTriangle(points[i], points[i + 1], points[i + 2]);
    btConvexTriangleMeshShape mesh(&triangles);
    mesh.setLocalScaling(btVector3(1, btScalar(1.5), 1));
    compare_mesh("convex mesh", mesh);
    btUniformScalingShape scaled(&hull, btScalar(0.5));
    compare_mesh("uniform scaling", scaled);
    hair_bullet_invalidate(test.bullet, nullptr);
}

static void distances_to_multi_spheres_equal_gjk(void**)
{
    const btVector3 at[] = {btVector3(0, 0, 0), btVector3(btScalar(0.3), 0, 0),
                            btVector3(0, btScalar(0.3), btScalar(0.1)), btVector3(0, 0, btScalar(0.4))};
    const btScalar even[] = {btScalar(0.1), btScalar(0.1), btScalar(0.1), btScalar(0.1)},
                   uneven[] = {btScalar(0.1), btScalar(0.2), btScalar(0.05), btScalar(0.12)};
    btMultiSphereShape one(at, uneven, 1), two(at, even, 2), four(at, even, 4), others(at, uneven, 4);
    compare("one sphere", one, GJK_ERROR, 1);
    assert_int_equal(colliders(1)[0].shape, HAIR_SHAPE_SPHERE);
    compare("two spheres", two, GJK_ERROR, 1);
    assert_int_equal(colliders(1)[0].shape, HAIR_SHAPE_CAPSULE);
    compare_mesh("spheres of one radius", four);
    compare_mesh("spheres of several", others);
    others.setLocalScaling(btVector3(2, 2, 2));
    compare_mesh("scaled spheres", others);
}

static void add_ball(btTriangleMesh* mesh, btScalar radius, int rows)
{
    auto at = [&](int row, int column) {
        const btScalar polar = SIMD_PI * btScalar(row) / btScalar(rows),
                       turn = SIMD_PI * btScalar(column % (2 * rows)) / btScalar(rows);
        if (row == 0 || row == rows) return btVector3(0, row ? -radius : radius, 0);
        return btVector3(radius * btSin(polar) * btSin(turn), radius * btCos(polar),
                         radius * btSin(polar) * btCos(turn));
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < 2 * rows; ++column) {
            if (row > 0) mesh->addTriangle(at(row, column), at(row + 1, column), at(row, column + 1));
            if (row + 1 < rows)
                mesh->addTriangle(at(row, column + 1), at(row + 1, column), at(row + 1, column + 1));
        }
}

// Distance to a mesh, as the minimum over all triangles.
struct brute : btTriangleCallback {
    btVector3 point;
    btScalar margin = 0;
    double distance = INFINITY;
    void processTriangle(btVector3* t, int, int) override
    {
        btTriangleShape triangle(t[0], t[1], t[2]);
        triangle.setMargin(margin);
        distance = std::fmin(distance, gjk(&triangle, btTransform::getIdentity(), point));
    }
};

static void compare_mesh(const char* what, const btConcaveShape& shape, btScalar reach)
{
    randoms random;
    btVector3 lower, upper;
    take(shape, btTransform::getIdentity());
    const double voxel = voxel_of(colliders(1)[0]);
    shape.getAabb(btTransform::getIdentity(), lower, upper);
    double worst = 0;
    int count = 0;
    for (int i = 0; i < 1000; ++i) {
        const btVector3 p = (lower + upper) / 2 + (upper - lower) * random.vector(reach);
        brute exact;
        exact.point = p;
        exact.margin = shape.getMargin();
        shape.processAllTriangles(&exact, lower, upper);
        const double own = nearest(p);
        if (exact.distance > 3 * voxel || exact.distance < 0) continue;
        // Bullet has the opposite sign inside.
        if (own < -static_cast<double>(shape.getMargin())) continue;
        worst = std::fmax(worst, std::fabs(own - exact.distance));
        ++count;
    }
    print_message("    %s: off by up to %.3f voxels at %d points\n", what, worst / voxel, count);
    assert_true(count > 10 && worst <= 0.9 * voxel);
}

static void distances_to_meshes_equal_those_to_triangles(void**)
{
    btTriangleMesh triangles;
    add_ball(&triangles, btScalar(0.4), 12);
    btBvhTriangleMeshShape mesh(&triangles, true);
    mesh.setMargin(btScalar(0.02));
    compare_mesh("mesh", mesh, btScalar(0.6));
    assert_true(nearest(btVector3(0, 0, 0)) < -0.38);
    const hair_collision_mesh* collision_mesh = colliders(1)[0].mesh;
    btScaledBvhTriangleMeshShape twice(&mesh, btVector3(2, 2, 2)),
        uneven(&mesh, btVector3(1, 2, btScalar(0.5)));
    compare_mesh("mesh twice as large", twice, btScalar(0.6));
    assert_ptr_equal(colliders(1)[0].mesh, collision_mesh); // The mesh is shared and scaled.
    compare_mesh("mesh scaled unevenly", uneven, btScalar(0.6));
    assert_ptr_not_equal(colliders(1)[0].mesh, collision_mesh);
}

static void height_field_is_solid_below(void**)
{
    float heights[9 * 7];
    for (int i = 0; i < 63; ++i)
        heights[i] =
            0.3f * std::sin(0.9f * static_cast<float>(i % 9)) * std::cos(0.8f * static_cast<float>(i / 9));
    for (int up = 0; up < 3; ++up) {
        btHeightfieldTerrainShape field(9, 7, heights, 1, btScalar(-0.5), btScalar(0.5), up, PHY_FLOAT,
                                        false);
        field.setLocalScaling(btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.2)));
        field.setMargin(0);
        compare_mesh("height field", field, btScalar(0.45));
        btVector3 below(0, 0, 0), above(0, 0, 0);
        below[up] = btScalar(-0.1), above[up] = btScalar(0.12);
        assert_true(nearest(below) < -0.01 && nearest(above) > 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(distances_to_convex_shapes_equal_gjk),
        TEST(distances_to_multi_spheres_equal_gjk),
        TEST(distances_to_meshes_equal_those_to_triangles),
        TEST(height_field_is_solid_below),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
