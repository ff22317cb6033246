// bullet_shape_test.cpp - every shape of Bullet as colliders, compared with Bullet's own distance
// and margin.
#include "tests/support/bullet.h"

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btMinkowskiSumShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/CollisionShapes/btUniformScalingShape.h>

#include <vector>

static void take(const btCollisionShape& shape, const btTransform& where)
{
    float matrix[16];
    where.getOpenGLMatrix(matrix);
    assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
    assert_int_equal(hair_bullet_add_shape(test.bullet, &shape, matrix), HAIR_OK);
}

// Error of Bullet's distance to curved surfaces, in metres, measured against closed forms. Its
// iteration stops early there.
#define GJK_ERROR 8e-3

struct error {
    double worst = 0, squares = 0;
    int count = 0;
    void add(double off)
    {
        worst = std::fmax(worst, std::fabs(off));
        squares += off * off;
        ++count;
    }
};

// Compare distances at random points around the shape, outside the core, where GJK is exact. EPA
// gives the sign farther than `limit` from the surface.
static error compare(const char* what, const btConvexShape& shape, double limit, double band)
{
    randoms random;
    error error;
    for (int round = 0; round < 4; ++round) {
        const btTransform where = random.transform(1);
        btVector3 lower, upper;
        take(shape, where);
        shape.getAabb(where, lower, upper);
        const btVector3 middle = (lower + upper) / 2, half = (upper - lower) / 2;
        for (int i = 0; i < 800; ++i) {
            const btVector3 p =
                middle + (half * btScalar(1.3) + btVector3(1, 1, 1) * shape.getMargin()) * random.vector(1);
            const double exact = gjk(&shape, where, p), own = nearest(p);
            if (std::isinf(exact)) continue; // GJK gives no result here.
            if (std::fabs(exact) > 2 * limit + 1e-4 && (own < 0) != (exact < 0))
                fail_msg("%s: GJK says %g at point %d, the colliders %g", what, exact, i, own);
            if (exact > -0.9 * static_cast<double>(shape.getMargin()) && exact < band)
                error.add(std::fmax(std::fabs(own - exact) - 0.01 * std::fabs(exact), 0));
        }
    }
    if (error.count < 60) fail_msg("%s: only %d points were compared", what, error.count);
    if (!(error.worst <= limit)) fail_msg("%s: off by up to %g m, more than %g", what, error.worst, limit);
    return error;
}

static void distances_to_primitives_equal_gjk(void**)
{
    btSphereShape sphere(btScalar(0.3));
    btBoxShape box(btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.4)));
    btCapsuleShape capsule_y(btScalar(0.1), btScalar(0.5));
    btCapsuleShapeX capsule_x(btScalar(0.1), btScalar(0.5));
    btCapsuleShapeZ capsule_z(btScalar(0.1), btScalar(0.5));
    btCylinderShape cylinder_y(btVector3(btScalar(0.2), btScalar(0.4), btScalar(0.2)));
    btCylinderShapeX cylinder_x(btVector3(btScalar(0.4), btScalar(0.2), btScalar(0.2)));
    btCylinderShapeZ cylinder_z(btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.4)));
    btConeShape cone_y(btScalar(0.2), btScalar(0.5));
    btConeShapeX cone_x(btScalar(0.2), btScalar(0.5));
    btConeShapeZ cone_z(btScalar(0.2), btScalar(0.5));
    btConvexInternalShape* shapes[] = {&sphere,    &box,        &capsule_y,  &capsule_x,
                                       &capsule_z, &cylinder_y, &cylinder_x, &cylinder_z,
                                       &cone_y,    &cone_x,     &cone_z};
    const btScalar margins[] = {btScalar(0.04), btScalar(0.01)}, scales[] = {1, btScalar(0.7)};
    double worst = 0;
    for (btConvexInternalShape* shape : shapes)
        for (btScalar margin : margins)
            for (btScalar scale : scales) {
                const bool is_round = shape->getShapeType() == SPHERE_SHAPE_PROXYTYPE ||
                                      shape->getShapeType() == CAPSULE_SHAPE_PROXYTYPE;
                shape->setLocalScaling(btVector3(scale, scale, scale));
                // The margin of a round shape is its radius.
                if (!is_round) shape->setMargin(margin);
                worst = std::fmax(worst, compare(shape->getName(), *shape, GJK_ERROR, 1).worst);
                colliders(1);
            }
    print_message("    off by up to %.2g m\n", worst);
}

