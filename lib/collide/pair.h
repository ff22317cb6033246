// pair.h - which solid of this step is which of the last.
#ifndef HAIR_COLLIDE_PAIR_H
#define HAIR_COLLIDE_PAIR_H

#include "lib/base/host.h"

// For each of `now` its place in `before`, or UINT32_MAX, into `pair`: by key, and of alike keys, 0 among them, the
// n-th with the n-th. `stride` is of `now`. On failure nothing is written.
hair_result hair_pair_solids(const hair_host* host, const hair_solid* now, uint32_t count, size_t stride,
                             const hair_solid* before, uint32_t count_before, uint32_t* pair);

#endif
