// scale.c - Suite `scale`, time of a step and of a picture against the numbers of guides and
// followers.
#include "tools/bench/scene.h"
#include "tools/bench/studio.h"
#include "tools/common/stats.h"

#include <math.h>

#define SIZE 256

static const char* const columns[] = {
    "case",        "method",  "guides",       "vertices",        "followers", "segments",
    "size",        "ms_step", "ms_step_min",  "ms_step_max",     "ms_draw",   "ms_draw_min",
    "ms_draw_max", "frames",  "us_per_guide", "us_per_follower", NULL};

static const struct point {
    const char* name;
    uint32_t guides, followers;
    bool quick, small; // `small` means small enough for software rasterizers
} points[] = {
    {"guides", 64, 4096, true, true},       {"guides", 166, 4096, false, true},
    {"guides", 512, 4096, true, true},      {"guides", 2048, 4096, false, true},
    {"guides", 4096, 4096, false, false},   {"followers", 166, 1024, true, true},
    {"followers", 166, 4096, true, true},   {"followers", 166, 16384, false, true},
    {"followers", 166, 65536, false, true}, {"followers", 166, 262144, false, false},
};

static void add_row(const struct bench_studio* studio, const struct point* point, struct bench_times step,
                    struct bench_times draw)
{
    const hair_groom_info* info = &studio->info;
    json_t* row = bench_rows_add(&studio->bench->rows);
    bench_set_text(row, "case", point->name);
    bench_set_text(row, "method", bench_solver_name(studio->scene.settings.desc.solver));
    bench_set_count(row, "guides", info->guide_count);
    bench_set_number(row, "vertices", (double)info->guide_vertex_count / info->guide_count);
    bench_set_count(row, "followers", info->follower_count);
    bench_set_count(row, "segments", studio->shot.look.strand.segments);
    bench_set_count(row, "size", studio->size);
    bench_set_number(row, "ms_step", step.ms);
    bench_set_number(row, "ms_step_min", step.ms_min);
    bench_set_number(row, "ms_step_max", step.ms_max);
    bench_set_number(row, "ms_draw", draw.ms);
    bench_set_number(row, "ms_draw_min", draw.ms_min);
    bench_set_number(row, "ms_draw_max", draw.ms_max);
    bench_set_count(row, "frames", step.runs);
    bench_set_number(row, "us_per_guide", 1000 * step.ms / info->guide_count);
    bench_set_number(row, "us_per_follower", 1000 * draw.ms / info->follower_count);
}

// Simulate and draw frames of a head that shakes.
static bool run(struct bench_studio* studio, const struct point* point)
{
    enum { MAX_FRAMES = 60 };
    double step[MAX_FRAMES], draw[MAX_FRAMES], passed = 0;
    double enough = studio->bench->options.quick ? 100 : 1000;
    uint32_t frames = 0;
    struct bench_shot shot = bench_studio_shot(studio);
    shot.samples = 4;
    if (!bench_studio_set(studio, &shot)) return false;
    for (int i = 0; i < 2; ++i) // the first frames compile shaders
        if (!bench_studio_step(studio, NULL) || !bench_studio_draw(studio, NULL)) return false;
    for (double start = hair_now(); bench_times_want_more(frames, MAX_FRAMES, passed, enough); ++frames) {
        if (!bench_studio_step(studio, &step[frames]) || !bench_studio_draw(studio, &draw[frames]))
            return false;
        passed = hair_now() - start;
    }
    add_row(studio, point, bench_times_of(step, frames), bench_times_of(draw, frames));
    return true;
}

static void measure(struct bench* bench, const struct point* point)
{
    struct bench_studio studio;
    const char* method = bench_solver_name(HAIR_SOLVER_DIRECT);
    struct bench_studio_desc desc = {.scene = "demo",
                                     .size = bench->options.size ? bench->options.size : SIZE,
                                     .guides = point->guides,
                                     .followers = point->followers,
                                     .solver = HAIR_SOLVER_DIRECT};
    if (!bench_begin(bench, point->name, method) || (bench->software && !point->small)) return;
    if (!bench_studio_make(bench, &desc, &studio)) {
        bench_refuse(bench, point->name, method);
        return;
    }
    if (!run(&studio, point)) bench_refuse(bench, point->name, method);
    bench_studio_free(&studio);
}

static void run_suite(struct bench* bench)
{
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i)
        if (points[i].quick || !bench->options.quick) measure(bench, &points[i]);
}

const struct bench_suite bench_scale = {"scale", "time of a step and a picture, by guides and followers",
                                        columns, run_suite};
