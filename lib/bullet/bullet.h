// bullet.h - what the parts of libhair_bullet share: a list of solids, and the forms of shapes that have been met.
#ifndef HAIR_BULLET_BULLET_H
#define HAIR_BULLET_BULLET_H

#include <btBulletCollisionCommon.h>
#include <hair/hair_bullet.h>

extern "C" {
#include "lib/base/host.h"
}

// A shape that has been met, and what became of it.
struct hair_met {
    const btCollisionShape* shape;
    uint64_t print; // of its numbers: another one, and it is another shape at the same place
    hair_form* form; // NULL: it can be none, and the log has said so
    uint32_t round; // of hair_bullet_begin, when it was last met
};

struct hair_bullet {
    hair_host host;
    uint32_t resolution;
    uint32_t round;
    uint32_t visits; // of shapes, while one object is taken
    hair_solid* solids;
    uint32_t count, capacity;
    hair_met* met; // a table: empty places have no shape
    uint32_t met_count, met_capacity;
    const void** hits; // proxies that the broadphase has found
    uint32_t hit_count, hit_capacity;
};

// Room for `count` elements of `size` bytes in an array that is at `array`. The array grows by more than that.
hair_result hair_bullet_reserve(const hair_host* host, void** array, uint32_t* capacity, uint32_t count,
                                size_t size);

// Triangles that grow.
struct hair_mesh {
    const hair_host* host;
    hair_result result; // the first failure's; nothing is added after it
    float* positions;
    uint32_t* triangles;
    uint32_t vertex_count, triangle_count;
    uint32_t position_room, triangle_room;

    void add_vertex(const btVector3& at);
    void add_triangle(uint32_t a, uint32_t b, uint32_t c);
    void release();
};

// What is being taken: where it is, and what its solids have in common.
struct hair_taking {
    btTransform transform;
    float friction;
    uint64_t key; // of the object; every solid of it gets another one of that
    uint32_t depth;
    bool is_quiet; // what can be no solid is said once, as a warning
};

// shape.cpp
hair_result hair_bullet_add(hair_bullet* bullet, const btCollisionShape* shape, const hair_taking& taking);
hair_result hair_bullet_add_solid(hair_bullet* bullet, const btCollisionShape* shape,
                                  const hair_taking& taking, hair_solid solid, const btQuaternion& turn);

// hull.cpp, mesh.cpp: by a shape's form, made if there is none yet. A hull of one point or two needs none.
hair_result hair_bullet_add_hull(hair_bullet* bullet, const btConvexShape* shape, const hair_taking& taking);
hair_result hair_bullet_add_mesh(hair_bullet* bullet, const btConcaveShape* shape, const hair_taking& taking);

// forms.cpp. `found`: NULL when it has not been met as it is.
hair_met* hair_bullet_find(hair_bullet* bullet, const btCollisionShape* shape, uint64_t print);
hair_result hair_bullet_keep(hair_bullet* bullet, const btCollisionShape* shape, uint64_t print,
                             hair_form* form);
void hair_bullet_free_old(hair_bullet* bullet, uint32_t rounds, const btCollisionShape* shape);
// Its solid, rounded by a margin, by the mesh of `points` and `triangles` where the form is not kept yet. Takes the
// form. A shape that can have none is kept as well, so that it is not tried again.
hair_result hair_bullet_add_form(hair_bullet* bullet, const btCollisionShape* shape,
                                 const hair_taking& taking, const hair_form* form, float rounding,
                                 float scale);
hair_result hair_bullet_make_form(hair_bullet* bullet, const btCollisionShape* shape, uint64_t print,
                                  const struct hair_mesh& mesh, float room, const hair_form** out);
uint64_t hair_bullet_print(uint64_t print, const void* bytes, size_t size); // FNV-1a, from a print on

hair_result hair_bullet_wrong(hair_bullet* bullet, const btCollisionShape* shape, const hair_taking& taking,
                              const char* what);

#endif
