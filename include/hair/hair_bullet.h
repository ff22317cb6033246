/// hair_bullet.h - colliders from Bullet's collision shapes, objects and worlds. In libhair_bullet, which is C++ inside.
///
///     hair_bullet_clear(bullet);
///     hair_bullet_add_world(bullet, world, lower, upper, -1);
///     const hair_collider* colliders = hair_bullet_colliders(bullet, &count);
///     hair_set_colliders(hair, colliders, count, sizeof *colliders);
///
/// Spheres, capsules, boxes, cylinders, cones and planes are taken exactly, with Bullet's margin as their rounding; of
/// compounds every child. Convex hulls, other convex shapes, triangle meshes and height fields become collision meshes, once for
/// each shape. A closed mesh is solid; an open one is a shell as thick as two voxels; a height field is solid below.
/// Bullet is only read. A shape that can be no collider (a soft body, a shape with NaN in it) is an error.
#ifndef HAIR_HAIR_BULLET_H
#define HAIR_HAIR_BULLET_H

#include <hair/hair_physics.h>

#ifdef __cplusplus
class btCollisionShape;
class btCollisionObject;
class btCollisionWorld;
#else
typedef struct btCollisionShape btCollisionShape;
typedef struct btCollisionObject btCollisionObject;
typedef struct btCollisionWorld btCollisionWorld;
#endif

/// A list of colliders, and the collision meshes that have been made of shapes. For one thread at a time.
typedef struct hair_bullet hair_bullet;

/// `scalar_size` is sizeof(btScalar) in the program: if it is not that of the library, which is for the Bullet of
/// single precision, the result is HAIR_ERROR_VERSION. host NULL: the C library's allocator, no log.
HAIR_API hair_result hair_bullet_create(const hair_host* host, size_t scalar_size, hair_bullet** out);
HAIR_API void hair_bullet_destroy(hair_bullet* bullet); ///< Colliders that are set stay. Takes NULL.

/// Voxels along the longest side of collision meshes that are made from now on. [8, 256]. 64 unless set.
HAIR_API hair_result hair_bullet_set_resolution(hair_bullet* bullet, uint32_t resolution);

/// Empty the list. Collision meshes of shapes that have not been met for 600 such rounds are freed.
HAIR_API hair_result hair_bullet_clear(hair_bullet* bullet);

/// Add a shape, `transform` (rigid; NULL: identity) to the world.
HAIR_API hair_result hair_bullet_add_shape(hair_bullet* bullet, const btCollisionShape* shape,
                                           const float transform[16]);

/// Add an object's shape where the object is, with its friction.
HAIR_API hair_result hair_bullet_add_object(hair_bullet* bullet, const btCollisionObject* object);

/// Add the objects whose bounds touch those given, in m: the world's broadphase finds them as of its last step, and
/// nothing else is looked at. hair_get_bounds tells the bounds of hair. `groups` has a bit for every collision filter
/// group that is taken; -1: all. Objects without contact response are left out, and so are, with a warning for each
/// once, those of shapes that can be no collider. The order is that in which objects came into the broadphase.
HAIR_API hair_result hair_bullet_add_world(hair_bullet* bullet, const btCollisionWorld* world,
                                           const float lower[3], const float upper[3], int groups);

/// The list, until it is emptied. Colliders have keys: they are paired with those of the last step wherever they stand.
HAIR_API const hair_collider* hair_bullet_colliders(const hair_bullet* bullet, uint32_t* count);

/// Forget the collision mesh of a shape whose vertices have changed, so that it is made anew. NULL: of all shapes.
HAIR_API hair_result hair_bullet_invalidate(hair_bullet* bullet, const btCollisionShape* shape);

#endif
