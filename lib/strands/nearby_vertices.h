// nearby_vertices.h - vertices of the patches that a shape may cut, read back.
#ifndef HAIR_STRANDS_NEARBY_VERTICES_H
#define HAIR_STRANDS_NEARBY_VERTICES_H

#include "lib/collide/cutter.h"
#include "lib/strands/geometry.h"

// Vertices of all followers of some patches. The caller frees the arrays, also on failure.
struct hair_nearby_vertices {
    hair_vec4* vertices; // xyz: position from the head's origin, m. w: radius, m. NULL without any.
    size_t* first; // First vertex of each patch in `vertices`, or SIZE_MAX if it was not read.
};

// Read the vertices of the patches that a shape may meet. `out` is zero before.
hair_result hair_geometry_read_nearby(struct hair_geometry* geometry, const struct hair_groom* groom,
                                      const struct hair_cutter* cutter, struct hair_nearby_vertices* out);

#endif
