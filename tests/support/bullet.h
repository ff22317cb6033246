// bullet.h - helpers of C++ tests of libhair_bullet: cmocka, a counting host, and Bullet's own
// distance to a shape.
#ifndef HAIR_TESTS_SUPPORT_BULLET_H
#define HAIR_TESTS_SUPPORT_BULLET_H

#include <btBulletCollisionCommon.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <hair/hair_bullet.h>

#include <cmath>
#include <cstring>

extern "C" {
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "tests/support/host.h"

double hair_distance_to_collider(const hair_collider* collider, const double point[3], double gradient[3]);
}

// State of each test: a host and a converter.
struct bullet_test {
    hair_test_host host;
    hair_bullet* bullet;
};
static bullet_test test;

static int start(void**)
{
    hair_test_host_init(&test.host);
    return hair_bullet_create(&test.host.host, sizeof(btScalar), &test.bullet);
}

static int stop(void**)
{
    hair_bullet_destroy(test.bullet);
    if (test.host.blocks) print_message("%u blocks of memory were not freed\n", test.host.blocks);
    if (test.host.errors) print_message("%s\n", test.host.sentence);
    return test.host.blocks || test.host.errors;
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, start, stop)

// Return the list of colliders, which must have the given length.
static inline const hair_collider* colliders(uint32_t expected)
{
    uint32_t count;
    const hair_collider* list = hair_bullet_colliders(test.bullet, &count);
    assert_int_equal(count, expected);
    return list;
}

static inline double nearest(const btVector3& p)
{
    uint32_t count;
    const hair_collider* list = hair_bullet_colliders(test.bullet, &count);
    double distance = INFINITY;
    const double at[3] = {p.x(), p.y(), p.z()};
    for (uint32_t i = 0; i < count; ++i)
        distance = std::fmin(distance, hair_distance_to_collider(&list[i], at, nullptr));
    return distance;
}

// Return the distance from a point to a convex shape with its margin, by GJK. Inside the core EPA
// is used, which is less exact.
static inline double gjk(const btConvexShape* shape, const btTransform& where, const btVector3& p)
{
    btSphereShape point(0);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector(shape, &point, &simplex, &depth);
    btGjkPairDetector::ClosestPointInput input;
    btPointCollector result;
    input.m_transformA = where;
    input.m_transformB = btTransform(btQuaternion::getIdentity(), p);
    detector.getClosestPoints(input, result, nullptr);
    return result.m_hasResult ? result.m_distance : INFINITY;
}

struct randoms {
    uint32_t seed = 1;
    btScalar next(btScalar min, btScalar max)
    {
        seed = seed * 1664525u + 1013904223u;
        return min + (max - min) * btScalar(seed >> 8) / btScalar(16777216);
    }
    btVector3 vector(btScalar reach)
    {
        const btScalar x = next(-reach, reach), y = next(-reach, reach);
        return btVector3(x, y, next(-reach, reach));
    }
    btTransform transform(btScalar reach)
    {
        btQuaternion q(next(-1, 1), next(-1, 1), next(-1, 1), next(-1, 1) + btScalar(0.01));
        return btTransform(q.normalized(), vector(reach));
    }
};

// Replace the colliders by those of a shape.
static inline void take(const btCollisionShape& shape, const btTransform& where)
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
static inline error compare(const char* what, const btConvexShape& shape, double limit, double band)
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

#endif
