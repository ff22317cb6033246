// listed.h - strands that are drawn without a tessellator: a list of them, drawn in instances of HAIR_INSTANCE_STRANDS.
#ifndef HAIR_DRAW_LISTED_H
#define HAIR_DRAW_LISTED_H

#include "lib/gl/gl.h"

struct hair_listed {
    GLuint   start, strand, command; // buffers, as in shared.h; 0 until they are needed
    GLuint   strand_texture;         // of the second, for what draws
    GLuint   index, vertex_array;    // both ends of every segment of an instance
    uint32_t segments;               // that those are for
};

#endif
