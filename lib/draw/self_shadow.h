// self_shadow.h - how much light comes to each vertex of the strands: memory and passes only where a look asks for it.
#ifndef HAIR_DRAW_SELF_SHADOW_H
#define HAIR_DRAW_SELF_SHADOW_H

#include "lib/gl/gl.h"

struct hair_self_shadow {
    GLuint density, box, nodes, light; // buffers, as in shared.h; 0 until they are needed
    GLuint texture; // of the last
    uint32_t each; // numbers of each node and of each vertex
    size_t numbers; // that it has room for
    uint32_t filled; // for which count of hair_expanded.writes the grid is
    uint32_t frame, count; // of the view that light was found for last, and of its lights
    hair_vec4 lights[HAIR_LIGHTS * HAIR_LIGHT_VECTORS]; // as they were
    hair_mat4 maps[HAIR_SHADOW_MAPS];
};

#endif
