// versus.h - lines a pixel wide against what is as wide as it should be, at equal run time.
#ifndef HAIR_TOOLS_BENCH_VERSUS_H
#define HAIR_TOOLS_BENCH_VERSUS_H

#include "tools/bench/rows.h"
#include "tools/bench/studio.h"

struct bench_contender {
    struct bench_shot shot;
    double ms; // the least: of all it depends least on what else the machine does
    double flip;
    json_t* row; // held by the suite's rows
};

struct bench_versus {
    struct bench_contender* of;
    size_t count, room;
};

// False: no memory.
bool bench_versus_add(struct bench_versus* versus, const struct bench_contender* contender);
void bench_versus_free(struct bench_versus* versus);

// Set "to_ribbons" of lines: their error over the least of ribbons that take no longer. Of those whose times are close, which
// takes longer is settled by taking both in turn. False: OpenGL or the library refused.
bool bench_versus_settle(struct bench_versus* versus, struct bench_studio* studio);

#endif
