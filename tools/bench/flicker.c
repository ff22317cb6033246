// flicker.c - Rows of the suite `lod`, temporal stability of hair on a slowly turning head. The
// difference between successive pictures is compared with that of the truth, whose many samples
// leave only motion.
#include "tools/bench/ground_truth.h"
#include "tools/bench/flicker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 256
// Strands of the scene for a picture 720 pixels high, proportionally fewer for smaller ones.
#define STRANDS_OF_720 18000
#define SPEED 30 // degrees per second, half a degree per frame
#define RUN_UP 60 // frames until the hair follows
#define FRAMES 9
#define FRAMES_OF_QUICK 3
#define SAMPLES 1024
#define TEXELS 1 // texels by which the truth's shadow maps are shifted

// Drawing methods. Methods with the same shadow have one truth.
static const struct way {
    const char* method;
    hair_self_shadow shadow;
    hair_coverage coverage;
    uint32_t msaa, supersample;
    bool has_lod, quick;
} ways[] = {{"depth", HAIR_SELF_SHADOW_DEPTH, HAIR_COVERAGE_MSAA, 1, 1, false, false},
            {"depth", HAIR_SELF_SHADOW_DEPTH, HAIR_COVERAGE_MSAA, 4, 1, false, false},
            {"depth", HAIR_SELF_SHADOW_DEPTH, HAIR_COVERAGE_MSAA, 8, 1, false, false},
            {"depth", HAIR_SELF_SHADOW_DEPTH, HAIR_COVERAGE_MSAA, 4, 2, false, false},
            {"depth shares", HAIR_SELF_SHADOW_DEPTH, HAIR_COVERAGE_ALPHA, 1, 1, false, false},
            {"strands", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_MSAA, 1, 1, false, true},
            {"strands", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_MSAA, 4, 1, false, true},
            {"strands", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_MSAA, 8, 1, false, true},
            {"strands", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_MSAA, 4, 2, false, true},
            {"strands lod", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_MSAA, 4, 1, true, false},
            {"strands shares", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_ALPHA, 1, 1, false, true},
            {"strands shares", HAIR_SELF_SHADOW_STRANDS, HAIR_COVERAGE_ALPHA, 4, 1, false, false}};

#define WAYS (sizeof ways / sizeof *ways)

// The current and the previous frame, and sums over all pairs of frames.
struct record {
    struct bench_picture picture[2];
    // `max` is the maximum ratio to the truth's difference, `off` the difference from the truth.
    double flip, max, off, ms;
};

struct turn {
    struct bench* bench;
    struct bench_studio studio;
    bool wanted[WAYS];
    struct record record[WAYS];
    struct bench_ground_truth truth[2][2]; // per shadow, the current and the previous frame
    double flip[2], halves[2]; // per shadow, sums for the truth and for the mean of its halves
    uint32_t pairs;
};

static bool is_wanted(struct turn* turn, hair_self_shadow shadow)
{
    for (size_t i = 0; i < WAYS; ++i)
        if (turn->wanted[i] && ways[i].shadow == shadow) return true;
    return false;
}

// Make the studio. The head turns at constant speed from the second key to the third, towards the
// camera.
static bool make(struct turn* turn)
{
    uint32_t whole = turn->bench->options.quick ? SIZE / 2 : SIZE;
    uint32_t size = turn->bench->options.size ? turn->bench->options.size : whole;
    uint32_t asked = turn->bench->options.strands;
    struct bench_studio_desc desc = {
        .scene = "demo", .size = size, .followers = asked ? asked : (uint32_t)(STRANDS_OF_720 * size / 720)};
    if (!bench_studio_make(turn->bench, &desc, &turn->studio)) return false;
    struct hair_motion* motion = &turn->studio.scene.motion;
    motion->count = 4;
    for (uint32_t i = 0; i < 4; ++i)
        motion->key[i] = (struct hair_key){.time = (float)i, .rotation = {SPEED * ((float)i - 1), 0, 0}};
    for (uint32_t i = 0; i < RUN_UP; ++i)
        if (!bench_studio_step(&turn->studio, NULL)) return false;
    for (int i = 0; i < 4; ++i)
        if (!bench_ground_truth_create(size, &turn->truth[i / 2][i % 2])) return false;
    for (size_t i = 0; i < 2 * WAYS; ++i)
        if (!bench_picture_make(size, &turn->record[i / 2].picture[i % 2])) return false;
    return true;
}

static struct bench_shot shot_of(const struct turn* turn, const struct way* way)
{
    struct bench_shot shot = bench_studio_shot(&turn->studio);
    shot.look.strand.radius *= turn->studio.fewer;
    shot.look.self_shadow.method = way->shadow;
    shot.view.coverage = way->coverage;
    shot.view.render_path = HAIR_RENDER_PATH_CACHED;
    shot.samples = way->msaa;
    shot.supersample = way->supersample;
    shot.has_lod = way->has_lod;
    return shot;
}

static bool take(struct turn* turn, const struct way* way, struct record* record)
{
    struct bench_shot shot = shot_of(turn, way);
    struct bench_picture* out = &record->picture[0];
    double ms = 0;
    memset(out->rgba, 0, 4 * sizeof *out->rgba * out->size * out->size);
    if (!bench_studio_set(&turn->studio, &shot) || !bench_studio_draw(&turn->studio, &ms) ||
        !bench_studio_add(&turn->studio, out->rgba))
        return false;
    record->ms = turn->pairs && record->ms > 0 ? fmin(record->ms, ms) : ms;
    bench_picture_finish(out, 1, (double)turn->studio.scene.exposure);
    return true;
}

