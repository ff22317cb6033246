// triangles.h - many triangles in a tree of boxes: the nearest one, and how often they wind around a point.
#ifndef HAIR_COLLIDE_TRIANGLES_H
#define HAIR_COLLIDE_TRIANGLES_H

#include "lib/base/host.h"
#include "lib/base/math.h"

// A node's triangles from afar: one dipole.
struct hair_dipole {
    hair_vec3 area; // the sum of their area vectors
    hair_vec3 center; // weighted by area
    float radius; // no vertex is farther from the centre
};

struct hair_box {
    hair_vec3 lower, upper;
};

// Positions are from `center`, so that floats resolve what is small but far from the origin.
struct hair_triangles {
    const float* positions;
    hair_vec3 center;
    struct hair_box bounds; // from the centre
    uint32_t count; // of those that have three different corners; the others are left out
    uint32_t (*indices)[3]; // along a space-filling curve; leaves are HAIR_TRIANGLES_PER_LEAF of them each
    uint32_t leaves;
    uint32_t lowest; // the first node of the tree's lowest level, plus 1: a power of two
    struct hair_box* box; // of 2 leaves - 1 nodes: the children of i are 2 i + 1 and 2 i + 2
    struct hair_dipole* dipole;
    uint64_t work; // nodes and triangles looked at so far
};

#define HAIR_TRIANGLES_PER_LEAF 4

// The arrays have been checked; the positions must stay as they are until the tree is freed. Of a count of 0
// afterwards there is no tree.
hair_result hair_triangles_build(const hair_host* host, const float* positions, const uint32_t* indices,
                                 uint32_t count, struct hair_triangles* out);
void hair_triangles_free(const hair_host* host, struct hair_triangles* triangles);

// From a point, which is from the centre, to one of them.
float hair_triangles_distance(const struct hair_triangles* triangles, uint32_t place, hair_vec3 point);

// The nearest one that is nearer than `distance`, which becomes its distance, and `nearest` its place; else both stay.
void hair_triangles_find(struct hair_triangles* triangles, hair_vec3 point, float* distance,
                         uint32_t* nearest);

// The generalised winding number of Jacobson et al. 2013 by dipoles (Barill et al. 2018), good to 0.1.
float hair_triangles_winding(struct hair_triangles* triangles, hair_vec3 point);

// Whether they have an inside: at every edge as many pass one way as the other, by the positions of vertices.
int hair_triangles_are_closed(const struct hair_triangles* triangles);

#endif
