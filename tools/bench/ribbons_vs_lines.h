// ribbons_vs_lines.h - Lines one pixel wide against ribbons of the correct width, at equal run
// time.
#ifndef HAIR_TOOLS_BENCH_RIBBONS_VS_LINES_H
#define HAIR_TOOLS_BENCH_RIBBONS_VS_LINES_H

#include "tools/bench/rows.h"
#include "tools/bench/studio.h"

struct bench_contender {
    struct bench_shot shot;
    double ms; // minimum, which other load affects least
    double flip;
    json_t* row; // owned by the suite's rows
};

struct bench_comparison {
    struct bench_contender* of;
    size_t count, room;
};

// Add a contender. Return false if memory runs out.
bool bench_comparison_add(struct bench_comparison* comparison, const struct bench_contender* contender);
void bench_comparison_free(struct bench_comparison* comparison);

// Set "to_ribbons" of lines, their error over the minimum error of ribbons that take no longer. If
// two times are close, alternating measurements decide. Return false if OpenGL or the library
// refused.
bool bench_comparison_finish(struct bench_comparison* comparison, struct bench_studio* studio);

#endif
