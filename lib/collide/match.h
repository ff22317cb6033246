// match.h - matching of the colliders of this step with those of the previous step.
#ifndef HAIR_COLLIDE_MATCH_H
#define HAIR_COLLIDE_MATCH_H

#include "lib/base/host.h"

// Write to `match`, for each collider of `now`, its index in `previous` or UINT32_MAX. Colliders
// are matched by key. Among equal keys, including 0, the n-th matches the n-th. `stride` applies to
// `now`. On failure nothing is written.
hair_result hair_match_colliders(const hair_host* host, const hair_collider* now, uint32_t count,
                                 size_t stride, const hair_collider* previous, uint32_t previous_count,
                                 uint32_t* match);

#endif
