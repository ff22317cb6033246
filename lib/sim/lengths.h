// lengths.h - lengths of guides and followers, which are cut and grow while they are simulated.
//
// A guide that is cut has fewer vertices. Those that it keeps do not change, and the buffers keep
// their layout. Followers keep their places on the whole strand, of which less is drawn.
#ifndef HAIR_SIM_LENGTHS_H
#define HAIR_SIM_LENGTHS_H

#include "lib/gl/commands.h"
#include "lib/groom/groom.h"

#include <stdbool.h>

// All pointers but `groom` are NULL, and all buffers 0, while every strand is whole.
struct hair_lengths {
    const struct hair_groom* groom; // The groom of the instance, which lives longer.
    uint32_t version; // Number of changes so far.
    struct hair_guide* guides; // Guides as they are cut.
    struct hair_rest* rest; // Their vertices at rest.
    float* guide_fraction; // Fraction of its length that each guide has, [0, 1].
    float* follower_fraction; // Fraction of its length that each follower has, [0, 1].
    GLuint follower, follower_texture; // Buffer of `follower_fraction`, and its texture.
};

// Lengths to come, and the buffers that they need.
struct hair_new_lengths {
    struct hair_lengths lengths;
    GLuint guide, rest, change;
    uint32_t changed; // Number of guides that change.
};

struct hair_sim;

void hair_lengths_init(struct hair_lengths* lengths, const struct hair_groom* groom);
void hair_lengths_free(struct hair_sim* sim);

// Make lengths from fractions of all guides and followers, which are copied. Both are NULL for
// whole strands. On failure nothing has changed.
hair_result hair_lengths_make(struct hair_sim* sim, const float* guide_fraction,
                              const float* follower_fraction, struct hair_new_lengths* out);
// Use lengths that have been made. `moves_state` is false if the state is loaded afterwards.
void hair_lengths_use(struct hair_sim* sim, struct hair_new_lengths* made, bool moves_state);
void hair_lengths_discard(struct hair_sim* sim, struct hair_new_lengths* made);

// Give `count` guides from `first` on the fractions of their lengths, [0, 1], and followers theirs
// from their guides. Set *changes to whether anything changes. On failure nothing has changed.
hair_result hair_sim_set_lengths(struct hair_sim* sim, uint32_t first, uint32_t count, const float* fractions,
                                 bool* changes);
// Give all guides and followers fractions of their lengths, [0, 1]. On failure nothing has changed.
hair_result hair_sim_set_strand_lengths(struct hair_sim* sim, const float* guide_fraction,
                                        const float* follower_fraction);
// Give all strands the lengths of an instance of the same groom. On failure nothing has changed.
hair_result hair_sim_copy_lengths(struct hair_sim* sim, const struct hair_lengths* from);
// Move the vertices that guides have lost to their tips. xyz per guide vertex, of which there are
// `count`.
void hair_lengths_move_lost(const struct hair_sim* sim, float* positions, uint32_t count);

#endif
