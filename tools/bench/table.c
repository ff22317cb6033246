// table.c - Suite `table`, the eight cells of the performance table of Tariq 2010 next to the
// paper's figures. They are from a GTX 480 in 2010. Times are measured as a viewer sees them, from
// the first call to glFinish, over many frames.
//
// A cell that draws includes everything that a frame of hair needs. Followers are pushed out of
// colliders, the shadow map, light and colour are computed, and samples are resolved. The head is
// not drawn. Pixels that neither contain nor contained hair are not cleared again, because clearing
// the whole picture could take longer than drawing distant hair. Near hair has no level of detail.
// Distant hair uses every level of detail, as in the paper. It has fewer, wider strands with fewer
// segments, a shadow map scaled down like the picture of the hair, and the minimum of substeps. The
// paper skipped whole frames. The paper does not state its distance. Here the hair is about 35
// pixels high for any picture size.
#include "lib/draw/render_path.h"
#include "tools/bench/picture.h"
#include "tools/bench/scene.h"
#include "tools/bench/studio.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

#define SIZE 720
#define SIZE_OF_SOFTWARE 256
#define AWAY 8 // factor of the near distance, for a picture of SIZE_OF_SOFTWARE
#define RATE_AWAY 0.0625f // value of hair_physics.substep_rate
#define SHOTS 4 // pictures that the distant comparison averages
#define WIND 2 // m/s
#define RATE 60 // frames per second of simulated time

static const char* const columns[] = {"case",      "method",  "solver",        "path",   "strands",
                                      "guides",    "size",    "samples",       "away",   "frames",
                                      "runs",      "ms",      "ms_min",        "ms_max", "fps",
                                      "paper_fps", "to_near", "paper_to_near", "flip",   NULL};

// A column of the table. Further columns use the default settings and the fastest path of this
// driver. In the paper, the second column had no tessellator, was simulated by stream output, and
// had no level of detail.
static const struct way {
    const char* name;
    hair_solver solver;
    hair_render_path path;
    double paper[4]; // fps by cell, 0 if there is none
    hair_thread_mapping mapping;
} ways[] = {
    {"tessellation, compute",
     HAIR_SOLVER_REDBLACK,
     HAIR_RENDER_PATH_TESSELLATION,
     {57, 77, 720, 930},
     HAIR_THREAD_MAPPING_AUTO},
    {"procedural, compute",
     HAIR_SOLVER_REDBLACK,
     HAIR_RENDER_PATH_PROCEDURAL,
     {44, 60, 624, 77},
     HAIR_THREAD_MAPPING_AUTO},
    {"procedural, feedback",
     HAIR_SOLVER_REDBLACK,
     HAIR_RENDER_PATH_PROCEDURAL,
     {44, 60, 624, 77},
     HAIR_THREAD_MAPPING_FEEDBACK},
    {"tessellation, direct",
     HAIR_SOLVER_DIRECT,
     HAIR_RENDER_PATH_TESSELLATION,
     {0, 0, 0, 0},
     HAIR_THREAD_MAPPING_AUTO},
    {"default", HAIR_SOLVER_DIRECT, HAIR_RENDER_PATH_AUTO, {0, 0, 0, 0}, HAIR_THREAD_MAPPING_AUTO},
};

// A row of the table.
static const struct cell {
    const char* name;
    bool simulates, draws, is_far;
} cells[] = {
    {"simulated with wind, drawn", true, true, false},
    {"drawn", false, true, false},
    {"simulated with wind", true, false, false},
    {"simulated with wind, drawn, far away", true, true, true},
};

enum { CELLS = sizeof cells / sizeof *cells };

struct column {
    const struct way* way;
    struct bench_studio studio;
    bool alive, refused;
    double near_fps; // 0 until measured
};

static bool ensure(struct bench* bench, struct column* column)
{
    if (column->alive || column->refused) return column->alive;
    uint32_t size = bench->software ? SIZE_OF_SOFTWARE : SIZE;
    struct bench_studio_desc desc = {.scene = "demo",
                                     .size = bench->options.size ? bench->options.size : size,
                                     .followers = bench->options.strands,
                                     .solver = column->way->solver,
                                     .mapping = column->way->mapping,
                                     .substep = column->way->solver == HAIR_SOLVER_REDBLACK ? 1.0 / RATE : 0};
    column->alive = bench_studio_make(bench, &desc, &column->studio);
    column->refused = !column->alive;
    if (!column->alive) return false;
    column->studio.bare = true;
    struct hair_settings* settings = &column->studio.scene.settings;
    settings->wind.velocity[0] = WIND;
    settings->physics.redblack.iterations = 20;
    settings->physics.sleep_threshold = 0; // Hair at rest in even wind would fall asleep.
    return !hair_set_physics(column->studio.hair, &settings->physics) &&
           !hair_set_wind(column->studio.hair, &settings->wind);
}

static bool set_rate(struct bench_studio* studio, float rate)
{
    studio->scene.settings.physics.substep_rate = rate;
    return !hair_set_physics(studio->hair, &studio->scene.settings.physics);
}

static bool run_frames(struct bench_studio* studio, const struct cell* cell, uint32_t frames, double* ms)
{
    glFinish();
    double start = hair_now();
    for (uint32_t i = 0; i < frames; ++i) {
        if (cell->simulates && !bench_studio_step(studio, NULL)) return false;
        if (cell->draws && !bench_studio_draw(studio, NULL)) return false;
    }
    glFinish();
    *ms = (hair_now() - start) / frames;
    return true;
}

