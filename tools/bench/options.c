// options.c - Command line of hair-bench. One table serves getopt and --help.
#include "tools/bench/bench.h"
#include "tools/common/file.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#define ADDRESS(name) &bench_##name,
static const struct bench_suite* const suites[] = {BENCH_SUITES(ADDRESS)};

#define MAX_SCENE 999999999

enum name {
    JSON = 256,
    CSV,
    QUICK,
    CASE,
    METHOD,
    MAPPING,
    STRANDS,
    SCENE,
    SIZE,
    DEVICE,
    QUIET,
    VERBOSE,
    VERSION
};

static const struct row {
    const char* name;
    int option;
    const char* argument; // NULL if the option takes no argument
    const char* about;
} rows[] = {
    {"json", JSON, "FILE", "write the rows as JSON"},
    {"csv", CSV, "FILE", "write the rows as CSV, with the same keys"},
    {"quick", QUICK, NULL, "fewer and smaller cases"},
    {"case", CASE, "NAME", "only this case of the suite; a name that ends with * is any that begins so"},
    {"method", METHOD, "NAME",
     "only this solver: direct, accurate, follow or redblack; of collision, only\n"
     "                   none, single_guide, push_out, compute or prepass; of followers also followers;\n"
     "                   of render, only this path:\n"
     "                   tessellation, procedural, cached or compute; of shadow, only depth, strands,\n"
     "                   grid, mean or layers; of wind, only this projection:\n"
     "                   multigrid, relaxation or jacobi"},
    {"thread-mapping", MAPPING, "NAME",
     "of guides to GPU threads: auto, workgroup_per_guide or thread_per_guide"},
    {"strands", STRANDS, "N",
     "copies of the strand that are timed; 1000; of followers, render and table,\n"
     "                   strands of the haircut"},
    {"scene", SCENE, "N", "of the case fuzz, only this random scene, or those of N-M"},
    {"size", SIZE, "N", "pixels to each side of pictures; 256 or, on a GPU, what the suite has"},
    {"device", DEVICE, "N", "the EGL device of that index; without it, the first that works"},
    {"quiet", QUIET, NULL, "no progress"},
    {"verbose", VERBOSE, NULL, "pass on all that the library logs"},
    {"help", 'h', NULL, "(also -h) this"},
    {"version", VERSION, NULL, "the version of the library"},
};

#define ROW_COUNT ((int)(sizeof rows / sizeof *rows))
#define SUITE_COUNT (sizeof suites / sizeof suites[0])

static const char* const methods[] = {"one by one",
                                      "list",
                                      "list by turns",
                                      "list of few guides",
                                      "few guides by turns",
                                      "list in 10 ms",
                                      "list in 5 ms",
                                      "direct",
                                      "accurate",
                                      "follow",
                                      "redblack",
                                      "none",
                                      "single_guide",
                                      "push_out",
                                      "compute",
                                      "prepass",
                                      "tessellation",
                                      "procedural",
                                      "cached",
                                      "multigrid",
                                      "relaxation",
                                      "jacobi",
                                      "depth",
                                      "strands",
                                      "grid",
                                      "mean",
                                      "layers",
                                      "followers",
                                      "posts with recorded contacts",
                                      "followers",
                                      NULL};
// In the order of hair_thread_mapping.
static const char* const mappings[] = {"auto", "workgroup_per_guide", "thread_per_guide", NULL};

static int print_help(void)
{
    printf(BENCH_TOOL " - measure the library against what is known\n\n  " BENCH_TOOL
                      " SUITE [OPTION]...\n\n");
    for (size_t i = 0; i < SUITE_COUNT; ++i) printf("  %-16s %s\n", suites[i]->name, suites[i]->about);
    printf("\n");
    for (int i = 0; i < ROW_COUNT; ++i) {
        char left[64];
        snprintf(left, sizeof left, "--%s %s", rows[i].name, rows[i].argument ? rows[i].argument : "");
        printf("  %-16s %s\n", left, rows[i].about);
    }
    printf("\nFILE may be \"-\", the standard output, which then has no table.\n"
           "Exit status: 0 done, 1 failed while running, 2 wrong use, 3 no OpenGL 4.5.\n");
    return hair_flush(BENCH_TOOL);
}

static int print_version(void)
{
    uint32_t version = hair_version();
    printf(BENCH_TOOL " %u.%u.%u\n", version / 10000, version / 100 % 100, version % 100);
    return hair_flush(BENCH_TOOL);
}

