// field_body.h - Rows of suite `field` about bodies that deform.
#ifndef HAIR_TOOLS_BENCH_FIELD_BODY_H
#define HAIR_TOOLS_BENCH_FIELD_BODY_H

#include "tools/bench/bench.h"

// Measure the time to compute the distances to a body all of whose vertices have moved, and to one
// that has not moved.
void bench_field_bodies(struct bench* bench);

#endif
