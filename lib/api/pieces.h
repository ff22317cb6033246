// pieces.h - what a cut takes away from hair, as an instance of free strands.
#ifndef HAIR_API_PIECES_H
#define HAIR_API_PIECES_H

#include "lib/api/api.h"

// The end of a follower that a cut takes away.
struct hair_piece {
    uint32_t follower;
    uint32_t segment; // Drawn segment in which the piece starts.
    float t; // Place in the segment, [0, 1].
    float fraction; // Fraction of its length that the follower had before the cut.
};

// Hair as it was before a cut, and the pieces that the cut takes away.
struct hair_piece_source {
    hair_instance* hair;
    const struct hair_state* states; // Guides at the end of the last substep.
    const hair_vec4* vertices; // Followers as they are drawn.
    struct hair_piece* pieces;
    uint32_t count;
};

// Return the length of a piece as it is drawn, m.
double hair_piece_length(const struct hair_piece_source* source, const struct hair_piece* piece);
// Create an instance of the pieces, which move as the hair does. `out` receives NULL if all pieces
// are too short.
hair_result hair_pieces_create(struct hair_piece_source* source, hair_instance** out);

#endif
