// seats.h - the scalp at rest and the root bindings to it, as scalp motion needs them.
#ifndef HAIR_GROOM_SEATS_H
#define HAIR_GROOM_SEATS_H

#include <stdatomic.h>

#include "lib/base/host.h"
#include "glsl/shared.h"

// Immutable once made, except the reference count. A groom may be freed before its instances.
struct hair_seats {
    hair_host host; // owner of the memory
    atomic_uint holders;
    uint32_t vertex_count;
    uint32_t count; // guides, then followers
    float* positions; // xyz per vertex of the scalp, in the space of the strands
    struct hair_seat* seat;
    float* uv; // of the root of each follower. NULL without scalp UVs.
};

// Add a reference. Any thread. NULL is ignored. Return `seats`.
struct hair_seats* hair_seats_hold(struct hair_seats* seats);
// Remove a reference and free `seats` with the last one. Any thread. NULL is ignored.
void hair_seats_release(struct hair_seats* seats);

#endif
