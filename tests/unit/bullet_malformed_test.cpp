// bullet_malformed_test.cpp - shapes of Bullet that are wrong or far too large give an error
// message, or bounded work.
#include "tests/support/bullet.h"

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>

#include <chrono>
#include <memory>
#include <vector>

static const btScalar none = NAN, inf = INFINITY, huge = btScalar(1e30), tiny = btScalar(1e-30);

static hair_result take(const btCollisionShape& shape)
{
    assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
    const uint32_t before = test.host.errors;
    hair_result result = hair_bullet_add_shape(test.bullet, &shape, nullptr);
    assert_true(result == HAIR_OK || test.host.errors > before); // Every error logs a message.
    return result;
}

// Return whether the shape gives an error, or finite colliders.
static bool is_borne(const btCollisionShape& shape)
{
    hair_result result = take(shape);
    uint32_t count;
    const hair_collider* list = hair_bullet_colliders(test.bullet, &count);
    if (result == HAIR_ERROR_ARGUMENT) return count == 0;
    bool ok = result == HAIR_OK;
    for (uint32_t i = 0; i < count; ++i) {
        ok = ok && list[i].rounding >= 0 && list[i].rounding <= 1e6f && list[i].scale >= 1e-6f;
        for (int k = 0; k < 3; ++k)
            ok = ok && list[i].size[k] >= 0 && list[i].size[k] <= 1e6f &&
                 std::fabs(list[i].position[k]) <= 1e9f;
    }
    return ok;
}

static void refused(const btCollisionShape& shape, const char* words)
{
    if (take(shape) != HAIR_ERROR_ARGUMENT) fail_msg("not refused: %s", words);
    if (!std::strstr(test.host.sentence, words))
        fail_msg("\"%s\" does not say \"%s\"", test.host.sentence, words);
    colliders(0);
}

static std::vector<std::unique_ptr<btCollisionShape>> make_all(btScalar size)
{
    const btVector3 all(size, size, size);
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    shapes.emplace_back(new btSphereShape(size));
    shapes.emplace_back(new btBoxShape(all));
    shapes.emplace_back(new btCapsuleShape(size, size));
    shapes.emplace_back(new btCylinderShapeZ(all));
    shapes.emplace_back(new btConeShapeX(size, size));
    shapes.emplace_back(new btMultiSphereShape(&all, &size, 1));
    shapes.emplace_back(new btStaticPlaneShape(all, size));
    btConvexHullShape* hull = new btConvexHullShape;
    for (int i = 0; i < 5; ++i)
        hull->addPoint(size * btVector3(btScalar(i & 1), btScalar(i >> 1 & 1), btScalar(i >> 2)));
    shapes.emplace_back(hull);
    return shapes;
}

static void shapes_of_any_numbers_give_finite_colliders(void**)
{
    hair_bullet_set_resolution(test.bullet, 8);
    const btScalar numbers[] = {0, -1, none, inf, -inf, huge, tiny, btScalar(1e7), btScalar(0.1)};
    uint32_t taken = 0, count = 0;
    for (btScalar size : numbers)
        for (btScalar other : numbers)
            for (int what = 0; what < 3; ++what)
                for (auto& shape : make_all(size)) {
                    if (what == 1) shape->setMargin(other);
                    if (what == 2) shape->setLocalScaling(btVector3(other, btScalar(0.5), 1));
                    if (!is_borne(*shape))
                        fail_msg("%s of %g with %g (%d) is not borne", shape->getName(), double(size),
                                 double(other), what);
                    hair_bullet_colliders(test.bullet, &count);
                    taken += count;
                }
    assert_true(taken > 50); // Some shapes are valid.
    test.host.errors = 0;
}

static btTriangleMesh* tetrahedron(btScalar size)
{
    btTriangleMesh* mesh = new btTriangleMesh;
    const btVector3 a(0, 0, 0), b(size, 0, 0), c(0, size, 0), d(0, 0, size);
    mesh->addTriangle(a, c, b), mesh->addTriangle(a, b, d), mesh->addTriangle(b, c, d),
        mesh->addTriangle(a, d, c);
    return mesh;
}

static void meshes_with_nonfinite_vertices_are_errors(void**)
{
    for (btScalar wrong : {none, inf, -inf, huge}) {
        std::unique_ptr<btTriangleMesh> mesh(tetrahedron(1));
        mesh->addTriangle(btVector3(0, 0, 0), btVector3(wrong, 0, 0), btVector3(0, 1, 0));
        btBvhTriangleMeshShape shape(mesh.get(), false);
        assert_int_equal(take(shape), HAIR_ERROR_ARGUMENT);
        assert_int_equal(take(shape), HAIR_ERROR_ARGUMENT); // A second call also fails.
        colliders(0);
    }
    test.host.errors = 0;
}

