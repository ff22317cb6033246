// sorted_segments.h - segments sorted from far to near, to blend coverage. They take memory only on
// demand.
#ifndef HAIR_DRAW_SORTED_SEGMENTS_H
#define HAIR_DRAW_SORTED_SEGMENTS_H

#include "lib/gl/commands.h"

struct hair_sorted_segments {
    GLuint bucket, index, vertex_array; // OpenGL objects. 0 until needed.
    size_t segments; // Capacity in segments.
};

#endif
