// staged.h - vertices of the strands that are listed, as one view of levels of detail wants them. Only while one does.
#ifndef HAIR_DRAW_STAGED_H
#define HAIR_DRAW_STAGED_H

#include "lib/gl/gl.h"

enum { HAIR_STAGED_POSITION, HAIR_STAGED_TANGENT, HAIR_STAGED_SHADED, HAIR_STAGED_PARTS };

struct hair_staged {
    GLuint buffer
        [HAIR_STAGED_PARTS]; // as HAIR_BIND_EXPANDED and the two after it in shared.h; 0 until they are needed
    GLuint texture[HAIR_STAGED_PARTS]; // of them
    size_t size[HAIR_STAGED_PARTS]; // bytes
    size_t vertices; // that there is room for
};

#endif