static void boxes_and_cylinders_may_be_scaled_unevenly(void**)
{
    btBoxShape box(btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.4)));
    btCylinderShape cylinder(btVector3(btScalar(0.2), btScalar(0.4), btScalar(0.2)));
    box.setLocalScaling(btVector3(2, 1, btScalar(0.5)));
    cylinder.setLocalScaling(btVector3(2, btScalar(0.5), 2));
    compare("box", box, GJK_ERROR, 1);
    compare("cylinder", cylinder, GJK_ERROR, 1);
}

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

static void plane_is_solid_below(void**)
{
    randoms random;
    for (int i = 0; i < 20; ++i) {
        const btVector3 normal = (random.vector(1) + btVector3(0, btScalar(0.01), 0)).normalized();
        btStaticPlaneShape plane(normal, random.next(-1, 1));
        const btTransform where = random.transform(1);
        take(plane, where);
        for (int k = 0; k < 20; ++k) {
            const btVector3 p = random.vector(2);
            const double exact = normal.dot(where.inverse() * p) - plane.getPlaneConstant();
            if (std::fabs(nearest(p) - exact) > 2e-6) fail_msg("%g is not %g", nearest(p), exact);
        }
    }
    btStaticPlaneShape down(btVector3(0, -1, 0), 0);
    take(down, btTransform::getIdentity());
    assert_true(nearest(btVector3(0, 1, 0)) == -1);
}

static void compounds_become_their_children_at_any_pose(void**)
{
    randoms random;
    btBoxShape box(btVector3(btScalar(0.1), btScalar(0.2), btScalar(0.1)));
    btSphereShape sphere(btScalar(0.1));
    btCapsuleShapeX capsule(btScalar(0.05), btScalar(0.3));
    btCompoundShape inner, outer;
    const btTransform a = random.transform(btScalar(0.3)), b = random.transform(btScalar(0.3)),
                      c = random.transform(btScalar(0.3)), d = random.transform(btScalar(0.3)),
                      where = random.transform(1);
    inner.addChildShape(a, &box);
    inner.addChildShape(b, &sphere);
    outer.addChildShape(c, &inner);
    outer.addChildShape(d, &capsule);
    outer.setLocalScaling(btVector3(btScalar(1.5), btScalar(1.5), btScalar(1.5)));
    take(outer, where);
    const hair_collider* list = colliders(3);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < i; ++k) assert_true(list[i].key != list[k].key && list[i].key && list[k].key);
    auto grown = [](const btTransform& t) {
        return btTransform(t.getBasis(), t.getOrigin() * btScalar(1.5));
    };
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        const btVector3 p = where * random.vector(1);
        const double exact = std::fmin(
            gjk(&box, where * grown(c) * grown(a), p),
            std::fmin(gjk(&sphere, where * grown(c) * grown(b), p), gjk(&capsule, where * grown(d), p)));
        if (exact > 0) worst = std::fmax(worst, std::fabs(nearest(p) - exact));
    }
    print_message("    off by up to %.2g m\n", worst);
    assert_true(worst < 3e-4);
    btEmptyShape nothing;
    btCompoundShape hollow;
    take(nothing, where);
    colliders(0);
    take(hollow, where);
    colliders(0);
}

// Check hulls of points in a plane, on a line, and at one position.
static void flat_hulls_become_plates_capsules_or_spheres(void**)
{
    const btScalar flat[][3] = {
        {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {btScalar(0.5), btScalar(0.5), 0}};
    const btScalar line[][3] = {
        {0, 0, 0}, {1, 1, 1}, {btScalar(0.5), btScalar(0.5), btScalar(0.5)}, {2, 2, 2}};
    btConvexHullShape plate, rod(&line[0][0], 4, 3 * sizeof(btScalar)),
        dot(&flat[2][0], 1, 3 * sizeof(btScalar));
    for (const btScalar* p : flat) plate.addPoint(btVector3(p[0], p[1], p[2]));
    btTriangleShape triangle(btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0));
    compare("plate", plate, 0.9 / 64, 0.1);
    compare("triangle", triangle, 0.9 / 64, 0.1);
    compare("rod", rod, GJK_ERROR, 1);
    assert_int_equal(colliders(1)[0].shape, HAIR_SHAPE_CAPSULE);
    compare("dot", dot, GJK_ERROR, 1);
    assert_int_equal(colliders(1)[0].shape, HAIR_SHAPE_SPHERE);
}

