// bench.h - Context, options, rows and progress, which the suites of hair-bench share.
#ifndef HAIR_TOOLS_BENCH_BENCH_H
#define HAIR_TOOLS_BENCH_BENCH_H

#include <hair/hair_egl.h>

#include "tools/bench/rows.h"

#define BENCH_TOOL "hair-bench"

#define BENCH_MAX_PASSES 256 // maximum of hair_get_timings, more than any suite needs

struct bench_suite;

// Parsed command line.
struct bench_options {
    const struct bench_suite* suite;
    const char* json; // NULL disables it
    const char* csv;
    const char* only_case; // NULL selects all
    const char* only_method;
    hair_thread_mapping mapping;
    uint32_t strands; // 0 uses the suite's number
    uint32_t scene; // first random scene
    uint32_t scenes; // number of random scenes, 0 uses the suite's number
    uint32_t size; // pixels per side of pictures, 0 uses the suite's size
    int device;
    bool quick, quiet, verbose;
};

struct bench {
    struct bench_options options;
    hair_host host;
    hair_egl* egl;
    hair_context* context;
    const char* renderer;
    bool software; // the driver's timer queries do not measure compute shaders
    struct bench_rows rows;

    bool planning; // nothing is run, rows are only counted
    uint32_t planned, done;
    char cases[2048]; // names of all cases, for the message about a wrong --case
    double started; // ms
    char sentence[512]; // last sentence of the library's log
    char refused[512]; // last sentence that was printed
};

struct bench_suite {
    const char* name;
    const char* about;
    const char* const* columns;
    void (*run)(struct bench* bench);
};

// Suites, in the order of --help.
// clang-format off
#define BENCH_SUITES(SUITE) \
    SUITE(accuracy) SUITE(bounds) SUITE(collision) SUITE(dispatch) SUITE(field) \
    SUITE(followers) SUITE(heads) SUITE(lod) SUITE(paths) SUITE(physics) SUITE(raster) \
    SUITE(render) SUITE(scale) SUITE(shadow) SUITE(skip) SUITE(stability) \
    SUITE(startup) SUITE(table) SUITE(wind)
// clang-format on
#define BENCH_DECLARE(name) extern const struct bench_suite bench_##name;
BENCH_SUITES(BENCH_DECLARE)

// Return whether to make the rows of this case and method, and show progress. Return false if the
// row is not requested, during planning, and after an interrupt.
bool bench_begin(struct bench* bench, const char* name, const char* method);

// Print why a row's measurement failed, once per sentence and never after an interrupt. The row is
// not made.
void bench_refuse(struct bench* bench, const char* name, const char* method);

bool bench_was_interrupted(void);

// Parse the command line. Return an exit status, or -1 to continue.
int bench_parse(int count, char** arguments, struct bench_options* out);

#endif
