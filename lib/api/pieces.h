// pieces.h - what a cut takes away from hair, as an instance of free strands.
#ifndef HAIR_API_PIECES_H
#define HAIR_API_PIECES_H

#include "lib/api/api.h"

// The end of a follower that a cut takes away.
struct hair_piece {
    const hair_vec4* vertices; // Vertices of its follower as they are drawn.
    uint32_t follower;
    uint32_t segment; // Drawn segment in which the piece starts.
    float t; // Place in the segment, [0, 1].
    float fraction; // Fraction of its length that the follower had before the cut.
};

// Hair as it was before a cut, and the pieces that the cut takes away.
struct hair_piece_source {
    hair_instance* hair;
    const struct hair_state* states; // Guides at the end of the last substep.
    struct hair_piece* pieces;
    uint32_t count;
};

// Return the number of drawn segments of a follower.
static inline uint32_t hair_piece_segments(const struct hair_piece_source* source)
{
    return source->hair->geometry.look.strand.segments;
}
// Return the fraction of the length of its follower at which a piece starts.
static inline float hair_piece_start(const struct hair_piece_source* source, const struct hair_piece* piece)
{
    return piece->fraction * ((float)piece->segment + piece->t) / (float)hair_piece_segments(source);
}
// Give the guides of pieces the velocities of the hair. `piece_of` has the piece of each guide.
hair_result hair_pieces_set_motion(const struct hair_piece_source* source, const uint32_t* piece_of,
                                   hair_instance* pieces);
// Return the length of a piece as it is drawn, m.
double hair_piece_length(const struct hair_piece_source* source, const struct hair_piece* piece);
// Create an instance of the pieces, which move as the hair does. `out` receives NULL if all pieces
// are too short.
hair_result hair_pieces_create(struct hair_piece_source* source, hair_instance** out);

#endif
