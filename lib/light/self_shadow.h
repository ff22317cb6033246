// self_shadow.h - light that reaches each vertex of the strands. Its memory and passes exist only
// if a look requests them.
#ifndef HAIR_LIGHT_SELF_SHADOW_H
#define HAIR_LIGHT_SELF_SHADOW_H

#include "lib/gl/commands.h"

struct hair_self_shadow_state {
    GLuint density, nodes, light; // Buffers, as in shared.h. 0 until needed.
    GLuint texture; // Buffer texture of `light`.
    uint32_t room; // Capacity of the grid, in nodes.
    uint32_t spare; // Number of views in turn that need much less.
    uint32_t each; // Number of values of each node and of each vertex.
    size_t numbers; // Capacity of `light`, in values.
    uint32_t fraction; // Fraction of the strands that have values, as in hair_vertex_cache.
    uint32_t filled; // Value of hair_vertex_cache.writes that the grid is for.
    // Frame number of the view that light was last computed for, and its light count.
    uint32_t frame, count;
    hair_vec4 lights[HAIR_LIGHTS * HAIR_LIGHT_VECTORS]; // Lights of that view.
    hair_mat4 maps[HAIR_SHADOW_MAPS];
};

#endif
