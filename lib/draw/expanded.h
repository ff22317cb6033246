// expanded.h - vertex cache of followers, shared by all views. Its memory and its pass exist only
// on demand.
#ifndef HAIR_DRAW_EXPANDED_H
#define HAIR_DRAW_EXPANDED_H

#include "lib/gl/gl.h"

struct hair_expanded {
    GLuint position, tangent, shaded; // Buffers, as in shared.h. 0 until needed.
    GLuint position_texture, tangent_texture, shaded_texture; // Their buffer textures, for drawing.
    size_t vertices; // Capacity in vertices.
    int there; // Nonzero if the vertices of all followers are written.
    uint32_t met, made; // Values of hair_hits.met and hair_gl.made at the last write.
    uint32_t writes; // Number of writes so far.
};

#endif
