// paths.c - Suite `paths`, the fastest drawing path on this driver. lib/draw/paths.inl stores its
// rows, which HAIR_RENDER_PATH_AUTO uses.
//
// The paths take turns, so that a slowdown of the machine affects all of them. On a software
// rasterizer the CPU time of all threads is measured, because other processes affect it less.
#include "lib/draw/render_path.h"
#include "tools/bench/studio.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <string.h>
#include <time.h>

#define SIZE 720
#define SIZE_OF_SOFTWARE 256
#define STRANDS_OF_SOFTWARE 6000
#define AWAY 4 // distance of kinds with level of detail, as a multiple of the scene's distance
#define ROUNDS 9

static const char* const columns[] = {"case",   "method",  "strands", "size", "samples",
                                      "away",   "frames",  "runs",    "ms",   "ms_min",
                                      "ms_max", "fastest", "auto",    "pass", NULL};

static const struct way {
    const char* name;
    hair_render_path path;
} ways[] = {{"tessellation", HAIR_RENDER_PATH_TESSELLATION},
            {"procedural", HAIR_RENDER_PATH_PROCEDURAL},
            {"cached", HAIR_RENDER_PATH_CACHED},
            {"compute", HAIR_RENDER_PATH_COMPUTE}};

// A column of lib/draw/paths.inl.
static const struct kind {
    const char* name;
    hair_primitive primitive;
    bool has_lod, of_depth; // `of_depth` measures the depth pass instead of the colour pass
} kinds[] = {{"ribbons", HAIR_PRIMITIVE_RIBBONS, false, false},
             {"lines", HAIR_PRIMITIVE_LINES, false, false},
             {"ribbons, lod", HAIR_PRIMITIVE_RIBBONS, true, false},
             {"lines, lod", HAIR_PRIMITIVE_LINES, true, false},
             {"depth", HAIR_PRIMITIVE_RIBBONS, false, true}};

enum { WAYS = sizeof ways / sizeof *ways, KINDS = sizeof kinds / sizeof *kinds };

struct scene {
    struct bench* bench;
    struct bench_studio studio;
    bool alive, refused;
};

static bool ensure(struct scene* scene)
{
    const struct bench_options* options = &scene->bench->options;
    bool software = scene->bench->software;
    uint32_t size = software ? SIZE_OF_SOFTWARE : SIZE, strands = software ? STRANDS_OF_SOFTWARE : 0;
    if (scene->alive || scene->refused) return scene->alive;
    struct bench_studio_desc desc = {.scene = "demo",
                                     .size = options->size ? options->size : size,
                                     .followers = options->strands ? options->strands : strands};
    scene->alive = bench_studio_make(scene->bench, &desc, &scene->studio);
    scene->refused = !scene->alive;
    scene->studio.bare = true;
    return scene->alive;
}

static double now(const struct bench* bench)
{
    return bench->software ? 1e3 * (double)clock() / CLOCKS_PER_SEC : hair_now();
}

// Draw the picture by `path` and its shadow map by HAIR_RENDER_PATH_AUTO, or vice versa if
// kind->of_depth. Hair moves between frames, so that vertices that a path caches are recomputed.
static bool run_frames(struct scene* scene, const struct kind* kind, hair_render_path path, uint32_t frames,
                       double* ms)
{
    struct bench_studio* studio = &scene->studio;
    struct bench_shot shot = bench_studio_shot(studio);
    shot.samples = 4;
    shot.view.render_path = kind->of_depth ? HAIR_RENDER_PATH_AUTO : path;
    shot.map_path = kind->of_depth ? path : HAIR_RENDER_PATH_AUTO;
    shot.map_apart = true;
    shot.view.primitive = kind->primitive;
    shot.has_lod = kind->has_lod;
    shot.away = kind->has_lod ? AWAY : 1;
    if (!bench_studio_set(studio, &shot)) return false;
    glFinish();
    double start = now(scene->bench);
    for (uint32_t i = 0; i < frames; ++i)
        if (!bench_studio_step(studio, NULL) || !bench_studio_draw(studio, NULL)) return false;
    glFinish();
    *ms = (now(scene->bench) - start) / frames;
    return true;
}

// Return the name of the pass that drew, from the library's report.
static const char* drawn_by(struct scene* scene, const struct kind* kind)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[32];
    uint32_t count = 0;
    if (hair_report(scene->studio.hair, true, &info, rows, sizeof *rows, 32, &count)) return "";
    for (uint32_t i = 0; i < count && i < 32; ++i)
        if (!strcmp(rows[i].stage, kind->of_depth ? "depth" : "color") && rows[i].pass) return rows[i].pass;
    return "";
}

static bool compare(struct scene* scene, const struct kind* kind)
{
    double ms[WAYS][ROUNDS], first;
    struct bench_times times[WAYS];
    const char *passes[WAYS], *taken; // `taken` is the pass that HAIR_RENDER_PATH_AUTO chose
    bool software = scene->bench->software;
    uint32_t frames = software ? 1 : 60, rounds = scene->bench->options.quick ? 2 : ROUNDS, fastest = 0;
    if (!ensure(scene)) return false;
    for (uint32_t i = 0; i < WAYS; ++i) { // the first runs compile shaders
        if (!run_frames(scene, kind, ways[i].path, 1, &first)) return false;
        passes[i] = drawn_by(scene, kind);
    }
    if (!run_frames(scene, kind, HAIR_RENDER_PATH_AUTO, 1, &first)) return false;
    taken = drawn_by(scene, kind);
    for (uint32_t k = 0; k < rounds; ++k)
        for (uint32_t i = 0; i < WAYS; ++i)
            if (!run_frames(scene, kind, ways[i].path, frames, &ms[i][k])) return false;
    for (uint32_t i = 0; i < WAYS; ++i) {
        times[i] = bench_times_of(ms[i], rounds);
        if (times[i].ms_min < times[fastest].ms_min) fastest = i;
    }
    for (uint32_t i = 0; i < WAYS; ++i) {
        json_t* row = bench_rows_add(&scene->bench->rows);
        bench_set_text(row, "case", kind->name);
        bench_set_text(row, "method", ways[i].name);
        bench_set_count(row, "strands", scene->studio.info.follower_count);
        bench_set_count(row, "size", scene->studio.size);
        bench_set_count(row, "samples", scene->studio.shot.samples);
        bench_set_number(row, "away", (double)scene->studio.shot.away);
        bench_set_count(row, "frames", frames);
        bench_set_count(row, "runs", times[i].runs);
        bench_set_number(row, "ms", times[i].ms);
        bench_set_number(row, "ms_min", times[i].ms_min);
        bench_set_number(row, "ms_max", times[i].ms_max);
        bench_set_flag(row, "fastest", i == fastest);
        bench_set_flag(row, "auto", !strcmp(passes[i], taken));
        bench_set_text(row, "pass", passes[i]);
    }
    return true;
}

static void run_suite(struct bench* bench)
{
    struct scene scene = {.bench = bench};
    for (size_t i = 0; i < KINDS; ++i)
        if (bench_begin(bench, kinds[i].name, "all") && !compare(&scene, &kinds[i]))
            bench_refuse(bench, kinds[i].name, "all");
    if (scene.alive) bench_studio_free(&scene.studio);
}

const struct bench_suite bench_paths = {"paths", "which path of drawing is the fastest on this driver",
                                        columns, run_suite};
