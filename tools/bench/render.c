// render.c - Suite `render`, run time against image error over drawing methods and levels of
// detail.
//
// The reference is the same hair at full detail with 1,024 samples per pixel. It is the mean of
// many pictures that are shifted by fractions of a pixel. Two halves of these pictures are averaged
// separately. An error is reported only if it is at least five times the difference between the
// halves.
#include "lib/draw/render_path.h"
#include "tools/bench/extent.h"
#include "tools/bench/picture.h"
#include "tools/bench/ground_truth.h"
#include "tools/bench/ribbons_vs_lines.h"
#include "tools/common/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define REFERENCE_SAMPLES 1024
#define REFERENCE_SEGMENTS 64
#define SIZE 512
#define SIZE_OF_SOFTWARE 256
#define STRANDS_OF_SOFTWARE 4500 // the density of 18,000 strands at 1,024 pixels
#define MAX_RADIUS 0.01f // maximum of hair_look.strand.radius, m
#define MIN_RATIO 5 // minimum ratio of a reported error to that of the reference

static const char* const columns[] = {
    "case",    "width",          "method",        "primitive",  "lod",     "segments",
    "samples", "msaa",           "supersample",   "size",       "strands", "radius",
    "ms",      "ms_min",         "ms_max",        "runs",       "flip",    "psnr",
    "pixels",  "coverage_error", "halves_differ", "to_ribbons", "front",   NULL};

// A case. Either a scene from some distance, or a scene with strands of a given width in pixels
// everywhere. The number of strands is chosen for a picture of 256 pixels per side, such that all
// widths cover about the same area.
static const struct subject {
    const char* name;
    const char* scene;
    float away;
    bool quick;
    float width; // in pixels, 0 uses the scene's width
    uint32_t strands; // 0 uses the scene's number
} subjects[] = {{"long", "still", 1, true, 0, 0},
                {"long far", "still", 4, false, 0, 0},
                {"curly", "curly", 1, false, 0, 0},
                {"0.08 px", "still", 1, false, 0.08f, 30000},
                {"0.125 px", "still", 1, false, 0.125f, 24000},
                {"0.25 px", "still", 1, false, 0.25f, 12000},
                {"0.5 px", "still", 1, true, 0.5f, 6000},
                {"1 px", "still", 1, false, 1, 3000}};

static const struct path {
    const char* name;
    hair_render_path path;
} paths[] = {{"tessellation", HAIR_RENDER_PATH_TESSELLATION},
             {"procedural", HAIR_RENDER_PATH_PROCEDURAL},
             {"cached", HAIR_RENDER_PATH_CACHED},
             {"compute", HAIR_RENDER_PATH_COMPUTE}};

static const struct primitive {
    const char* name;
    hair_primitive primitive;
    hair_coverage coverage;
} primitives[] = {{"ribbons", HAIR_PRIMITIVE_RIBBONS, HAIR_COVERAGE_MSAA},
                  {"lines", HAIR_PRIMITIVE_LINES, HAIR_COVERAGE_MSAA},
                  {"shares", HAIR_PRIMITIVE_RIBBONS, HAIR_COVERAGE_ALPHA}};

// Level of detail with fewer and wider strands. A fraction of 0 selects dynamic level of detail.
static const struct lod {
    const char* name;
    float fraction;
    bool quick;
} lods[] = {{"100 %", 1, true},
            {"50 %", 0.5f, false},
            {"25 %", 0.25f, true},
            {"10 %", 0.1f, false},
            {"dynamic", 0, true}};

// Segments of a strand, powers of two, and all numbers in the range of the close comparison.
enum { MIN_SEGMENTS = 4, FEWEST_OF_CLOSE = 8, MAX_OF_CLOSE = 32, FINE_SEGMENTS = 48, MAX_SEGMENTS = 64 };

// Samples of a pixel. Software rasterizers draw four pixels faster than one pixel with four
// samples.
static const struct samples {
    uint32_t msaa, supersample;
    bool quick, of_software;
} samples[] = {{1, 1, true, false}, {4, 1, true, false},  {8, 1, false, false}, {1, 2, true, true},
               {4, 2, true, false}, {8, 4, false, false}, {4, 4, false, false}};

#define COUNT(table) (sizeof(table) / sizeof *(table))

// Programs that have drawn before. On an H200 the draws of a program took up to four times as long
// for about a second.
struct warmth {
    bool has_drawn[COUNT(paths)][COUNT(primitives)][2];
};

