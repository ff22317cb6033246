// lod.c - Suite `lod`, thinned or distant hair against full detail. The suite measures coverage,
// colour, temporal stability of a walk away from the hair, and speed far away.
#include "tools/bench/picture.h"
#include "tools/bench/studio.h"
#include "tools/bench/flicker.h"
#include "tools/bench/lod_color.h"
#include "tools/common/file.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>

#define SIZE 256
#define FRAMES 300 // frames of the walk
#define FAR 16 // end of the walk, as a multiple of the start distance
#define AWAY 8 // distance of the case `far`, as a multiple of the scene's distance

// clang-format off
static const char* const columns[] = {
    "case", "method", "scene", "strands", "size", "samples", "away", "frames", "coverage", "flip",
    "flip_without", "flip_more", "segments_from", "segments", "fewer_times", "between", "between_truth",
    "between_halves", "calm", "calm_most", "ms_near", "ms", "rate", "light", "red", "green", "blue",
    "color_error", "limit", "pass", NULL};
// clang-format on

static const char* const scenes[] = {"still", "short", "afro"};
static const float fractions[] = {0.5f, 0.2f, 0.1f, 0.05f};

// A scene whose studio is created when the first row needs it.
struct scene {
    struct bench* bench;
    const char* name;
    struct bench_studio studio;
    bool alive, refused;
};

static bool ensure(struct scene* scene)
{
    const struct bench_options* options = &scene->bench->options;
    if (scene->alive || scene->refused) return scene->alive;
    struct bench_studio_desc desc = {
        .scene = scene->name, .size = options->size ? options->size : SIZE, .followers = options->strands};
    scene->alive = bench_studio_make(scene->bench, &desc, &scene->studio);
    scene->refused = !scene->alive;
    scene->studio.counts = true;
    return scene->alive;
}

static struct bench_shot shot_of(const struct scene* scene)
{
    struct bench_shot shot = bench_studio_shot(&scene->studio);
    shot.samples = 4;
    return shot;
}

static bool take(struct bench_studio* studio, const struct bench_shot* shot, struct bench_picture* out)
{
    size_t values = 4 * (size_t)out->size * out->size;
    for (size_t i = 0; i < values; ++i) out->rgba[i] = 0;
    if (!bench_studio_set(studio, shot) || !bench_studio_draw(studio, NULL) ||
        !bench_studio_add(studio, out->rgba))
        return false;
    bench_picture_finish(out, 1, (double)studio->scene.exposure);
    return true;
}

static json_t* add_row(struct scene* scene, const char* name, const char* method)
{
    json_t* row = bench_rows_add(&scene->bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", method);
    bench_set_text(row, "scene", scene->name);
    bench_set_count(row, "strands", scene->studio.info.follower_count);
    bench_set_count(row, "size", scene->studio.size);
    bench_set_count(row, "samples",
                    scene->studio.shot.samples * scene->studio.shot.supersample *
                        scene->studio.shot.supersample);
    return row;
}

// Coverage ----------------------------------------------------------------------------------------

static bool compare_coverage(struct scene* scene, float fraction, const char* method)
{
    struct bench_picture full = {0}, thin = {0};
    struct hair_image_error error;
    if (!ensure(scene)) return false;
    struct bench_shot shot = shot_of(scene);
    shot.supersample = 4;
    bool ok = bench_picture_make(scene->studio.size, &full) &&
              bench_picture_make(scene->studio.size, &thin) && take(&scene->studio, &shot, &full) &&
              bench_picture_cover(&full);
    shot.has_lod = true;
    shot.lod.per_patch = false;
    shot.lod.strand_fraction = fraction;
    ok = ok && take(&scene->studio, &shot, &thin) && bench_picture_compare(&full, &full, &thin, &error);
    if (ok) {
        json_t* row = add_row(scene, "coverage", method);
        bench_set_number(row, "coverage", thin.coverage / full.coverage);
        bench_set_number(row, "flip", error.flip);
    }
    bench_picture_free(&full);
    bench_picture_free(&thin);
    return ok;
}

static void measure_coverage(struct bench* bench)
{
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes && (i == 0 || !bench->options.quick); ++i) {
        struct scene scene = {.bench = bench, .name = scenes[i]};
        for (size_t k = 0; k < sizeof fractions / sizeof *fractions; ++k) {
            char method[16];
            snprintf(method, sizeof method, "%g %%", 100 * (double)fractions[k]);
            if (bench_begin(bench, "coverage", method) && !compare_coverage(&scene, fractions[k], method))
                bench_refuse(bench, "coverage", method);
        }
        if (scene.alive) bench_studio_free(&scene.studio);
    }
}

// The walk ----------------------------------------------------------------------------------------

// Pictures with and without level of detail, of the previous and the current frame.
struct walk {
    struct bench_picture picture[2][2];
    double flip, flip_without, flip_more; // maxima
    uint64_t first, last; // segments drawn with level of detail, first and last
};

