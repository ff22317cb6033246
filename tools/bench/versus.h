// versus.h - Lines one pixel wide against ribbons of the correct width, at equal run time.
#ifndef HAIR_TOOLS_BENCH_VERSUS_H
#define HAIR_TOOLS_BENCH_VERSUS_H

#include "tools/bench/rows.h"
#include "tools/bench/studio.h"

struct bench_contender {
    struct bench_shot shot;
    double ms; // minimum, which other load affects least
    double flip;
    json_t* row; // owned by the suite's rows
};

struct bench_versus {
    struct bench_contender* of;
    size_t count, room;
};

// Add a contender. Return false if memory runs out.
bool bench_versus_add(struct bench_versus* versus, const struct bench_contender* contender);
void bench_versus_free(struct bench_versus* versus);

// Set "to_ribbons" of lines, their error over the minimum error of ribbons that take no longer. If
// two times are close, alternating measurements decide. Return false if OpenGL or the library
// refused.
bool bench_versus_settle(struct bench_versus* versus, struct bench_studio* studio);

#endif