#define WARM 1500 // Draws of a program before its time is measured, ms.

// The studio of a subject, and its reference.
struct scene {
    struct bench* bench;
    const struct subject* subject;
    struct warmth* warmth;
    struct bench_studio studio;
    bool alive, refused;
    uint32_t max_samples; // supported by OpenGL
    struct bench_ground_truth truth;
    double halves_differ;
    struct bench_comparison versus;
};

static uint32_t strands_of(const struct bench* bench, const struct subject* subject, uint32_t size)
{
    if (bench->options.strands) return bench->options.strands;
    if (subject->strands) return (uint32_t)((uint64_t)subject->strands * size / SIZE_OF_SOFTWARE);
    return bench->software ? STRANDS_OF_SOFTWARE * size / SIZE_OF_SOFTWARE : 0;
}

// Return a shot whose strands are widened such that fewer strands cover as much as all of the
// scene's strands.
static struct bench_shot shot_of(const struct scene* scene)
{
    struct bench_shot shot = bench_studio_shot(&scene->studio);
    shot.look.strand.radius = fminf(shot.look.strand.radius * scene->studio.fewer, MAX_RADIUS);
    shot.away = scene->subject->away;
    // Compute drawing, which is faster on GPUs, supports no lines.
    shot.map_fits = scene->bench->software;
    if (scene->subject->width > 0) {
        shot.look.strand.radius =
            0.5f * scene->subject->width / bench_extent_scale(&scene->studio, shot.away);
        shot.look.strand.taper = hair_curve_line(1, 1);
    }
    return shot;
}

static bool find_truth(struct scene* scene)
{
    struct hair_image_error error;
    struct bench_ground_truth* ground_truth = &scene->truth;
    struct bench_shot shot = shot_of(scene);
    shot.look.strand.segments = REFERENCE_SEGMENTS;
    bool ok =
        bench_ground_truth_create(scene->studio.size, ground_truth) &&
        bench_ground_truth_render(&scene->studio, &shot, REFERENCE_SAMPLES, 0, ground_truth) &&
        bench_picture_cover(&ground_truth->whole) &&
        bench_picture_compare(&ground_truth->whole, &ground_truth->half[0], &ground_truth->half[1], &error);
    if (ok) scene->halves_differ = error.flip;
    return ok;
}

// Create the studio and the reference on the first call. A failure is remembered, and each row is
// refused.
static bool ensure(struct scene* scene)
{
    if (scene->alive || scene->refused) return scene->alive;
    uint32_t size = scene->bench->software ? SIZE_OF_SOFTWARE : SIZE;
    if (scene->bench->options.quick) size /= 2;
    if (scene->bench->options.size) size = scene->bench->options.size;
    struct bench_studio_desc desc = {.scene = scene->subject->scene,
                                     .size = size,
                                     .followers = strands_of(scene->bench, scene->subject, size)};
    scene->max_samples = bench_max_samples();
    scene->alive = bench_studio_make(scene->bench, &desc, &scene->studio) && find_truth(scene);
    scene->refused = !scene->alive;
    return scene->alive;
}

// Rows --------------------------------------------------------------------------------------------

struct setting {
    const struct path* path;
    const struct primitive* primitive;
    const struct lod* lod;
    uint32_t segments;
    const struct samples* samples;
};

static bool add_row(struct scene* scene, const struct setting* setting, const struct bench_times* times,
                    const struct hair_image_error* error, double coverage)
{
    json_t* row = bench_rows_add(&scene->bench->rows);
    uint32_t side = setting->samples->supersample;
    bench_set_text(row, "case", scene->subject->name);
    if (scene->subject->width > 0) bench_set_number(row, "width", (double)scene->subject->width);
    bench_set_text(row, "method", setting->path->name);
    bench_set_text(row, "primitive", setting->primitive->name);
    bench_set_text(row, "lod", setting->lod->name);
    bench_set_count(row, "segments", setting->segments);
    bench_set_count(row, "samples", setting->samples->msaa * side * side);
    bench_set_count(row, "msaa", setting->samples->msaa);
    bench_set_count(row, "supersample", side);
    bench_set_count(row, "size", scene->studio.size);
    bench_set_count(row, "strands", scene->studio.info.follower_count);
    bench_set_number(row, "radius", (double)scene->studio.shot.look.strand.radius);
    bench_set_number(row, "ms", times->ms);
    bench_set_number(row, "ms_min", times->ms_min);
    bench_set_number(row, "ms_max", times->ms_max);
    bench_set_count(row, "runs", times->runs);
    bench_set_count(row, "pixels", error->pixels);
    bench_set_number(row, "coverage_error", coverage);
    bench_set_number(row, "halves_differ", scene->halves_differ);
    if (error->flip < MIN_RATIO * scene->halves_differ) return true;
    bench_set_number(row, "flip", error->flip);
    bench_set_number(row, "psnr", error->psnr);
    struct bench_contender contender = {scene->studio.shot, times->ms_min, error->flip, row};
    return bench_comparison_add(&scene->versus, &contender);
}

