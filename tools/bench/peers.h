// peers.h - Rows of other libraries in the suite `accuracy`, measured elsewhere.
#ifndef HAIR_TOOLS_BENCH_PEERS_H
#define HAIR_TOOLS_BENCH_PEERS_H

#include "tools/bench/bench.h"

void bench_add_peers(struct bench* bench);

#endif
