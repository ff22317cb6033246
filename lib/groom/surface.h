// surface.h - the scalp as triangles, searched for the one nearest to a root.
#ifndef HAIR_GROOM_SURFACE_H
#define HAIR_GROOM_SURFACE_H

#include "lib/collide/triangles.h"
#include "lib/groom/draft.h"

struct hair_surface {
    const struct hair_draft* draft;
    float* corners; // xyz, three per triangle, so that a corner identifies its triangle
    uint32_t* indices;
    struct hair_triangles triangles; // A count of 0 means that all triangles are degenerate.
};

// Build the surface. It must be freed even if this fails.
hair_result hair_surface_build(const struct hair_draft* draft, struct hair_surface* out);
void hair_surface_free(struct hair_surface* surface);

// Return the closest point on the scalp. At least one triangle must exist.
struct hair_spot hair_surface_spot(struct hair_surface* surface, hair_vec3 root);

#endif