// Draw for some time by programs that have not drawn before.
static bool warm_up(struct scene* scene, const struct setting* setting)
{
    bool has_lod = setting->lod != lods;
    bool* has_drawn =
        &scene->warmth->has_drawn[setting->path - paths][setting->primitive - primitives][has_lod];
    bool is_warm = *has_drawn || scene->bench->software;
    *has_drawn = true;
    return is_warm || bench_studio_warm_up(&scene->studio, WARM);
}

static bool look(struct scene* scene, const struct setting* setting)
{
    struct bench_shot shot = shot_of(scene);
    const struct bench_picture* ground_truth = &scene->truth.whole;
    struct bench_picture picture;
    struct bench_times times;
    struct hair_image_error error;
    shot.view.render_path = setting->path->path;
    shot.view.primitive = setting->primitive->primitive;
    shot.view.coverage = setting->primitive->coverage;
    shot.look.strand.segments = setting->segments;
    shot.has_lod = setting->lod->fraction < 1;
    shot.lod.per_patch = setting->lod->fraction > 0 ? 0 : 1;
    if (setting->lod->fraction > 0) shot.lod.strand_fraction = setting->lod->fraction;
    shot.samples = setting->samples->msaa;
    shot.supersample = setting->samples->supersample;
    if (!bench_picture_make(scene->studio.size, &picture)) return false;
    double enough = scene->bench->options.quick ? 50 : scene->bench->software ? 300 : 30;
    bool ok = bench_studio_set(&scene->studio, &shot) && warm_up(scene, setting) &&
              bench_studio_time(&scene->studio, enough, &times) &&
              bench_studio_add(&scene->studio, picture.rgba);
    if (ok) bench_picture_finish(&picture, 1, (double)scene->studio.scene.exposure);
    ok = ok && bench_picture_compare(ground_truth, ground_truth, &picture, &error);
    ok = ok && add_row(scene, setting, &times, &error, picture.coverage / ground_truth->coverage - 1);
    bench_picture_free(&picture);
    return ok;
}

static bool is_between(uint32_t segments)
{
    return (segments & (segments - 1)) != 0;
}

// Return whether ribbons of the compute rasteriser are wanted with many segments, for which
// software rasterizers take too long. With 32 segments, chords of wavy strands are farther from the
// strand than the strand is wide.
static bool is_fine(const struct bench* bench, const struct setting* setting)
{
    return !bench->software && !bench->options.quick && setting->path->path == HAIR_RENDER_PATH_COMPUTE &&
           setting->primitive == primitives && setting->lod == lods &&
           (setting->segments == FINE_SEGMENTS || setting->segments == MAX_SEGMENTS);
}

static bool is_quick(uint32_t segments)
{
    return segments == 8 || segments == 32;
}

// Return whether a setting is part of the close comparison. It combines all numbers of strands with
// all numbers of segments, so that each setting has another one of about equal run time. It uses
// the path that software rasterizers use. Strands of at least half a pixel, where one-pixel lines
// are nearly as good, use every number of segments.
static bool is_wanted_closely(const struct bench* bench, const struct subject* subject,
                              const struct setting* setting)
{
    bool every = subject->width >= 0.5f && setting->primitive == primitives && setting->lod == lods;
    return bench->software && !bench->options.quick && setting->path->path == HAIR_RENDER_PATH_CACHED &&
           setting->lod->fraction > 0 && setting->segments >= FEWEST_OF_CLOSE &&
           setting->segments <= MAX_OF_CLOSE &&
           (setting->samples->supersample == 1 || setting->samples->of_software) &&
           (every || setting->segments % 4 == 0);
}

