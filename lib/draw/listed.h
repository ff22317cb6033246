// listed.h - strands that are drawn without a tessellator: a list of them, drawn in instances of HAIR_INSTANCE_STRANDS.
#ifndef HAIR_DRAW_LISTED_H
#define HAIR_DRAW_LISTED_H

#include "lib/gl/gl.h"

// What a list was made of.
struct hair_listing {
    uint32_t made; // as in hair_gl; 0: there is none
    uint32_t runs; // of smooth.comp, where the list depends on where hair is
    struct hair_draw_params params; // what the list depends on, else 0
};

// Of every segment of an instance.
struct hair_listed_indices {
    GLuint index, vertex_array;
    uint32_t segments; // that those are for
};

struct hair_listed {
    struct hair_listing* of;
    GLuint start, strand, command; // buffers, as in shared.h; 0 until they are needed
    GLuint strand_texture; // of the second, for what draws
    struct hair_listed_indices indices[2]; // of ends; and of pairs of vertices
};

#endif
