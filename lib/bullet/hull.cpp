// hull.cpp - other convex shapes: the hull of their points as a collision mesh, and their margin as
// its rounding.
#include "lib/bullet/bullet.h"

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <cmath>
#include <cstdio>

#define MAX_POINTS 1048576u // Maximum number of points of a shape.
// Number of directions over a sphere. A hull of points that far apart sags by 0.4 % of the radius.
#define DIRECTIONS 1024

namespace
{
// Points of a hull, and the rounding to be added all around.
struct cloud {
    hair_mesh mesh;
    float rounding;
    uint64_t count; // Points of the shape. At most MAX_POINTS of them are in `mesh`.

    void add(const btVector3& at)
    {
        if (++count <= MAX_POINTS) mesh.add_vertex(at);
    }
};

// Return the i-th of DIRECTIONS directions along Fibonacci's spiral.
btVector3 direction(int i)
{
    HAIR_ASSERT(0 <= i && i < DIRECTIONS);
    const double z = 1 - (2 * i + 1.0) / DIRECTIONS, around = std::sqrt(1 - z * z),
                 turn = 2.399963229728653 * i;
    return btVector3(btScalar(around * std::cos(turn)), btScalar(around * std::sin(turn)), btScalar(z));
}

struct mesh_points : btInternalTriangleIndexCallback {
    cloud* out = nullptr;

    void internalProcessTriangleIndex(btVector3* triangle, int, int) override
    {
        for (int k = 0; k < 3; ++k) out->add(triangle[k]);
    }
};
} // namespace

// Add the points of spheres. Spheres of equal radius are their centres with a rounding. Otherwise
// the minimum radius is the rounding, and the rest of each sphere is points on it. Bullet scales
// spheres if the scale is not uniform, so the points are scaled too.
static void add_spheres(const btMultiSphereShape* shape, cloud* out)
{
    const btVector3& s = shape->getLocalScaling();
    bool uniform = s.x() == s.y() && s.y() == s.z() && s.x() > 0;
    btScalar min_value = shape->getSphereCount() ? BT_LARGE_FLOAT : 0, max_value = 0;
    for (int i = 0; i < shape->getSphereCount(); ++i) {
        min_value = btMin(min_value, shape->getSphereRadius(i));
        max_value = btMax(max_value, shape->getSphereRadius(i));
    }
    if (!uniform) min_value = 0;
    out->rounding = static_cast<float>(uniform ? min_value * s.x() : btScalar(0));
    for (int i = 0; i < shape->getSphereCount(); ++i) {
        const btScalar radius = shape->getSphereRadius(i) - min_value;
        if (radius <= 0)
            out->add(shape->getSpherePosition(i) * s);
        else
            for (int k = 0; k < DIRECTIONS; ++k)
                out->add((shape->getSpherePosition(i) + radius * direction(k)) * s);
    }
}

static void gather(const btConvexShape* shape, cloud* out)
{
    out->rounding = static_cast<float>(shape->getMargin());
    switch (shape->getShapeType()) {
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
        const btConvexHullShape* hull = static_cast<const btConvexHullShape*>(shape);
        for (int i = 0; i < hull->getNumPoints(); ++i) out->add(hull->getScaledPoint(i));
        return;
    }
    case CONVEX_POINT_CLOUD_SHAPE_PROXYTYPE: {
        const btConvexPointCloudShape* points = static_cast<const btConvexPointCloudShape*>(shape);
        for (int i = 0; i < points->getNumPoints(); ++i) out->add(points->getScaledPoint(i));
        return;
    }
    case CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE: {
        mesh_points points;
        points.out = out;
        const btVector3 everywhere(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
        static_cast<const btConvexTriangleMeshShape*>(shape)->getMeshInterface()->InternalProcessAllTriangles(
            &points, -everywhere, everywhere);
        return;
    }
    case MULTI_SPHERE_SHAPE_PROXYTYPE:
        add_spheres(static_cast<const btMultiSphereShape*>(shape), out);
        return;
    default:
        if (shape->isPolyhedral()) {
            const btPolyhedralConvexShape* polyhedron = static_cast<const btPolyhedralConvexShape*>(shape);
            for (int i = 0; i < polyhedron->getNumVertices(); ++i) {
                btVector3 at;
                polyhedron->getVertex(i, at);
                out->add(at);
            }
            return;
        }
        // Take the farthest point of any other shape in every direction.
        for (int k = 0; k < DIRECTIONS; ++k)
            out->add(shape->localGetSupportingVertexWithoutMargin(direction(k)));
    }
}

static btVector3 vertex(const hair_mesh& mesh, uint32_t i)
{
    HAIR_ASSERT(i < mesh.vertex_count);
    const float* at = mesh.positions + 3 * i;
    return btVector3(at[0], at[1], at[2]);
}