static bool walk_on(struct scene* scene, struct walk* walk, uint32_t frame, uint32_t frames)
{
    struct bench_shot shot = shot_of(scene);
    struct hair_image_error with, without;
    shot.away = powf(FAR, (float)frame / (float)(frames - 1));
    for (int i = 0; i < 2; ++i) {
        struct bench_picture before = walk->picture[i][0];
        walk->picture[i][0] = walk->picture[i][1];
        walk->picture[i][1] = before;
        shot.has_lod = i == 0;
        if (!take(&scene->studio, &shot, &walk->picture[i][1])) return false;
        if (i == 0) walk->last = scene->studio.primitives / 2; // two triangles per ribbon segment
    }
    if (frame == 0) {
        walk->first = walk->last;
        return true;
    }
    // The picture shrinks towards the middle, therefore the previous frame's mask covers the
    // current frame too.
    struct bench_picture* before = &walk->picture[1][0];
    if (!bench_picture_cover(before)) return false;
    if (!bench_picture_compare(before, &walk->picture[0][0], &walk->picture[0][1], &with)) return false;
    if (!bench_picture_compare(before, before, &walk->picture[1][1], &without)) return false;
    walk->flip = fmax(walk->flip, with.flip);
    walk->flip_without = fmax(walk->flip_without, without.flip);
    walk->flip_more = fmax(walk->flip_more, with.flip - without.flip);
    return true;
}

static bool walk_away(struct scene* scene)
{
    struct walk walk = {.flip_more = -1};
    uint32_t frames = scene->bench->options.quick ? FRAMES / 25 : FRAMES;
    bool ok = ensure(scene);
    for (int i = 0; i < 4 && ok; ++i)
        ok = bench_picture_make(scene->studio.size, &walk.picture[i / 2][i % 2]);
    for (uint32_t k = 0; k < frames && ok; ++k) ok = walk_on(scene, &walk, k, frames);
    if (ok) {
        json_t* row = add_row(scene, "walk", "dynamic");
        bench_set_number(row, "away", FAR);
        bench_set_count(row, "frames", frames);
        bench_set_number(row, "flip", walk.flip);
        bench_set_number(row, "flip_without", walk.flip_without);
        bench_set_number(row, "flip_more", walk.flip_more);
        bench_set_count(row, "segments_from", walk.first);
        bench_set_count(row, "segments", walk.last);
        bench_set_number(row, "fewer_times", (double)walk.first / (double)walk.last);
    }
    for (int i = 0; i < 4; ++i) bench_picture_free(&walk.picture[i / 2][i % 2]);
    return ok;
}

// Far away ----------------------------------------------------------------------------------------

static bool look_from_far(struct scene* scene)
{
    struct bench_picture full = {0}, less = {0};
    struct bench_times near_by, far_off;
    struct hair_image_error error;
    double enough = scene->bench->options.quick ? 50 : 1000;
    if (!ensure(scene)) return false;
    struct bench_shot shot = shot_of(scene);
    bool ok = bench_picture_make(scene->studio.size, &full) &&
              bench_picture_make(scene->studio.size, &less) && bench_studio_set(&scene->studio, &shot) &&
              bench_studio_time(&scene->studio, enough, &near_by);
    shot.away = AWAY;
    ok = ok && take(&scene->studio, &shot, &full) && bench_picture_cover(&full);
    shot.has_lod = true;
    ok = ok && take(&scene->studio, &shot, &less) && bench_picture_compare(&full, &full, &less, &error) &&
         bench_studio_time(&scene->studio, enough, &far_off);
    if (ok) {
        json_t* row = add_row(scene, "far", "dynamic");
        bench_set_number(row, "away", AWAY);
        bench_set_number(row, "coverage", less.coverage / full.coverage);
        bench_set_number(row, "flip", error.flip);
        bench_set_count(row, "segments", scene->studio.primitives / 2);
        bench_set_number(row, "ms_near", near_by.ms);
        bench_set_number(row, "ms", far_off.ms);
        bench_set_number(row, "rate", near_by.ms / far_off.ms);
    }
    bench_picture_free(&full);
    bench_picture_free(&less);
    return ok;
}

static void measure(struct scene* scene, const char* name, bool (*run)(struct scene* scene))
{
    if (bench_begin(scene->bench, name, "dynamic") && !run(scene))
        bench_refuse(scene->bench, name, "dynamic");
}

static void run_suite(struct bench* bench)
{
    struct scene scene = {.bench = bench, .name = scenes[0]};
    measure_coverage(bench);
    bench_measure_lod_color(bench);
    measure(&scene, "walk", walk_away);
    measure(&scene, "far", look_from_far);
    bench_measure_flicker(bench);
    if (scene.alive) bench_studio_free(&scene.studio);
}

const struct bench_suite bench_lod = {"lod", "what is drawn of thinned or distant hair, against all of it",
                                      columns, run_suite};
