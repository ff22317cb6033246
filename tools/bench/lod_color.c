// lod_color.c - Rows of the suite `lod`, the mean colour of thinned and of distant hair against
// that of all strands. Every picture has a density grid of its own.
#include "tools/bench/lod_color.h"

#include "tools/bench/studio.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 512
#define SAMPLES 4
#define SUPERSAMPLE 2 // Levels of detail count the pixels that are drawn.
#define SETTLE 12 // frames
#define LIGHTS 6 // five suns and a sky
#define ELEVATION 0.436332f // of suns, radians
#define NEAR_FRACTION 0.05f
#define LIMIT 0.03

// Hair as in tools/truth.
static const struct cut {
    const char* name;
    hair_look_preset preset;
    uint32_t segments, followers;
    float radius; // m
} cuts[] = {{"straight", HAIR_LOOK_NATURAL, 24, 36000, 8e-5f},
            {"wavy", HAIR_LOOK_WAVY, 48, 18000, 1.1e-4f},
            {"curly", HAIR_LOOK_CURLY, 64, 15000, 1.2e-4f}};

static const struct color {
    const char* name;
    float reflectance[3];
} colors[] = {
    {"blond", {0.72f, 0.55f, 0.31f}}, {"brown", {0.26f, 0.13f, 0.06f}}, {"black", {0.018f, 0.0163f, 0.017f}}};

// Distances, as multiples of the near one. 0 is the near one with a fixed fraction of the strands.
static const uint32_t distances[] = {0, 4, 8, 16};

#define COUNT(array) (sizeof(array) / sizeof *(array))

// Errors of the mean of each channel, the largest over the lights.
struct errors {
    double channel[3], max;
    const char* light;
};

static bool make(struct bench* bench, const struct cut* cut, struct bench_studio* out)
{
    static const float eye[3] = {0, 1.55f, 1.6f}, target[3] = {0, 1.5f, 0};
    uint32_t whole = bench->options.quick ? SIZE / 2 : SIZE;
    uint32_t size = bench->options.size ? bench->options.size : whole;
    uint32_t asked = bench->options.strands;
    struct bench_studio_desc desc = {.scene = "long",
                                     .size = size,
                                     .followers = asked ? asked : cut->followers,
                                     .segments = cut->segments};
    if (!bench_studio_make(bench, &desc, out)) return false;
    memcpy(out->scene.eye, eye, sizeof eye);
    memcpy(out->scene.target, target, sizeof target);
    out->scene.field_of_view = 22;
    out->bare = true;
    for (int i = 0; i < SETTLE; ++i)
        if (!bench_studio_step(out, NULL)) return false;
    return true;
}

static bool dress(const struct bench_studio* studio, const struct cut* cut, const struct color* color,
                  struct bench_shot* shot)
{
    hair_look* look = &shot->look;
    if (hair_look_apply_preset(look, cut->preset)) return false;
    look->strand.segments = cut->segments;
    look->strand.radius = cut->radius;
    if (studio->bench->options.strands)
        look->strand.radius *= (float)cut->followers / (float)studio->bench->options.strands;
    look->self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    look->color.spread = look->color.hue_spread = 0;
    memcpy(look->color.root, color->reflectance, sizeof look->color.root);
    memcpy(look->color.tip, color->reflectance, sizeof look->color.tip);
    shot->samples = SAMPLES;
    shot->supersample = SUPERSAMPLE;
    shot->map_whole = true;
    return true;
}

// Light the hair with a sun at a multiple of 45 degrees from the eye, or with a sky.
static void shine(struct bench_studio* studio, int number, struct bench_shot* shot)
{
    hair_light* light = &studio->scene.settings.light;
    bool sky = number == LIGHTS - 1;
    float turn = 0.785398f * (float)number;
    light->direction[0] = sinf(turn) * cosf(ELEVATION);
    light->direction[1] = sinf(ELEVATION);
    light->direction[2] = cosf(turn) * cosf(ELEVATION);
    for (int k = 0; k < 3; ++k) light->color[k] = sky ? 0 : 3, shot->view.ambient[k] = sky ? 1.5f : 0;
    shot->unmapped = sky;
}

