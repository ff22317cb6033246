// style_scalp.h - the built-in scalp: the hair-bearing part of the skull as an even mesh.
#ifndef HAIR_GROOM_STYLE_SCALP_H
#define HAIR_GROOM_STYLE_SCALP_H

#include "lib/base/host.h"
#include "lib/base/math.h"

// The parting of the hair, seen from above. It is a cut in the mesh from the hairline to the crown,
// so that no follower lies between guides that run in opposite directions.
struct hair_parting {
    uint32_t exists;
    float front, crown; // x of both ends, m
    float crown_z; // z of the far end, m
};

struct hair_scalp {
    float* positions; // xyz per vertex
    uint32_t vertex_count;
    uint32_t* triangles; // three indices each, counter-clockwise from outside
    uint32_t triangle_count;
};

#define HAIR_PARTING_FRONT_Z 0.074f // z at which partings begin, at the hairline above the brow, m.

// Return the x coordinate of the parting at `z`, m. The parting is straight seen from above.
float hair_parting_x(struct hair_parting parting, float z);

// Build a mesh of `vertex_count` vertices, at least 16. On failure nothing is kept.
hair_result hair_scalp_build(const hair_host* host, uint32_t vertex_count, struct hair_parting parting,
                             uint32_t seed, struct hair_scalp* out);
void hair_scalp_free(const hair_host* host, struct hair_scalp* scalp);

// Return the height of the hairline at `azimuth`, m. 0 is the direction of the face on the unit
// sphere that the skull is scaled from.
float hair_scalp_hairline(float azimuth);

// Compute the counter-clockwise Delaunay triangles of `count` different points in the plane, xy
// each. `out` has room for 2 * count triangles. Return the number of triangles, or 0 if memory ran
// out.
uint32_t hair_triangulate(const hair_host* host, const double* points, uint32_t count, uint32_t* out);

#endif