static void meshes_scaled_to_nothing_are_errors(void**)
{
    std::unique_ptr<btTriangleMesh> mesh(tetrahedron(1));
    btBvhTriangleMeshShape shape(mesh.get(), true);
    const btVector3 nothing(0, 0, 0);
    btScaledBvhTriangleMeshShape scaled(&shape, nothing);
    refused(scaled, "has triangles that make no collision mesh");
    scaled.setLocalScaling(btVector3(none, 1, 1));
    assert_int_equal(take(scaled), HAIR_ERROR_ARGUMENT);
    scaled.setLocalScaling(btVector3(tiny, tiny, tiny));
    refused(scaled, "has a scale that is not in [1e-6, 1e6]");
    scaled.setLocalScaling(btVector3(1, 0, 1)); // The mesh is flat, which gives a plate.
    assert_true(is_borne(scaled));
    scaled.setLocalScaling(btVector3(-1, 1, 1));
    assert_int_equal(take(scaled), HAIR_OK);
    test.host.errors = test.host.warnings = 0;
}

// Check degenerate triangles. They do not degrade a mesh, and without others they make no mesh.
static void degenerate_triangles_are_left_out(void**)
{
    std::unique_ptr<btTriangleMesh> mesh(tetrahedron(1));
    const btVector3 a(0, 0, 0), b(1, 0, 0), c(btScalar(0.5), 0, 0);
    for (int i = 0; i < 1000; ++i) mesh->addTriangle(a, b, i % 2 ? b : a);
    btBvhTriangleMeshShape shape(mesh.get(), true);
    assert_int_equal(take(shape), HAIR_OK);
    hair_collision_mesh_info info = hair_collision_mesh_info_default();
    hair_collision_mesh_describe(colliders(1)[0].mesh, &info);
    assert_true(info.is_closed);
    assert_int_equal(info.unused, 1000);
    btTriangleMesh points;
    for (int i = 0; i < 1000; ++i) points.addTriangle(a, b, i % 2 ? b : a);
    btBvhTriangleMeshShape dots(&points, true);
    refused(dots, "has triangles that make no collision mesh");
    btTriangleMesh line; // Different corners make a thin shell.
    line.addTriangle(a, b, c);
    btBvhTriangleMeshShape thread(&line, true);
    assert_true(is_borne(thread));
    test.host.errors = test.host.warnings = 0;
}

static void nonfinite_height_fields_are_errors(void**)
{
    for (btScalar wrong : {none, inf, huge}) {
        std::vector<float> heights(16, 0.0f);
        heights[5] = wrong;
        btHeightfieldTerrainShape shape(4, 4, heights.data(), 1, 0, 1, 1, PHY_FLOAT, false);
        assert_true(is_borne(shape));
        btHeightfieldTerrainShape high(4, 4, heights.data(), 1, 0, wrong, 1, PHY_FLOAT, false);
        assert_int_equal(take(high), HAIR_ERROR_ARGUMENT);
    }
    test.host.errors = 0;
}

static void a_hull_of_millions_of_points_is_an_error(void**)
{
    std::vector<btVector3> points(1048576 + 7, btVector3(1, 2, 3));
    btConvexPointCloudShape cloud(points.data(), static_cast<int>(points.size()), btVector3(1, 1, 1));
    refused(cloud, "has 1048583 points, more than 1048576");
    std::unique_ptr<btTriangleMesh> mesh(new btTriangleMesh(true, false));
    mesh->preallocateVertices(3 * 349526);
    const btVector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    for (int i = 0; i < 349526; ++i) mesh->addTriangle(a, b, c);
    btConvexTriangleMeshShape hull(mesh.get(), false);
    refused(hull, "has 1048578 points, more than 1048576");
    test.host.errors = 0;
}

// Check the greatest number of points that the message allows, at the corners of a cube.
static void a_hull_of_the_maximum_of_points_is_a_collider(void**)
{
    std::vector<btVector3> points;
    for (int i = 0; i < 1048576; ++i)
        points.push_back(btVector3(btScalar(i & 1), btScalar(i >> 1 & 1), btScalar(i >> 2 & 1)));
    btConvexPointCloudShape cloud(points.data(), static_cast<int>(points.size()), btVector3(1, 1, 1));
    hair_bullet_set_resolution(test.bullet, 8);
    assert_int_equal(take(cloud), HAIR_OK);
    assert_int_equal(colliders(1)[0].shape, HAIR_SHAPE_MESH);
}

