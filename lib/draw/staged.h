// staged.h - per-view vertices of the listed strands, for a level of detail. They take memory only
// while a view uses them.
#ifndef HAIR_DRAW_STAGED_H
#define HAIR_DRAW_STAGED_H

#include "lib/gl/gl.h"

enum { HAIR_STAGED_POSITION, HAIR_STAGED_TANGENT, HAIR_STAGED_SHADED, HAIR_STAGED_PARTS };

struct hair_staged {
    // Buffers, as at HAIR_BIND_EXPANDED and the two bindings after it in shared.h. 0 until needed.
    GLuint buffer[HAIR_STAGED_PARTS];
    GLuint texture[HAIR_STAGED_PARTS]; // Buffer textures of `buffer`.
    size_t size[HAIR_STAGED_PARTS]; // Size of each buffer in bytes.
    size_t vertices; // Capacity in vertices.
};

#endif