// Find the mean colour of the pixels that hair covers. The background is that of the first pixel.
static bool find_mean(struct bench_studio* studio, const struct bench_shot* shot, double out[3])
{
    size_t pixels = (size_t)studio->size * studio->size;
    struct bench_shot other = *shot;
    other.look.strand.radius *= 2; // Another look discards vertices and the density grid.
    double* rgba = calloc(4 * pixels, sizeof *rgba);
    bool ok = rgba && bench_studio_set(studio, &other) && bench_studio_set(studio, shot) &&
              bench_studio_draw(studio, NULL) && bench_studio_add(studio, rgba);
    double covered = 0;
    for (int k = 0; k < 3; ++k) out[k] = 0;
    for (size_t i = 0; i < pixels && ok; ++i) {
        for (int k = 0; k < 3; ++k) out[k] += rgba[4 * i + (size_t)k] - (1 - rgba[4 * i + 3]) * rgba[k];
        covered += rgba[4 * i + 3];
    }
    free(rgba);
    for (int k = 0; k < 3; ++k) out[k] /= fmax(covered, 1);
    return ok && covered > 1;
}

static bool compare(struct bench_studio* studio, const struct cut* cut, const struct color* color,
                    uint32_t distance, struct errors* out)
{
    static const char* const names[LIGHTS] = {"sun 0", "sun 45", "sun 90", "sun 135", "sun 180", "sky"};
    *out = (struct errors){.light = names[0]};
    for (int i = 0; i < LIGHTS; i += studio->bench->options.quick ? LIGHTS - 1 : 1) {
        struct bench_shot shot = bench_studio_shot(studio);
        double all[3], fewer[3];
        if (!dress(studio, cut, color, &shot)) return false;
        shine(studio, i, &shot);
        shot.away = distance ? (float)distance : 1;
        if (!find_mean(studio, &shot, all)) return false;
        shot.has_lod = true;
        shot.lod.per_patch = distance > 0;
        if (!distance) shot.lod.strand_fraction = NEAR_FRACTION;
        if (!find_mean(studio, &shot, fewer)) return false;
        for (int k = 0; k < 3; ++k) {
            double error = fewer[k] / all[k] - 1;
            if (fabs(error) > fabs(out->channel[k])) out->channel[k] = error;
            if (fabs(error) > out->max) out->max = fabs(error), out->light = names[i];
        }
    }
    return true;
}

static void add_row(const struct bench_studio* studio, const char* method, const struct errors* errors)
{
    json_t* row = bench_rows_add(&studio->bench->rows);
    bench_set_text(row, "case", "color");
    bench_set_text(row, "method", method);
    bench_set_text(row, "scene", "long");
    bench_set_count(row, "strands", studio->info.follower_count);
    bench_set_count(row, "size", studio->size);
    bench_set_count(row, "samples", SAMPLES * SUPERSAMPLE * SUPERSAMPLE);
    bench_set_text(row, "light", errors->light);
    bench_set_number(row, "red", errors->channel[0]);
    bench_set_number(row, "green", errors->channel[1]);
    bench_set_number(row, "blue", errors->channel[2]);
    bench_set_number(row, "color_error", errors->max);
    bench_set_number(row, "limit", LIMIT);
    bench_set_flag(row, "pass", errors->max <= LIMIT);
}

void bench_measure_lod_color(struct bench* bench)
{
    bool quick = bench->options.quick;
    for (size_t i = quick ? 1 : 0; i < (quick ? 2 : COUNT(cuts)); ++i) {
        struct bench_studio studio;
        bool alive = false;
        for (size_t c = 0; c < (quick ? 1 : COUNT(colors)); ++c)
            for (size_t d = 0; d < COUNT(distances); d += quick ? 2 : 1) {
                char method[32], where[16] = "5 %";
                struct errors errors;
                if (distances[d]) snprintf(where, sizeof where, "%u", distances[d]);
                snprintf(method, sizeof method, "%s %s %s", cuts[i].name, colors[c].name, where);
                if (!bench_begin(bench, "color", method)) continue;
                if (!alive) alive = make(bench, &cuts[i], &studio);
                if (alive && compare(&studio, &cuts[i], &colors[c], distances[d], &errors))
                    add_row(&studio, method, &errors);
                else
                    bench_refuse(bench, "color", method);
            }
        if (alive) bench_studio_free(&studio);
    }
}
