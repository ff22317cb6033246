// triangles.h - triangles in a bounding volume hierarchy, for the nearest triangle and the winding
// number of a point.
#ifndef HAIR_COLLIDE_TRIANGLES_H
#define HAIR_COLLIDE_TRIANGLES_H

#include "lib/base/host.h"
#include "lib/base/math.h"

// A dipole that stands for the distant triangles of a node.
struct hair_dipole {
    hair_vec3 area; // sum of the area vectors
    hair_vec3 center; // mean of the triangles' centroids, weighted by area
    float radius; // maximum distance of a vertex from the centre
};

struct hair_box {
    hair_vec3 lower, upper;
};

// Triangles in a tree. Positions are relative to `center`, so that floats resolve small shapes far
// from the origin.
struct hair_triangles {
    const float* positions;
    hair_vec3 center;
    struct hair_box bounds; // relative to the centre
    uint32_t count; // number of triangles with three different corners. The others are left out.
    // Indices along a space-filling curve. Each leaf has HAIR_TRIANGLES_PER_LEAF triangles.
    uint32_t (*indices)[3];
    uint32_t leaves;
    uint32_t lowest; // first node of the lowest level, plus 1. It is a power of two.
    struct hair_box* box; // of 2 leaves - 1 nodes. The children of node i are 2 i + 1 and 2 i + 2.
    struct hair_dipole* dipole;
    uint64_t work; // number of nodes and triangles visited so far
};

#define HAIR_TRIANGLES_PER_LEAF 4

// Build the tree. The arrays have been checked. The positions must not change until the tree is
// freed. If `count` is 0 afterwards there is no tree.
hair_result hair_triangles_build(const hair_host* host, const float* positions, const uint32_t* indices,
                                 uint32_t count, struct hair_triangles* out);
void hair_triangles_free(const hair_host* host, struct hair_triangles* triangles);

// Return the distance from a point, relative to the centre, to triangle `place`.
float hair_triangles_distance(const struct hair_triangles* triangles, uint32_t place, hair_vec3 point);

// Find the triangle nearest to a point within `distance`. Write its distance and its place, or
// leave both unchanged.
void hair_triangles_find(struct hair_triangles* triangles, hair_vec3 point, float* distance,
                         uint32_t* nearest);

// Return the generalised winding number of Jacobson et al. 2013 by dipoles (Barill et al. 2018),
// within 0.1.
float hair_triangles_winding(struct hair_triangles* triangles, hair_vec3 point);

// Return whether the triangles have an inside: every edge is passed equally often in both
// directions. Vertices with equal positions count as one.
int hair_triangles_are_closed(const struct hair_triangles* triangles);

#endif
