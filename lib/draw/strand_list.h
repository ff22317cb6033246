// strand_list.h - list of the strands that are drawn without a tessellator, in instances of
// HAIR_INSTANCE_STRANDS.
#ifndef HAIR_DRAW_STRAND_LIST_H
#define HAIR_DRAW_STRAND_LIST_H

#include "lib/gl/commands.h"

// Inputs that a list was built from.
struct hair_strand_list_key {
    uint32_t program_generation; // Value of hair_gl.program_generation. 0 if there is no list.
    uint32_t runs; // Run of smooth.comp, if the list depends on the positions of hair.
    struct hair_draw_params params; // Parameters that the list depends on. All others are 0.
};

// Indices of every segment of an instance.
struct hair_strand_list_indices {
    GLuint index, vertex_array;
    uint32_t segments; // Segments per strand of the indices.
};

struct hair_strand_list {
    struct hair_strand_list_key* key;
    GLuint start, strand, command; // Buffers, as in shared.h. 0 until needed.
    GLuint strand_texture; // Buffer texture of `strand`, for drawing.
    uint32_t room; // Capacity in strands.
    uint32_t spare; // Number of views in sequence that need much less.
    // Indices of single vertices, then of paired vertices.
    struct hair_strand_list_indices indices[2];
};

#endif
