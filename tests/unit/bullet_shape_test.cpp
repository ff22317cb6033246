// bullet_shape_test.cpp - every shape of Bullet as colliders, compared with Bullet's own distance
// and margin.
#include "tests/support/bullet.h"

#include <BulletCollision/CollisionShapes/btTriangleShape.h>

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
        TEST(plane_is_solid_below),
        TEST(compounds_become_their_children_at_any_pose),
        TEST(flat_hulls_become_plates_capsules_or_spheres),
        TEST(malformed_shapes_are_errors),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