// Return whether a setting of a case with given width is wanted. These cases compare numbers of
// strands and segments with three paths. With many samples, only one parameter is varied at a time.
static bool is_wanted_of_width(const struct bench* bench, const struct subject* subject,
                               const struct setting* setting)
{
    bool usual = setting->segments == 32, all = setting->lod == lods;
    if (is_wanted_closely(bench, subject, setting) || is_fine(bench, setting)) return true;
    if (is_between(setting->segments)) return false;
    if (setting->path->path == HAIR_RENDER_PATH_PROCEDURAL || setting->lod->fraction < 0.25f) return false;
    bool quick = usual && setting->lod->quick && setting->samples->quick &&
                 (setting->path == paths || setting->path->path == HAIR_RENDER_PATH_COMPUTE ||
                  setting->primitive->coverage == HAIR_COVERAGE_ALPHA);
    if (bench->options.quick && !quick) return false;
    if (setting->samples->supersample > 1) return usual && all;
    return all ? setting->segments >= FEWEST_OF_CLOSE && setting->segments <= MAX_OF_CLOSE : usual;
}

// Return whether to measure compute drawing. Only full-detail ribbons with sample coverage are
// drawn by compute. Quick runs on software rasterizers skip compute drawing, because it has no
// benefit there.
static bool is_computed(const struct bench* bench, const struct setting* setting)
{
    if (bench->options.quick && bench->software) return false;
    return setting->primitive == primitives && setting->lod == lods;
}

// Return whether a setting is wanted. One path and compute drawing measure all settings. The other
// paths draw equal pictures and measure fewer. Blended coverage has one path only and replaces
// additional samples.
static bool is_wanted(const struct bench* bench, const struct subject* subject, const struct setting* setting)
{
    bool fractions = setting->primitive->coverage == HAIR_COVERAGE_ALPHA;
    if (setting->samples->of_software && (!bench->software || setting->primitive != primitives)) return false;
    if (fractions && (setting->path->path != HAIR_RENDER_PATH_CACHED || setting->samples->supersample > 1))
        return false;
    if (setting->path->path == HAIR_RENDER_PATH_COMPUTE && !is_computed(bench, setting)) return false;
    if (subject->width > 0) return is_wanted_of_width(bench, subject, setting);
    if (is_between(setting->segments)) return false;
    bool whole = setting->path == paths || setting->path->path == HAIR_RENDER_PATH_COMPUTE;
    return (!bench->options.quick && whole) ||
           (setting->lod->quick && is_quick(setting->segments) && setting->samples->quick);
}

static void measure(struct scene* scene, const struct setting* setting)
{
    struct bench* bench = scene->bench;
    if (!is_wanted(bench, scene->subject, setting) ||
        !bench_begin(bench, scene->subject->name, setting->path->name))
        return;
    // OpenGL supports fewer samples.
    if (ensure(scene) && setting->samples->msaa > scene->max_samples) return;
    if (!scene->alive || !look(scene, setting))
        bench_refuse(bench, scene->subject->name, setting->path->name);
}

static void measure_subject(struct bench* bench, const struct subject* subject, struct warmth* warmth)
{
    struct scene scene = {.bench = bench, .subject = subject, .warmth = warmth};
    // This order recreates framebuffers as rarely as possible.
    for (size_t n = 0; n < COUNT(samples); ++n)
        for (size_t p = 0; p < COUNT(paths); ++p)
            for (size_t k = 0; k < COUNT(primitives); ++k)
                for (size_t l = 0; l < COUNT(lods); ++l)
                    for (uint32_t s = MIN_SEGMENTS; s <= MAX_SEGMENTS; ++s) {
                        struct setting setting = {&paths[p], &primitives[k], &lods[l], s, &samples[n]};
                        measure(&scene, &setting);
                    }
    if (scene.alive && subject->width > 0 && !bench_comparison_finish(&scene.versus, &scene.studio))
        bench_refuse(bench, subject->name, "lines");
    bench_comparison_free(&scene.versus);
    bench_ground_truth_free(&scene.truth);
    if (scene.alive) bench_studio_free(&scene.studio);
}

static void run_suite(struct bench* bench)
{
    struct warmth warmth = {0};
    for (size_t i = 0; i < COUNT(subjects); ++i)
        if (subjects[i].quick || !bench->options.quick) measure_subject(bench, &subjects[i], &warmth);
    if (bench->planning) return;
    bench_mark_front(bench->rows.rows, "ms", "flip");
}

const struct bench_suite bench_render = {"render", "run time against image error, over ways to draw", columns,
                                         run_suite};
