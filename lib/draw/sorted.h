// sorted.h - segments sorted from far to near, to blend coverage. They take memory only on demand.
#ifndef HAIR_DRAW_SORTED_H
#define HAIR_DRAW_SORTED_H

#include "lib/gl/gl.h"

struct hair_sorted {
    GLuint bucket, index, vertex_array; // OpenGL objects. 0 until needed.
    size_t segments; // Capacity in segments.
};

#endif