static int misuse(void)
{
    hair_complain(BENCH_TOOL, "--help lists suites and options");
    return HAIR_EXIT_USAGE;
}

static bool parse_count(const char* option, const char* text, uint32_t min, uint32_t max, uint32_t* out)
{
    char* end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    *out = (uint32_t)value;
    if (*text >= '0' && *text <= '9' && !*end && !errno && value >= min && value <= max) return true;
    hair_complain(BENCH_TOOL, "--%s is %s, not a whole number in [%u, %u]", option, text, min, max);
    return false;
}

// Parse a range of scenes, N or N-M with both ends included.
static bool parse_range(const char* option, const char* text, struct bench_options* out)
{
    char first[16] = "";
    uint32_t last;
    const char* dash = strchr(text, '-');
    snprintf(first, sizeof first, "%.*s", (int)(dash ? dash - text : 12), text);
    if (!parse_count(option, first, 0, MAX_SCENE, &out->scene)) return false;
    if (!parse_count(option, dash ? dash + 1 : first, out->scene, MAX_SCENE, &last)) return false;
    out->scenes = last - out->scene + 1;
    return true;
}

static bool parse_name(const char* option, const char* text, const char* const* names, uint32_t* out)
{
    for (*out = 0; names[*out]; ++*out)
        if (!strcmp(text, names[*out])) return true;
    hair_complain(BENCH_TOOL, "--%s is %s, which it cannot be", option, text);
    return false;
}

static bool take(const struct row* row, const char* value, struct bench_options* out)
{
    uint32_t number = 0;
    switch (row->option) {
    case JSON: out->json = value; return hair_output_has_ending(BENCH_TOOL, value, ".json");
    case CSV: out->csv = value; return hair_output_has_ending(BENCH_TOOL, value, ".csv");
    case QUICK: out->quick = true; return true;
    case CASE: out->only_case = value; return true;
    case METHOD: out->only_method = value; return parse_name(row->name, value, methods, &number);
    case MAPPING:
        if (!parse_name(row->name, value, mappings, &number)) return false;
        out->mapping = (hair_thread_mapping)number;
        return true;
    case STRANDS: return parse_count(row->name, value, 1, 262144, &out->strands);
    case SIZE: return parse_count(row->name, value, 16, 4096, &out->size);
    case SCENE: return parse_range(row->name, value, out);
    case DEVICE:
        if (!parse_count(row->name, value, 0, 1000, &number)) return false;
        out->device = (int)number;
        return true;
    case QUIET: out->quiet = true; return true;
    default: out->verbose = true; return true;
    }
}

static int take_suite(int count, char** operands, struct bench_options* out)
{
    if (count == 0) hair_complain(BENCH_TOOL, "no suite is given");
    if (count > 1) hair_complain(BENCH_TOOL, "%s is one argument too many", operands[1]);
    if (count != 1) return misuse();
    for (size_t i = 0; i < SUITE_COUNT; ++i)
        if (!strcmp(operands[0], suites[i]->name)) out->suite = suites[i];
    if (!out->suite) {
        hair_complain(BENCH_TOOL, "there is no suite %s", operands[0]);
        return misuse();
    }
    if (out->json && out->csv && !strcmp(out->json, "-") && !strcmp(out->csv, "-")) {
        hair_complain(BENCH_TOOL, "only one of --json - and --csv - can have the standard output");
        return HAIR_EXIT_USAGE;
    }
    return -1;
}

int bench_parse(int count, char** arguments, struct bench_options* out)
{
    struct option table[ROW_COUNT + 1];
    memset(table, 0, sizeof table);
    for (int i = 0; i < ROW_COUNT; ++i)
        table[i] =
            (struct option){rows[i].name, rows[i].argument ? required_argument : no_argument, NULL, 1000 + i};
    *out = (struct bench_options){.device = -1};
    optind = opterr = 0;
    for (int found; (found = getopt_long(count, arguments, "h", table, NULL)) != -1;) {
        if (found == '?') {
            hair_complain_option(BENCH_TOOL, arguments[optind - 1]);
            return misuse();
        }
        if (found == 'h' || rows[found - 1000].option == 'h') return print_help();
        const struct row* row = &rows[found - 1000];
        if (row->option == VERSION) return print_version();
        if (!take(row, optarg, out)) return misuse();
    }
    return take_suite(count - optind, arguments + optind, out);
}
