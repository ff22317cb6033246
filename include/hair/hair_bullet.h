/// hair_bullet.h - colliders from shapes, objects and worlds of Bullet. In libhair_bullet.
///
///     hair_bullet_clear(bullet);
///     hair_bullet_add_world(bullet, world, lower, upper, -1);
///     const hair_collider* colliders = hair_bullet_colliders(bullet, &count);
///     hair_set_colliders(hair, colliders, count, sizeof *colliders);
///
/// Spheres, capsules, boxes, cylinders, cones and planes are converted exactly, with Bullet's
/// margin as hair_collider.rounding. Compounds are converted child by child. Convex hulls, other
/// convex shapes, triangle meshes and height fields become collision meshes, once per shape. A
/// closed mesh is solid. An open mesh is a shell two voxels thick. A height field is solid below
/// its surface. Soft bodies and shapes with values that are not finite cannot become colliders.
///
/// Only hair_bullet_apply() changes Bullet's objects. The library is C++ inside, and links Bullet
/// in single precision. No call in this header uses OpenGL. A hair_bullet belongs to one thread at
/// a time.
#ifndef HAIR_HAIR_BULLET_H
#define HAIR_HAIR_BULLET_H

#include <hair/hair.h>

#ifdef __cplusplus
class btCollisionShape;
class btCollisionObject;
class btCollisionWorld;
#else
typedef struct btCollisionShape btCollisionShape;
typedef struct btCollisionObject btCollisionObject;
typedef struct btCollisionWorld btCollisionWorld;
#endif

/// A list of colliders, and the collision meshes that were made from Bullet's shapes.
typedef struct hair_bullet hair_bullet;

/// Create an empty list.
///
/// @param host Callbacks. NULL selects the allocator of the C library and disables the log.
/// @param scalar_size sizeof(btScalar) in the application.
/// @param out Receives the list.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_VERSION if `scalar_size` differs from
///     that of the library.
HAIR_API hair_result hair_bullet_create(const hair_host* host, size_t scalar_size,
                                        hair_bullet** out);

/// Destroy a list. Colliders that are set on instances stay. NULL does nothing.
HAIR_API void hair_bullet_destroy(hair_bullet* bullet);

/// Set the number of voxels along the longest side of collision meshes that are made from now on.
///
/// @param resolution [8, 256]. Default 64.
/// Errors: HAIR_ERROR_ARGUMENT.
HAIR_API hair_result hair_bullet_set_resolution(hair_bullet* bullet, uint32_t resolution);

/// Empty the list. Collision meshes whose shapes have not been added for 600 of these calls are
/// freed.
/// Errors: HAIR_ERROR_ARGUMENT.
HAIR_API hair_result hair_bullet_clear(hair_bullet* bullet);

/// Add a shape.
///
/// @param shape Shape to add.
/// @param transform Rigid transform from the shape to the world, column-major. NULL is the
///     identity.
/// Errors: HAIR_ERROR_ARGUMENT, also if the shape cannot become a collider, HAIR_ERROR_MEMORY.
HAIR_API hair_result hair_bullet_add_shape(hair_bullet* bullet, const btCollisionShape* shape,
                                           const float transform[16]);

/// Add the shape of an object at the object's pose, with its friction.
/// Errors: HAIR_ERROR_ARGUMENT, also if the shape cannot become a collider, HAIR_ERROR_MEMORY.
HAIR_API hair_result hair_bullet_add_object(hair_bullet* bullet, const btCollisionObject* object);

/// Add the objects whose bounds touch a box, in the order in which they came into the broadphase.
///
/// The broadphase of the world finds the objects, as of its last step. The call looks at no other
/// object. Objects without contact response are skipped. Objects whose shapes cannot become
/// colliders are skipped with one warning each.
///
/// @param world World to search.
/// @param lower Lower corner of the box, m. See hair_get_bounds().
/// @param upper Upper corner of the box, m.
/// @param groups Bit mask of the collision filter groups to add. -1 adds all groups.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY.
HAIR_API hair_result hair_bullet_add_world(hair_bullet* bullet, const btCollisionWorld* world,
                                           const float lower[3], const float upper[3], int groups);

/// Return the colliders of the list, for hair_set_colliders(). The array is valid until the list
/// changes. The colliders have keys, so that they are matched from step to step in any order.
///
/// @param count Receives the number of colliders.
HAIR_API const hair_collider* hair_bullet_colliders(const hair_bullet* bullet, uint32_t* count);

/// Apply the impulses of hair to the rigid bodies of the list, so that hair holds and throws them.
/// A contact belongs to the collider with its key. Contacts of colliders that are not in the list,
/// of shapes, and of bodies without mass or that are kinematic do nothing. Bodies wake up. The
/// objects of the list must still exist.
///
/// @param contacts Contacts from hair_get_contacts(). May be NULL if `count` is 0.
/// @param stride sizeof(hair_collider_contact).
/// @param count Number of contacts.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY. Nothing is applied then.
HAIR_API hair_result hair_bullet_apply(hair_bullet* bullet, const hair_collider_contact* contacts,
                                       size_t stride, uint32_t count);

/// Discard the collision mesh of a shape whose vertices have changed. The next add call makes it
/// again.
///
/// @param shape Shape that has changed. NULL discards the collision meshes of all shapes.
/// Errors: HAIR_ERROR_ARGUMENT.
HAIR_API hair_result hair_bullet_invalidate(hair_bullet* bullet, const btCollisionShape* shape);

#endif
