// bullet.h - shared parts of libhair_bullet: a list of colliders, and the collision meshes of
// shapes already met.
#ifndef HAIR_BULLET_BULLET_H
#define HAIR_BULLET_BULLET_H

#include <btBulletCollisionCommon.h>
#include <hair/hair_bullet.h>

extern "C" {
#include "lib/base/host.h"
}

// A shape that has been met, with its collision mesh.
struct hair_cached_shape {
    const btCollisionShape* shape;
    // hash of its numbers. Another hash means another shape at the same address.
    uint64_t fingerprint;
    hair_collision_mesh* mesh; // NULL if the shape can have none, which the log has said.
    uint32_t round; // number of the hair_bullet_clear() round in which the shape was last met
};

struct hair_bullet {
    hair_host host;
    uint32_t resolution;
    uint32_t round;
    uint32_t visits; // number of shapes visited while one object is taken
    hair_collider* colliders;
    uint32_t count, capacity;
    const btCollisionObject** objects; // object of each collider. NULL for colliders of shapes.
    uint32_t object_capacity;
    hair_cached_shape* cached; // hash table. Empty slots have no shape.
    uint32_t cached_count, cached_capacity;
    const void** hits; // proxies that the broadphase has found
    uint32_t hit_count, hit_capacity;
};

// Make room for `count` elements of `size` bytes in the array at `array`. The array grows by more
// than that.
hair_result hair_bullet_reserve(const hair_host* host, void** array, uint32_t* capacity, uint32_t count,
                                size_t size);

// A growing triangle mesh.
struct hair_mesh {
    const hair_host* host;
    hair_result result; // first failure. Nothing is added after it.
    float* positions;
    uint32_t* triangles;
    uint32_t vertex_count, triangle_count;
    uint32_t position_room, triangle_room;

    void add_vertex(const btVector3& at);
    void add_triangle(uint32_t a, uint32_t b, uint32_t c);
    void release();
};

// An object or shape being taken: its pose, and the common properties of its colliders.
struct hair_gather {
    btTransform transform;
    float friction;
    uint64_t key; // key of the object, from which each of its colliders derives its own
    uint32_t depth;
    bool log_once; // Shapes that can be no collider cause one warning instead of an error.
    const btCollisionObject* object; // NULL for a shape alone
};

// Functions of shape.cpp.
hair_result hair_bullet_add(hair_bullet* bullet, const btCollisionShape* shape, const hair_gather& context);
hair_result hair_bullet_add_collider(hair_bullet* bullet, const btCollisionShape* shape,
                                     const hair_gather& context, hair_collider collider,
                                     const btQuaternion& turn);

// Functions of hull.cpp and mesh.cpp. They add a shape's collider and make its collision mesh if
// there is none yet. A hull whose points are on one line needs none.
hair_result hair_bullet_add_hull(hair_bullet* bullet, const btConvexShape* shape, const hair_gather& context);
hair_result hair_bullet_add_mesh(hair_bullet* bullet, const btConcaveShape* shape,
                                 const hair_gather& context);

// Functions of collision_meshes.cpp.
// Return the entry of a shape, or NULL if the shape is not cached with this fingerprint.
hair_cached_shape* hair_bullet_find(hair_bullet* bullet, const btCollisionShape* shape, uint64_t fingerprint);
// Store the collision mesh of a shape and take ownership. NULL stands for a shape that can have
// none.
hair_result hair_bullet_keep(hair_bullet* bullet, const btCollisionShape* shape, uint64_t fingerprint,
                             hair_collision_mesh* collision_mesh);
// Free the entries that have not been met for more than `rounds` rounds, and the entry of `shape`.
void hair_bullet_free_old(hair_bullet* bullet, uint32_t rounds, const btCollisionShape* shape);
// Functions of mesh.cpp.
// Add the collider of a shape with its collision mesh, rounded by a margin.
hair_result hair_bullet_add_collision_mesh(hair_bullet* bullet, const btCollisionShape* shape,
                                           const hair_gather& context,
                                           const hair_collision_mesh* collision_mesh, float rounding,
                                           float scale);
// Make and store the collision mesh of a shape. A shape that can have none is stored as well, so
// that it is not tried again.
hair_result hair_bullet_make_collision_mesh(hair_bullet* bullet, const btCollisionShape* shape,
                                            uint64_t fingerprint, const struct hair_mesh& mesh, float room,
                                            const hair_collision_mesh** out);
// Continue the FNV-1a hash `fingerprint` with `bytes`. Defined in collision_meshes.cpp.
uint64_t hair_bullet_fingerprint(uint64_t fingerprint, const void* bytes, size_t size);

hair_result hair_bullet_wrong(hair_bullet* bullet, const btCollisionShape* shape, const hair_gather& context,
                              const char* what);

#endif