// Check that the floor below a height field counts before any triangle is stored. 2,875,202
// triangles have fewer vertices than the maximum, but twice as many with the floor.
static void a_height_field_of_millions_of_triangles_is_an_error_without_memory(void**)
{
    std::vector<float> heights(1200 * 1200, 0.0f);
    btHeightfieldTerrainShape field(1200, 1200, heights.data(), 1, -1, 1, 1, PHY_FLOAT, false);
    test.host.peak = test.host.live;
    refused(field, "has 2875202 triangles, more than 2796202");
    assert_true(test.host.peak < 1 << 16);
    test.host.errors = 0;
}

// A shape that reports `count` triangles without storing them.
struct many : btConcaveShape {
    explicit many(int count) : count(count) { m_shapeType = TRIANGLE_MESH_SHAPE_PROXYTYPE; }
    int count;
    mutable int rounds = 0;
    btVector3 scaling = btVector3(1, 1, 1);
    void setLocalScaling(const btVector3& scale) override { scaling = scale; }
    const btVector3& getLocalScaling() const override { return scaling; }
    void calculateLocalInertia(btScalar, btVector3&) const override {}
    const char* getName() const override { return "MANY"; }
    void getAabb(const btTransform&, btVector3& lower, btVector3& upper) const override
    {
        lower.setValue(-1, -1, -1), upper.setValue(1, 1, 1);
    }
    void processAllTriangles(btTriangleCallback* callback, const btVector3&, const btVector3&) const override
    {
        ++rounds;
        for (int i = 0; i < count; ++i) {
            const btScalar x = btScalar(2) * btScalar(i) / btScalar(count) - 1;
            btVector3 triangle[3] = {btVector3(x, 0, 0), btVector3(x, 1, 0), btVector3(x, 0, 1)};
            callback->processTriangle(triangle, 0, i);
        }
    }
};

static void mesh_without_triangles_is_an_error(void**)
{
    refused(many(0), "has triangles that make no collision mesh");
    test.host.errors = 0;
}

// Check that triangles are counted once, before any is stored.
static void mesh_of_ten_million_triangles_is_an_error_without_memory(void**)
{
    many mesh(10000000);
    const auto begun = std::chrono::steady_clock::now();
    refused(mesh, "has 10000000 triangles, more than 5592405");
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
    print_message("    %.2f s, %zu bytes\n", passed.count(), test.host.peak);
    assert_true(test.host.peak < 1 << 16);
    for (int i = 0; i < 10; ++i) refused(mesh, "has triangles that make no collision mesh");
    assert_int_equal(mesh.rounds, 1);
    test.host.errors = 0;
}

// Check that a world reports too many triangles once, and does not count them again in every frame.
static void world_skips_a_mesh_of_ten_million_triangles(void**)
{
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    btSphereShape ball(btScalar(0.1));
    many mesh(10000000);
    btCollisionObject objects[2];
    objects[0].setCollisionShape(&mesh), objects[1].setCollisionShape(&ball);
    world.addCollisionObject(&objects[0]), world.addCollisionObject(&objects[1]);
    const float lower[] = {-1, -1, -1}, upper[] = {1, 1, 1};
    for (int i = 0; i < 5; ++i) {
        assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
        assert_int_equal(hair_bullet_add_world(test.bullet, &world, lower, upper, -1), HAIR_OK);
        colliders(1);
    }
    assert_int_equal(mesh.rounds, 1);
    assert_int_equal(test.host.warnings, 1);
    world.removeCollisionObject(&objects[0]), world.removeCollisionObject(&objects[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(shapes_of_any_numbers_give_finite_colliders),
        TEST(meshes_with_nonfinite_vertices_are_errors),
        TEST(meshes_scaled_to_nothing_are_errors),
        TEST(degenerate_triangles_are_left_out),
        TEST(nonfinite_height_fields_are_errors),
        TEST(a_hull_of_millions_of_points_is_an_error),
        TEST(a_hull_of_the_maximum_of_points_is_a_collider),
        TEST(a_height_field_of_millions_of_triangles_is_an_error_without_memory),
        TEST(mesh_without_triangles_is_an_error),
        TEST(mesh_of_ten_million_triangles_is_an_error_without_memory),
        TEST(world_skips_a_mesh_of_ten_million_triangles),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
