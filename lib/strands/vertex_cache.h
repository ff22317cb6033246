// vertex_cache.h - vertex cache of followers, shared by all views. Its memory and its pass exist
// only on demand.
#ifndef HAIR_STRANDS_VERTEX_CACHE_H
#define HAIR_STRANDS_VERTEX_CACHE_H

#include "lib/gl/commands.h"

struct hair_vertex_cache {
    GLuint position, tangent, shaded; // Buffers, as in shared.h. 0 until needed.
    GLuint position_texture, tangent_texture, shaded_texture; // Their buffer textures, for drawing.
    size_t vertices; // Capacity in vertices.
    uint32_t fraction; // Fraction of the strands that there is room for, as in hair_draw_params.
    uint32_t spare_strands; // Number of views in sequence that need room for much fewer strands.
    uint32_t spare; // Number of writes in sequence without the tangents that there is memory for.
    int is_complete; // Nonzero if the vertices of all followers are written.
    uint32_t generation; // Value of hair_follower_collision_state.generation at the last write.
    uint32_t program_generation; // Value of hair_gl.program_generation at the last write.
    uint32_t writes; // Number of writes so far.
};

#endif
