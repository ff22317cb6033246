// shape.cpp - Bullet's shapes as colliders: exact ones here, the others by hull.cpp and mesh.cpp.
#include "lib/bullet/bullet.h"

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>

#include <cmath>

// Maximum depth of compounds in compounds. A compound that contains itself would never end.
#define DEEPEST 16
#define MAX_VALUE 1048576u // Maximum number of shapes of an object.

hair_result hair_bullet_wrong(hair_bullet* bullet, const btCollisionShape* shape, const hair_gather& context,
                              const char* what)
{
    if (!context.log_once)
        return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "Bullet's shape %s of type %d %s",
                         shape->getName(), shape->getShapeType(), what);
    const uint64_t wrong = 1; // In place of a hash.
    if (hair_bullet_find(bullet, shape, wrong)) return HAIR_ERROR_ARGUMENT;
    HAIR_TRY(hair_bullet_keep(bullet, shape, wrong, nullptr));
    hair_log(&bullet->host, HAIR_LOG_WARNING, "Bullet's shape %s of type %d %s: hair goes through it",
             shape->getName(), shape->getShapeType(), what);
    return HAIR_ERROR_ARGUMENT;
}

static bool is_finite(const btVector3& v)
{
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

// Add a collider to the list. `turn` is its rotation within the shape.
hair_result hair_bullet_add_collider(hair_bullet* bullet, const btCollisionShape* shape,
                                     const hair_gather& context, hair_collider collider,
                                     const btQuaternion& turn)
{
    const btVector3 at =
        context.transform * btVector3(collider.position[0], collider.position[1], collider.position[2]);
    btQuaternion q = context.transform.getRotation() * turn;
    if (!is_finite(at) || !std::isfinite(q.length2()) || !(q.length2() > btScalar(0.5)))
        return hair_bullet_wrong(bullet, shape, context, "has no place that is finite");
    q.normalize();
    for (int k = 0; k < 3; ++k) {
        collider.position[k] = at[k];
        if (!(std::fabs(at[k]) <= 1e9f))
            return hair_bullet_wrong(bullet, shape, context, "is farther than 1e9 m");
        if (!(collider.size[k] >= 0 && collider.size[k] <= 1e6f))
            return hair_bullet_wrong(bullet, shape, context, "has a size that is not in [0, 1e6] m");
    }
    if (!(collider.rounding >= 0 && collider.rounding <= 1e6f))
        return hair_bullet_wrong(bullet, shape, context, "has a margin that is not in [0, 1e6] m");
    if (!(collider.scale >= 1e-6f && collider.scale <= 1e6f))
        return hair_bullet_wrong(bullet, shape, context, "has a scale that is not in [1e-6, 1e6]");
    const int sizes = collider.shape == HAIR_SHAPE_BOX       ? 3
                      : collider.shape <= HAIR_SHAPE_CAPSULE ? 1
                      : collider.shape < HAIR_SHAPE_PLANE    ? 2
                                                             : 0;
    for (int k = 0; k < sizes; ++k)
        if (collider.size[k] == 0 && collider.rounding == 0)
            return hair_bullet_wrong(bullet, shape, context, "has no size");
    collider.rotation[0] = q.x(), collider.rotation[1] = q.y(), collider.rotation[2] = q.z(),
    collider.rotation[3] = q.w();
    collider.friction = context.friction;
    uint64_t key = hair_bullet_fingerprint(context.key, &collider.shape, sizeof collider.shape);
    collider.key = key ? key : 1;

    void* colliders = bullet->colliders;
    hair_result result =
        hair_bullet_reserve(&bullet->host, &colliders, &bullet->capacity, bullet->count + 1, sizeof collider);
    bullet->colliders = static_cast<hair_collider*>(colliders);
    HAIR_TRY(result);
    void* objects = bullet->objects;
    result = hair_bullet_reserve(&bullet->host, &objects, &bullet->object_capacity, bullet->count + 1,
                                 sizeof *bullet->objects);
    bullet->objects = static_cast<const btCollisionObject**>(objects);
    HAIR_TRY(result);
    HAIR_ASSERT(bullet->count < bullet->capacity && bullet->count < bullet->object_capacity);
    bullet->objects[bullet->count] = context.object;
    bullet->colliders[bullet->count++] = collider;
    return HAIR_OK;
}

// Return a rotation that takes +y to an axis. Any rotation about that axis is equivalent for shapes
// of revolution.
static btQuaternion turn_to(int axis)
{
    const btScalar half = btScalar(0.70710678118654752);
    return axis == 0   ? btQuaternion(0, 0, -half, half)
           : axis == 2 ? btQuaternion(half, 0, 0, half)
                       : btQuaternion(0, 0, 0, 1);
}

// Return a size. setMargin() may have made it negative, if the margin is larger than the whole
// shape.
static float size_of(btScalar without_margin)
{
    return without_margin < 0 ? 0.0f : static_cast<float>(without_margin);
}

static hair_result add_box(hair_bullet* bullet, const btBoxShape* box, const hair_gather& context)
{
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_BOX;
    for (int k = 0; k < 3; ++k) collider.size[k] = size_of(box->getHalfExtentsWithoutMargin()[k]);
    collider.rounding = box->getMargin();
    return hair_bullet_add_collider(bullet, box, context, collider, btQuaternion::getIdentity());
}

static hair_result add_capsule(hair_bullet* bullet, const btCapsuleShape* capsule, const hair_gather& context)
{
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_CAPSULE;
    collider.size[0] = capsule->getRadius();
    collider.size[1] = capsule->getHalfHeight();
    return hair_bullet_add_collider(bullet, capsule, context, collider, turn_to(capsule->getUpAxis()));
}

// Add a cylinder. Bullet takes the radius along one axis, even if the other radius is larger.
static hair_result add_cylinder(hair_bullet* bullet, const btCylinderShape* cylinder,
                                const hair_gather& context)
{
    const btVector3& half = cylinder->getHalfExtentsWithoutMargin();
    const int up = cylinder->getUpAxis();
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_CYLINDER;
    collider.size[0] = size_of(half[up == 0 ? 1 : 0]);
    collider.size[1] = size_of(half[up]);
    collider.rounding = cylinder->getMargin();
    return hair_bullet_add_collider(bullet, cylinder, context, collider, turn_to(up));
}

// Add a cone. Bullet adds the margin to a cone, but subtracts the margin from other shapes
// beforehand.
static hair_result add_cone(hair_bullet* bullet, const btConeShape* cone, const hair_gather& context)
{
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_CONE;
    collider.size[0] = cone->getRadius();
    collider.size[1] = cone->getHeight() / 2;
    collider.rounding = cone->getMargin();
    return hair_bullet_add_collider(bullet, cone, context, collider, turn_to(cone->getConeUpIndex()));
}

static hair_result add_sphere(hair_bullet* bullet, const btSphereShape* sphere, const hair_gather& context)
{
    hair_collider collider = hair_collider_default();
    collider.size[0] = sphere->getRadius();
    return hair_bullet_add_collider(bullet, sphere, context, collider, btQuaternion::getIdentity());
}

static hair_result add_plane(hair_bullet* bullet, const btStaticPlaneShape* plane, const hair_gather& context)
{
    const btVector3& normal = plane->getPlaneNormal();
    if (!(std::fabs(normal.length2() - 1) < btScalar(1e-3)))
        return hair_bullet_wrong(bullet, plane, context, "has a normal that is not of length 1");
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_PLANE;
    for (int k = 0; k < 3; ++k) collider.position[k] = normal[k] * plane->getPlaneConstant();
    return hair_bullet_add_collider(bullet, plane, context, collider,
                                    shortestArcQuat(btVector3(0, 1, 0), normal.normalized()));
}

// Add a compound. Its scale is already part of the children and their transforms.
static hair_result add_compound(hair_bullet* bullet, const btCompoundShape* compound,
                                const hair_gather& context)
{
    if (context.depth == DEEPEST)
        return hair_bullet_wrong(bullet, compound, context, "is nested deeper than 16");
    hair_result worst = HAIR_OK;
    for (int i = 0; i < compound->getNumChildShapes(); ++i) {
        if (++bullet->visits > MAX_VALUE)
            return hair_bullet_wrong(bullet, compound, context, "has more than 1048576 children");
        hair_gather child = context;
        child.transform = context.transform * compound->getChildTransform(i);
        child.key = hair_bullet_fingerprint(context.key, &i, sizeof i);
        ++child.depth;
        hair_result result = hair_bullet_add(bullet, compound->getChildShape(i), child);
        if (result && (!context.log_once || result != HAIR_ERROR_ARGUMENT)) return result;
        if (result) worst = result;
    }
    return worst;
}

hair_result hair_bullet_add(hair_bullet* bullet, const btCollisionShape* shape, const hair_gather& context)
{
    HAIR_ASSERT(context.depth <= DEEPEST);
    switch (shape->getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE: return add_sphere(bullet, static_cast<const btSphereShape*>(shape), context);
    case BOX_SHAPE_PROXYTYPE: return add_box(bullet, static_cast<const btBoxShape*>(shape), context);
    case CAPSULE_SHAPE_PROXYTYPE:
        return add_capsule(bullet, static_cast<const btCapsuleShape*>(shape), context);
    case CYLINDER_SHAPE_PROXYTYPE:
        return add_cylinder(bullet, static_cast<const btCylinderShape*>(shape), context);
    case CONE_SHAPE_PROXYTYPE: return add_cone(bullet, static_cast<const btConeShape*>(shape), context);
    case STATIC_PLANE_PROXYTYPE:
        return add_plane(bullet, static_cast<const btStaticPlaneShape*>(shape), context);
    case COMPOUND_SHAPE_PROXYTYPE:
        return add_compound(bullet, static_cast<const btCompoundShape*>(shape), context);
    case EMPTY_SHAPE_PROXYTYPE: return HAIR_OK;
    case SDF_SHAPE_PROXYTYPE: break;
    default:
        if (shape->isConvex())
            return hair_bullet_add_hull(bullet, static_cast<const btConvexShape*>(shape), context);
        if (shape->isConcave())
            return hair_bullet_add_mesh(bullet, static_cast<const btConcaveShape*>(shape), context);
    }
    return hair_bullet_wrong(bullet, shape, context, "cannot be a collider");
}
