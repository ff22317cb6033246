// seats.h - the scalp at rest, and where on it roots sit: what it takes to let them ride on one that is skinned.
#ifndef HAIR_GROOM_SEATS_H
#define HAIR_GROOM_SEATS_H

#include <stdatomic.h>

#include "lib/base/host.h"
#include "glsl/shared.h"

// Immutable once made, but for how many hold it: a groom may be gone while instances still ride.
struct hair_seats {
    hair_host host; // whose memory it is
    atomic_uint holders;
    uint32_t vertex_count;
    uint32_t count; // guides, then followers
    float* positions; // xyz per vertex of the scalp, as the strands
    struct hair_seat* seat;
    float* uv; // per follower, of its root; NULL: the scalp has none
};

// One holder more, one less; the last one frees it. Any thread. NULL is none.
struct hair_seats* hair_seats_hold(struct hair_seats* seats);
void hair_seats_release(struct hair_seats* seats);

#endif