// Make a sphere or a capsule of points that coincide or are on one line. Return false for other
// points.
static bool as_capsule(const hair_mesh& points, hair_collider* collider, btQuaternion* turn)
{
    uint32_t a = 0, b = 0;
    for (int round = 0; round < 3;
         ++round) { // From any point to the farthest one, to the farthest from there, and back.
        uint32_t from = round % 2 ? b : a, far = from;
        for (uint32_t i = 0; i < points.vertex_count; ++i)
            if (vertex(points, i).distance2(vertex(points, from)) >
                vertex(points, far).distance2(vertex(points, from)))
                far = i;
        (round % 2 ? a : b) = far;
    }
    const btVector3 start = vertex(points, a), axis = vertex(points, b) - start;
    const btScalar length = axis.length(), close = btScalar(1e-6) * length;
    for (uint32_t i = 0; i < points.vertex_count && length > 0; ++i)
        if ((vertex(points, i) - start).cross(axis / length).length() > close) return false;
    const btVector3 middle = start + axis / 2;
    for (int k = 0; k < 3; ++k) collider->position[k] = static_cast<float>(middle[k]);
    collider->shape = length > 0 ? HAIR_SHAPE_CAPSULE : HAIR_SHAPE_SPHERE;
    collider->size[0] = 0;
    collider->size[1] = static_cast<float>(length / 2);
    *turn = length > 0 ? shortestArcQuat(btVector3(0, 1, 0), axis / length) : btQuaternion::getIdentity();
    return true;
}

static void close_hull(const hair_mesh& points, hair_mesh* out)
{
    btConvexHullComputer hull;
    hull.compute(points.positions, 3 * static_cast<int>(sizeof(float)), static_cast<int>(points.vertex_count),
                 0, 0);
    for (int i = 0; i < hull.vertices.size(); ++i) out->add_vertex(hull.vertices[i]);
    for (int i = 0; i < hull.faces.size(); ++i) {
        const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[i]];
        const uint32_t apex = static_cast<uint32_t>(first->getSourceVertex());
        for (const btConvexHullComputer::Edge* edge = first->getNextEdgeOfFace();
             edge->getTargetVertex() != first->getSourceVertex(); edge = edge->getNextEdgeOfFace())
            out->add_triangle(apex, static_cast<uint32_t>(edge->getSourceVertex()),
                              static_cast<uint32_t>(edge->getTargetVertex()));
    }
}

// Return a hash of the points, by which a hull is made only once.
static uint64_t fingerprint_of(const cloud& points)
{
    uint64_t fingerprint = hair_bullet_fingerprint(0xcbf29ce484222325u, points.mesh.positions,
                                                   3 * sizeof(float) * points.mesh.vertex_count);
    fingerprint = hair_bullet_fingerprint(fingerprint, &points.rounding, sizeof points.rounding);
    return fingerprint > 1 ? fingerprint : 2;
}

static hair_result add_points(hair_bullet* bullet, const btConvexShape* shape, const hair_gather& context,
                              const cloud& points)
{
    if (!points.mesh.vertex_count) return hair_bullet_wrong(bullet, shape, context, "has no points");
    if (points.count > MAX_POINTS) {
        char what[64];
        std::snprintf(what, sizeof what, "has %llu points, more than %u",
                      static_cast<unsigned long long>(points.count), MAX_POINTS);
        return hair_bullet_wrong(bullet, shape, context, what);
    }
    for (uint32_t i = 0; i < 3 * points.mesh.vertex_count; ++i)
        if (!(std::fabs(points.mesh.positions[i]) <= 1e6f))
            return hair_bullet_wrong(bullet, shape, context, "has a point that is not within 1e6 m");
    hair_collider collider = hair_collider_default();
    btQuaternion turn;
    if (as_capsule(points.mesh, &collider, &turn)) {
        collider.size[0] = points.rounding; // All of the rounding is the radius.
        return hair_bullet_add_collider(bullet, shape, context, collider, turn);
    }
    const uint64_t fingerprint = fingerprint_of(points);
    const hair_cached_shape* cached = hair_bullet_find(bullet, shape, fingerprint);
    const hair_collision_mesh* collision_mesh = cached ? cached->mesh : nullptr;
    if (!cached) {
        hair_mesh hull = {};
        hull.host = &bullet->host;
        close_hull(points.mesh, &hull);
        hair_result result = hull.result ? hull.result
                                         : hair_bullet_make_collision_mesh(bullet, shape, fingerprint, hull,
                                                                           points.rounding, &collision_mesh);
        hull.release();
        if (result) return result;
    }
    return hair_bullet_add_collision_mesh(bullet, shape, context, collision_mesh, points.rounding, 1);
}

hair_result hair_bullet_add_hull(hair_bullet* bullet, const btConvexShape* shape, const hair_gather& context)
{
    cloud points = {};
    points.mesh.host = &bullet->host;
    gather(shape, &points);
    hair_result result = points.mesh.result ? points.mesh.result : add_points(bullet, shape, context, points);
    points.mesh.release();
    return result;
}