static void refused(const btCollisionShape& shape, const char* words)
{
    test.host.errors = 0;
    assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
    if (hair_bullet_add_shape(test.bullet, &shape, nullptr) != HAIR_ERROR_ARGUMENT)
        fail_msg("not refused: %s", words);
    assert_true(test.host.errors >= 1);
    if (!std::strstr(test.host.sentence, words))
        fail_msg("\"%s\" does not say \"%s\"", test.host.sentence, words);
    colliders(0);
    test.host.errors = 0;
}

struct soft : btSphereShape {
    soft() : btSphereShape(1) { m_shapeType = SOFTBODY_SHAPE_PROXYTYPE; }
};

static void malformed_shapes_are_errors(void**)
{
    const btScalar nan = NAN, inf = INFINITY;
    btConvexHullShape empty, far, wrong;
    refused(empty, "Convex of type 4 has no points");
    wrong.addPoint(btVector3(0, 0, 0), false), wrong.addPoint(btVector3(nan, 1, 0), false),
        wrong.addPoint(btVector3(1, 1, inf), false), wrong.addPoint(btVector3(1, 0, 1), false);
    refused(wrong, "has a point that is not within 1e6 m");
    far.addPoint(btVector3(0, 0, 0)), far.addPoint(btVector3(btScalar(1e8), 1, 0)),
        far.addPoint(btVector3(1, 0, 0)), far.addPoint(btVector3(0, 0, 1));
    refused(far, "has a point that is not within 1e6 m");
    btConvexHullShape collapsed;
    collapsed.addPoint(btVector3(0, 0, 0)), collapsed.addPoint(btVector3(1, 0, 0)),
        collapsed.addPoint(btVector3(0, 1, 0)), collapsed.addPoint(btVector3(0, 0, 1));
    collapsed.setLocalScaling(btVector3(0, 0, 0));
    collapsed.setMargin(0);
    refused(collapsed, "has no size");
    btSphereShape nothing(0), nowhere(nan);
    refused(nothing, "SPHERE of type 8 has no size");
    refused(nowhere, "has a size that is not in [0, 1e6] m");
    btStaticPlaneShape plane(btVector3(0, 1, 0), nan);
    refused(plane, "has no place that is finite");
    soft body;
    refused(body, "cannot be a collider");
    btTriangleMesh triangles;
    triangles.addTriangle(btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(2, 0, 0));
    triangles.addTriangle(btVector3(0, 0, 0), btVector3(0, 0, 0), btVector3(0, 0, 0));
    btBvhTriangleMeshShape dots(&triangles, true);
    dots.setLocalScaling(btVector3(btScalar(1e-9), btScalar(1e-9), btScalar(1e-9)));
    refused(dots, "has triangles that make no collision mesh");
    btCompoundShape self(false);
    self.addChildShape(btTransform::getIdentity(), &nothing);
    self.removeChildShapeByIndex(0);
    btSphereShape ball(1);
    self.addChildShape(btTransform::getIdentity(), &ball);
    btCompoundShapeChild& child = self.getChildList()[0];
    child.m_childShape = &self;
    refused(self, "is nested deeper than 16");
    child.m_childShape = &ball;
    float matrix[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    assert_int_equal(hair_bullet_add_shape(test.bullet, &ball, matrix), HAIR_ERROR_ARGUMENT);
    matrix[0] = NAN;
    assert_int_equal(hair_bullet_add_shape(test.bullet, &ball, matrix), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_shape(test.bullet, nullptr, nullptr), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_shape(nullptr, &ball, nullptr), HAIR_ERROR_ARGUMENT);
    test.host.errors = 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(distances_to_primitives_equal_gjk),
        TEST(boxes_and_cylinders_may_be_scaled_unevenly),
        TEST(distances_to_convex_shapes_equal_gjk),
        TEST(distances_to_multi_spheres_equal_gjk),
        TEST(distances_to_meshes_equal_those_to_triangles),
        TEST(height_field_is_solid_below),
        TEST(plane_is_solid_below),
        TEST(compounds_become_their_children_at_any_pose),
        TEST(flat_hulls_become_plates_capsules_or_spheres),
        TEST(malformed_shapes_are_errors),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
