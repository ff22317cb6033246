// bench.h - what the suites of hair-bench share: the context, what was asked for, rows, progress.
#ifndef HAIR_TOOLS_BENCH_BENCH_H
#define HAIR_TOOLS_BENCH_BENCH_H

#include <hair/hair_egl.h>

#include "tools/bench/rows.h"

#define BENCH_TOOL "hair-bench"

#define BENCH_MOST_PASSES 256 // of hair_timings: more than any bench needs

struct bench_suite;

// What the command line says.
struct bench_options {
    const struct bench_suite* suite;
    const char* json; // NULL: not asked for
    const char* csv;
    const char* only_case; // NULL: all
    const char* only_method;
    hair_mapping mapping;
    uint32_t strands; // 0: as the suite has it
    uint32_t scene; // of random ones, the first, and
    uint32_t scenes; // how many; 0: as the suite has it
    uint32_t size; // of pictures, pixels to each side; 0: as the suite has it
    int device;
    bool quick, quiet, verbose;
};

struct bench {
    struct bench_options options;
    hair_host host;
    hair_egl* egl;
    hair_context* context;
    const char* renderer;
    bool software; // A driver whose timer queries do not see compute shaders.
    struct bench_rows rows;

    bool planning; // Nothing is run, rows are only counted.
    uint32_t planned, done;
    char cases[2048]; // the names of all that were met, for a wrong --case
    double started; // ms
    char sentence[512]; // the last of the library's log
    char refused[512]; // the last that was passed on
};

struct bench_suite {
    const char* name;
    const char* about;
    const char* const* columns;
    void (*run)(struct bench* bench);
};

extern const struct bench_suite bench_accuracy, bench_bounds, bench_collision, bench_field, bench_physics,
    bench_render, bench_lod, bench_paths, bench_scale, bench_shadow, bench_skip, bench_stability, bench_table,
    bench_wind;

// Whether to make the row, or rows, of this case and method: it is asked for, this is no planning, and nobody
// has interrupted. Shows progress.
bool bench_begin(struct bench* bench, const char* name, const char* method);

// The row's measurement has failed: say why, once per sentence. The row is not made.
void bench_refuse(struct bench* bench, const char* name, const char* method);

bool bench_was_interrupted(void);

// Returns what to exit with, or -1 to go on.
int bench_parse(int count, char** arguments, struct bench_options* out);

#endif