// Set the i-th sample offset of a sequence of pictures (Roberts 2018).
static void shift(struct bench_shot* shot, int i)
{
    shot->jitter[0] = fmodf(0.7548777f * (float)i, 1) - 0.5f;
    shot->jitter[1] = fmodf(0.5698403f * (float)i, 1) - 0.5f;
}

static bool take(struct bench_studio* studio, struct bench_shot* shot, struct bench_picture* out)
{
    bool ok = bench_picture_make(studio->size, out);
    for (int i = 0; i < SHOTS && ok; ++i) {
        shift(shot, i);
        ok = bench_studio_set(studio, shot) && bench_studio_draw(studio, NULL) &&
             bench_studio_add(studio, out->rgba);
    }
    if (ok) bench_picture_finish(out, SHOTS, (double)studio->scene.exposure);
    return ok;
}

// Compute FLIP between the distant pictures with and without level of detail. Each is the mean of
// several pictures, because single pictures differ most in the strands that their samples hit.
static bool compare_far(struct bench_studio* studio, const struct bench_shot* shot, double* flip)
{
    struct bench_picture picture[2] = {{0}};
    struct hair_image_error error = {0};
    bool ok = true;
    studio->bare = false;
    for (int i = 0; i < 2 && ok; ++i) {
        struct bench_shot own = *shot;
        own.has_lod = i == 1;
        ok = take(studio, &own, &picture[i]);
    }
    ok = ok && bench_picture_cover(&picture[0]) &&
         bench_picture_compare(&picture[0], &picture[0], &picture[1], &error);
    *flip = error.flip;
    studio->bare = true;
    bench_picture_free(&picture[0]);
    bench_picture_free(&picture[1]);
    return ok;
}

static json_t* add_row(struct column* column, const struct cell* cell, uint32_t frames,
                       const struct bench_times* times)
{
    static const char* const paths[] = {"tessellation", "cached", "compute", "auto", "procedural"};
    const struct bench_studio* studio = &column->studio;
    const double* paper = column->way->paper;
    size_t number = (size_t)(cell - cells);
    double fps = 1000 / times->ms;
    json_t* row = bench_rows_add(&studio->bench->rows);
    if (number == 0) column->near_fps = fps;
    bench_set_text(row, "case", cell->name);
    bench_set_text(row, "method", column->way->name);
    bench_set_text(row, "solver", bench_solver_name(column->way->solver));
    bench_set_text(row, "path", paths[column->way->path]);
    bench_set_count(row, "strands", studio->info.follower_count);
    bench_set_count(row, "guides", studio->info.guide_count);
    bench_set_count(row, "size", studio->size);
    bench_set_count(row, "samples", studio->shot.samples);
    bench_set_number(row, "away", (double)studio->shot.away);
    bench_set_count(row, "frames", frames);
    bench_set_count(row, "runs", times->runs);
    bench_set_number(row, "ms", times->ms);
    bench_set_number(row, "ms_min", times->ms_min);
    bench_set_number(row, "ms_max", times->ms_max);
    bench_set_number(row, "fps", fps);
    if (paper[0] > 0) bench_set_number(row, "paper_fps", paper[number]);
    if (!cell->is_far) return row;
    if (column->near_fps > 0) bench_set_number(row, "to_near", fps / column->near_fps);
    if (paper[0] > 0) bench_set_number(row, "paper_to_near", paper[number] / paper[0]);
    return row;
}

static bool run_cell(struct bench* bench, struct column* column, const struct cell* cell)
{
    enum { MAX_RUNS = 9 };
    double ms[MAX_RUNS], passed = 0, enough = bench->options.quick ? 100 : 1500;
    uint32_t runs = 0, frames = bench->software ? (cell->draws ? 2 : 20) : 60;
    struct bench_times times;
    if (!ensure(bench, column)) return false;
    struct bench_shot shot = bench_studio_shot(&column->studio);
    shot.samples = 4;
    shot.view.render_path = column->way->path;
    shot.away = cell->is_far ? AWAY * (float)column->studio.size / SIZE_OF_SOFTWARE : 1;
    shot.has_lod = cell->is_far;
    if (!set_rate(&column->studio, cell->is_far ? RATE_AWAY : 1)) return false;
    if (!bench_studio_set(&column->studio, &shot)) return false;
    // The first frames compile shaders.
    if (!run_frames(&column->studio, cell, 2, &ms[0])) return false;
    for (double start = hair_now(); bench_times_want_more(runs, MAX_RUNS, passed, enough);
         passed = hair_now() - start)
        if (!run_frames(&column->studio, cell, frames, &ms[runs++])) return false;
    times = bench_times_of(ms, runs);
    double flip;
    json_t* row = add_row(column, cell, frames, &times);
    if (!cell->is_far) return true;
    if (!compare_far(&column->studio, &shot, &flip)) return false;
    bench_set_number(row, "flip", flip);
    return true;
}

static void run_suite(struct bench* bench)
{
    for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i) {
        struct column column = {.way = &ways[i]};
        for (size_t k = 0; k < CELLS; ++k)
            if (bench_begin(bench, cells[k].name, ways[i].name) && !run_cell(bench, &column, &cells[k]))
                bench_refuse(bench, cells[k].name, ways[i].name);
        if (column.alive) bench_studio_free(&column.studio);
    }
}

const struct bench_suite bench_table = {"table", "the performance table of Tariq 2010, measured here",
                                        columns, run_suite};
