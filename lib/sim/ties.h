// ties.h - vertices of guides that are held to the head or to the world, as roots are by the scalp.
#ifndef HAIR_SIM_TIES_H
#define HAIR_SIM_TIES_H

#include "lib/base/pose.h"
#include "lib/gl/gl.h"

#define HAIR_MOST_TIES 1048576u // Of an instance: shaders count them in floats.

// A tie, its vertex found.
struct hair_knot {
    uint32_t guide, vertex;
    int world; // or in the head's frame
    double place[3]; // there
    uint32_t given; // which of the ties given it was
};

struct hair_ties {
    struct hair_knot* knot; // in the order of guides and their vertices
    uint32_t count;
    uint32_t most; // of one guide
    uint32_t which; // hash of the vertices that are tied; 0: none
    GLuint buffer, texture; // hair_held[], once there have been any
};

struct hair_sim;

// Take `count` ties, each `stride` bytes from the next. On failure nothing has changed.
hair_result hair_ties_set(struct hair_sim* sim, const hair_tie* from, uint32_t count, size_t stride);

// The same with knots that were saved: fails where they are none of this hair's, then takes the block itself.
hair_result hair_ties_check(const struct hair_sim* sim, const struct hair_knot* knot, uint32_t count);
void hair_ties_take(struct hair_sim* sim, struct hair_knot* knot, uint32_t count);
void hair_ties_free(struct hair_sim* sim);

// What the solver reads, for a step to where the head is to be.
hair_result hair_ties_write(struct hair_sim* sim);
void hair_ties_bind(struct hair_sim* sim);

// Those in the world go along with the head.
void hair_ties_teleport(struct hair_sim* sim, const struct hair_pose* from, const struct hair_pose* to);

#endif
