// stats.c - Statistics of a capture and its timings, as JSON.
#define _POSIX_C_SOURCE 200809L
#include "tools/common/stats.h"
#include "tools/common/file.h"

#include <jansson.h>
#include <stdlib.h>
#include <time.h>

double hair_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

// Append a time. The time is dropped if memory runs out.
void hair_clock_add(struct hair_clock* clock, double ms)
{
    if (clock->count == clock->room) {
        uint32_t room = clock->room ? 2 * clock->room : 64;
        float* more = realloc(clock->ms, room * sizeof *more);
        if (!more) return;
        clock->ms = more;
        clock->room = room;
    }
    clock->ms[clock->count++] = (float)ms;
}

static int compare(const void* a, const void* b)
{
    float x = *(const float*)a, y = *(const float*)b;
    return (x > y) - (x < y);
}

static json_t* clock_row(const char* name, const char* method, const struct hair_clock* clock)
{
    if (!clock->count) return NULL;
    qsort(clock->ms, clock->count, sizeof *clock->ms, compare);
    return json_pack("{s:s, s:s, s:f, s:f, s:f, s:i}", "case", name, "method", method, "ms",
                     (double)clock->ms[clock->count / 2], "ms_min", (double)clock->ms[0], "ms_max",
                     (double)clock->ms[clock->count - 1], "runs", clock->count);
}

// Append the passes that ran.
static void add_passes(json_t* rows, const char* name, hair_context* context)
{
    uint32_t count = hair_get_timings(context, NULL, 0);
    hair_timing* passes = calloc(count, sizeof *passes);
    if (passes) hair_get_timings(context, passes, count);
    for (uint32_t i = 0; passes && i < count; ++i)
        if (passes[i].runs)
            json_array_append_new(rows, json_pack("{s:s, s:s, s:f, s:f, s:i}", "case", name, "method",
                                                  passes[i].pass, "ms", (double)passes[i].ms, "total_ms",
                                                  passes[i].total_ms, "runs", passes[i].runs));
    free(passes);
}

static json_t* rows_of(const struct hair_stats* stats, hair_context* context)
{
    json_t* rows = json_array();
    json_t* wall[2] = {clock_row(stats->name, "step", &stats->step),
                       clock_row(stats->name, "draw", &stats->draw)};
    for (int i = 0; i < 2; ++i)
        if (wall[i]) json_array_append_new(rows, wall[i]);
    add_passes(rows, stats->name, context);
    return rows;
}

// Return the library's report of all work in the last frame.
static json_t* report_of(hair_instance* hair)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[64];
    uint32_t count = 0;
    json_t* works = json_array();
    if (hair_report(hair, true, &info, rows, sizeof *rows, 64, &count)) count = 0;
    for (uint32_t i = 0; i < count && i < 64; ++i)
        json_array_append_new(works, json_pack("{s:s, s:s, s:s?, s:i, s:f, s:I}", "stage", rows[i].stage,
                                               "skip_reason", hair_skip_reason_string(rows[i].skip_reason),
                                               "pass", rows[i].pass, "passes", rows[i].runs, "ms",
                                               (double)rows[i].ms, "bytes", (json_int_t)rows[i].bytes));
    return json_pack("{s:i, s:f, s:I, s:o}", "frame", info.frame, "ms", (double)info.ms, "bytes",
                     (json_int_t)info.bytes, "stages", works);
}

static json_t* solver_stats_of(const hair_solver_stats* solver_stats)
{
    return json_pack("{s:i, s:i, s:i, s:i, s:f, s:i, s:f, s:f, s:i, s:i, s:f, s:i, s:f, s:i, s:i, s:f, s:i}",
                     "euler_fallbacks", solver_stats->euler_fallbacks, "follow_fallbacks",
                     solver_stats->follow_fallbacks, "reset", solver_stats->reset, "stiffened",
                     solver_stats->stiffened, "max_stiffening", (double)solver_stats->max_stiffening,
                     "sagging", solver_stats->sagging, "farthest_sag", (double)solver_stats->farthest_sag,
                     "substep", (double)solver_stats->substep, "parts", solver_stats->parts, "softened",
                     solver_stats->softened, "softest", (double)solver_stats->softest, "restless",
                     solver_stats->restless, "fastest", (double)solver_stats->fastest, "gaining",
                     solver_stats->gaining, "overstretched", solver_stats->overstretched, "stretch",
                     (double)solver_stats->stretch, "overextended", solver_stats->overextended);
}

static json_t* groom_of(const hair_groom_info* groom)
{
    const hair_import_stats* repairs = &groom->import_stats;
    json_t* mended =
        json_pack("{s:i, s:i, s:i, s:i, s:i}", "dropped_single", repairs->dropped_single, "dropped_short",
                  repairs->dropped_short, "removed_nonfinite", repairs->removed_nonfinite, "removed_repeated",
                  repairs->removed_repeated, "resampled", repairs->resampled);
    return json_pack("{s:i, s:i, s:i, s:i, s:i, s:o}", "strands", groom->strand_count, "guides",
                     groom->guide_count, "guide_vertices", groom->guide_vertex_count, "followers",
                     groom->follower_count, "patches", groom->patch_count, "import_stats", mended);
}

bool hair_stats_write(const char* tool, const char* path, const struct hair_stats* stats,
                      hair_context* context, hair_instance* hair)
{
    char version[32];
    uint32_t number = hair_version();
    snprintf(version, sizeof version, "%u.%u.%u", number / 10000, number / 100 % 100, number % 100);
    json_t* root = json_pack("{s:s, s:s, s:s, s:[i,i], s:[i,i], s:o, s:o, s:o, s:o}", "suite", "capture",
                             "version", version, "renderer", stats->renderer, "size", stats->width,
                             stats->height, "frames", stats->first, stats->end, "groom",
                             groom_of(&stats->groom), "solver_stats", solver_stats_of(&stats->solver_stats),
                             "report", report_of(hair), "rows", rows_of(stats, context));
    struct hair_output output;
    bool ok = root && hair_output_open(tool, path, &output);
    if (ok) {
        json_dumpf(root, output.file, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
        fputc('\n', output.file);
        ok = hair_output_commit(&output);
    }
    json_decref(root);
    return ok;
}

void hair_stats_free(struct hair_stats* stats)
{
    free(stats->step.ms);
    free(stats->draw.ms);
}