static bool differ(const struct bench_picture* where, const struct bench_picture* a,
                   const struct bench_picture* b, double* flip)
{
    struct hair_image_error error;
    if (!bench_picture_compare(where, a, b, &error)) return false;
    *flip = error.flip;
    return true;
}

// Make the mask of hair in either of two frames.
static bool cover_both(struct bench_picture* now, const struct bench_picture* before)
{
    size_t pixels = (size_t)now->size * now->size;
    if (!bench_picture_cover(now)) return false;
    for (size_t i = 0; i < pixels && before->mask; ++i) now->mask[i] |= before->mask[i];
    return true;
}

static bool compare(struct turn* turn, hair_self_shadow shadow)
{
    const struct bench_ground_truth *now = &turn->truth[shadow][0], *before = &turn->truth[shadow][1];
    const struct bench_picture* where = &now->whole;
    double ground_truth, half[2], flip, off;
    if (!differ(where, &before->whole, &now->whole, &ground_truth)) return false;
    for (int i = 0; i < 2; ++i)
        if (!differ(where, &before->half[i], &now->half[i], &half[i])) return false;
    turn->flip[shadow] += ground_truth;
    turn->halves[shadow] += 0.5 * (half[0] + half[1]);
    for (size_t i = 0; i < WAYS; ++i) {
        struct record* record = &turn->record[i];
        if (!turn->wanted[i] || ways[i].shadow != shadow) continue;
        if (!differ(where, &record->picture[1], &record->picture[0], &flip) ||
            !differ(where, where, &record->picture[0], &off))
            return false;
        record->flip += flip;
        record->off += off;
        record->max = fmax(record->max, flip / ground_truth);
    }
    return true;
}

static void pass_on(struct turn* turn)
{
    for (int s = 0; s < 2; ++s) {
        struct bench_ground_truth last = turn->truth[s][1];
        turn->truth[s][1] = turn->truth[s][0];
        turn->truth[s][0] = last;
    }
    for (size_t i = 0; i < WAYS; ++i) {
        struct bench_picture last = turn->record[i].picture[1];
        turn->record[i].picture[1] = turn->record[i].picture[0];
        turn->record[i].picture[0] = last;
    }
}

static bool take_frame(struct turn* turn, bool is_first)
{
    pass_on(turn);
    for (size_t i = 0; i < WAYS; ++i)
        if (turn->wanted[i] && !take(turn, &ways[i], &turn->record[i])) return false;
    for (hair_self_shadow s = HAIR_SELF_SHADOW_DEPTH; s <= HAIR_SELF_SHADOW_STRANDS; ++s) {
        struct way way = {.shadow = s, .msaa = 1, .supersample = 1};
        struct bench_ground_truth* ground_truth = turn->truth[s];
        if (!is_wanted(turn, s)) continue;
        struct bench_shot shot = shot_of(turn, &way);
        if (!bench_ground_truth_render(&turn->studio, &shot, SAMPLES, TEXELS, &ground_truth[0]) ||
            !cover_both(&ground_truth[0].whole, &ground_truth[1].whole) || (!is_first && !compare(turn, s)))
            return false;
    }
    turn->pairs += !is_first;
    return true;
}

static void add_row(struct turn* turn, const struct way* way, const struct record* record)
{
    json_t* row = bench_rows_add(&turn->bench->rows);
    double pairs = turn->pairs, ground_truth = turn->flip[way->shadow];
    bench_set_text(row, "case", "turn");
    bench_set_text(row, "method", way->method);
    bench_set_text(row, "scene", "demo");
    bench_set_count(row, "strands", turn->studio.info.follower_count);
    bench_set_count(row, "size", turn->studio.size);
    bench_set_count(row, "samples", way->msaa * way->supersample * way->supersample);
    bench_set_count(row, "frames", turn->pairs + 1);
    bench_set_number(row, "ms", record->ms);
    bench_set_number(row, "flip", record->off / pairs);
    bench_set_number(row, "between", record->flip / pairs);
    bench_set_number(row, "between_truth", ground_truth / pairs);
    bench_set_number(row, "between_halves", turn->halves[way->shadow] / pairs);
    bench_set_number(row, "calm", record->flip / ground_truth);
    bench_set_number(row, "calm_most", record->max);
}

static bool run(struct turn* turn)
{
    uint32_t frames = turn->bench->options.quick ? FRAMES_OF_QUICK : FRAMES;
    if (!make(turn)) return false;
    for (uint32_t k = 0; k < frames; ++k)
        if (!take_frame(turn, k == 0) || (k + 1 < frames && !bench_studio_step(&turn->studio, NULL)))
            return false;
    for (size_t i = 0; i < WAYS; ++i)
        if (turn->wanted[i]) add_row(turn, &ways[i], &turn->record[i]);
    return true;
}

void bench_measure_flicker(struct bench* bench)
{
    struct turn turn = {.bench = bench};
    bool any = false, alive;
    for (size_t i = 0; i < WAYS; ++i) {
        if (bench->options.quick && !ways[i].quick) continue;
        turn.wanted[i] = bench_begin(bench, "turn", ways[i].method) && ways[i].msaa <= bench_max_samples();
        any = any || turn.wanted[i];
    }
    if (!any) return;
    alive = run(&turn);
    if (!alive) bench_refuse(bench, "turn", "all");
    for (int i = 0; i < 4; ++i) bench_ground_truth_free(&turn.truth[i / 2][i % 2]);
    for (size_t i = 0; i < 2 * WAYS; ++i) bench_picture_free(&turn.record[i / 2].picture[i % 2]);
    if (turn.studio.hair) bench_studio_free(&turn.studio);
}
