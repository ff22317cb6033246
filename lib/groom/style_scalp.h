// style_scalp.h - the built-in scalp: the hair-bearing part of the skull, as an even mesh.
#ifndef HAIR_GROOM_STYLE_SCALP_H
#define HAIR_GROOM_STYLE_SCALP_H

#include "lib/base/host.h"
#include "lib/base/math.h"

// Where the hair is parted, seen from above: a cut in the mesh from the hairline to the crown, so that no
// follower lies between guides that go opposite ways.
struct hair_parting {
    uint32_t exists;
    float front, crown; // x of its ends. m.
    float crown_z; // z of its far end. m.
};

struct hair_scalp {
    float* positions; // xyz per vertex
    uint32_t vertex_count;
    uint32_t* triangles; // three each, counter-clockwise from outside
    uint32_t triangle_count;
};

#define HAIR_PARTING_FRONT_Z 0.074f // Where partings begin: the hairline above the brow. m.

// Of the line, which is straight seen from above. m.
float hair_parting_x(struct hair_parting parting, float z);

// `vertex_count` vertices in all, 16 or more. On failure nothing is kept.
hair_result hair_scalp_build(const hair_host* host, uint32_t vertex_count, struct hair_parting parting,
                             uint32_t seed, struct hair_scalp* out);
void hair_scalp_free(const hair_host* host, struct hair_scalp* scalp);

// Height of the hairline where the skull, scaled to a sphere, is `azimuth` away from the face. m.
float hair_scalp_hairline(float azimuth);

// Delaunay triangles of points in the plane, xy each, counter-clockwise; `out` holds 2 * count of three.
// Points must differ. Returns how many, or 0 when memory ran out.
uint32_t hair_triangulate(const hair_host* host, const double* points, uint32_t count, uint32_t* out);

#endif
