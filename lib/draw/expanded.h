// expanded.h - followers as vertices, made once for all views of them: memory and a pass only where that is asked for.
#ifndef HAIR_DRAW_EXPANDED_H
#define HAIR_DRAW_EXPANDED_H

#include "lib/gl/gl.h"

struct hair_expanded {
    GLuint position, tangent, shaded; // buffers, as in shared.h; 0 until they are needed
    GLuint position_texture, tangent_texture, shaded_texture; // of them, for what draws
    size_t vertices; // that there is room for
    int there; // vertices of all followers have been written,
    uint32_t met, made; // for these counts of hair_hits.met and hair_gl.made
    uint32_t writes; // of vertices, so far
};

#endif
