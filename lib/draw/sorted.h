// sorted.h - segments from far to near, so that shares of pixels can be blended. Only while they are asked for.
#ifndef HAIR_DRAW_SORTED_H
#define HAIR_DRAW_SORTED_H

#include "lib/gl/gl.h"

struct hair_sorted {
    GLuint bucket, index, vertex_array; // 0 until they are needed
    size_t segments; // that there is room for
};

#endif
