// surface.h - the scalp as triangles, searched for the one nearest to a root.
#ifndef HAIR_GROOM_SURFACE_H
#define HAIR_GROOM_SURFACE_H

#include "lib/collide/triangles.h"
#include "lib/groom/groom_builder.h"

struct hair_surface {
    const struct hair_groom_builder* builder;
    float* corners; // xyz, three per triangle, so that a corner identifies its triangle
    uint32_t* indices;
    struct hair_triangles triangles; // A count of 0 means that all triangles are degenerate.
};

// Build the surface. It must be freed even if this fails.
hair_result hair_surface_build(const struct hair_groom_builder* builder, struct hair_surface* out);
void hair_surface_free(struct hair_surface* surface);

// Return the closest point on the scalp. At least one triangle must exist.
struct hair_scalp_point hair_surface_find_point(const struct hair_surface* surface, hair_vec3 root);

#endif
