// skip.c - Pairs of scenes with and without a feature. A scene must not pay for features that it
// does not use.
#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/style_groom.h"
#include "tools/common/stats.h"

#define MAX_HEADS 100
#define MAX_RUNS 31
#define SIZE 256
#define REST (15 * 60) // frames in which hair at rest falls asleep

static const char* const columns[] = {"case",       "method",         "scene", "ms_all", "ms",
                                      "passes_run", "passes_skipped", "bytes", "runs",   NULL};

// A row of heads. The first `moving` heads shake, the first `seen` heads are in view.
struct scene {
    uint32_t heads, moving, seen;
    bool sleeps, colliders, fluid, blind; // `blind` disables drawing
    uint32_t lights;
    enum { NO_DEPTH, NO_WALL, WALL } before; // content of the depth buffer before hair is drawn
    bool lends; // passes the depth buffer to the view
};

static const struct pair {
    const char* name;
    struct scene all, less;
} pairs[] = {
    {"idle head",
     {1, 0, 1, .blind = true, .lights = 1},
     {1, 0, 1, .sleeps = true, .blind = true, .lights = 1}},
    {"off screen", {1, 1, 1, .sleeps = true, .lights = 1}, {1, 1, 0, .sleeps = true, .lights = 1}},
    {"no colliders",
     {1, 1, 1, .sleeps = true, .colliders = true, .lights = 1},
     {1, 1, 1, .sleeps = true, .lights = 1}},
    {"no wind",
     {1, 1, 1, .sleeps = true, .fluid = true, .lights = 1},
     {1, 1, 1, .sleeps = true, .lights = 1}},
    {"no lights", {1, 1, 1, .sleeps = true, .lights = 16}, {1, 1, 1, .sleeps = true}},
    {"hidden",
     {1, 1, 1, .sleeps = true, .lights = 1, .before = WALL},
     {1, 1, 1, .sleeps = true, .lights = 1, .before = WALL, .lends = true}},
    {"not lent",
     {1, 1, 1, .sleeps = true, .lights = 1, .before = NO_WALL, .lends = true},
     {1, 1, 1, .sleeps = true, .lights = 1, .before = NO_WALL}},
    {"5 of 100", {100, 5, 5, .sleeps = true, .lights = 1}, {5, 5, 5, .sleeps = true, .lights = 1}},
};

struct heads {
    struct bench* bench;
    struct scene scene;
    hair_groom* groom;
    hair_instance* hair[MAX_HEADS];
    GLuint frame, color, depth;
    uint32_t frames;
};

static hair_result make_groom(struct bench* bench, hair_groom** out)
{
    hair_style_desc style = hair_style_desc_default();
    style.guide_count = 64;
    return bench_style_groom(bench, &style, 0, bench->options.strands ? bench->options.strands : 2000, out);
}

static void die(struct heads* heads)
{
    for (uint32_t i = 0; i < heads->scene.heads; ++i) hair_destroy(heads->hair[i]);
    hair_groom_destroy(heads->groom);
    glDeleteFramebuffers(1, &heads->frame);
    glDeleteRenderbuffers(1, &heads->color);
    glDeleteTextures(1, &heads->depth);
}

static hair_result live(struct heads* heads)
{
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    desc.physics = &physics;
    physics.sleep_threshold = heads->scene.sleeps ? 1e-3f : 0;
    hair_result result = make_groom(heads->bench, &heads->groom);
    for (uint32_t i = 0; i < heads->scene.heads && !result; ++i) {
        result = hair_create(heads->bench->context, heads->groom, &desc, &heads->hair[i]);
        if (!result && heads->scene.colliders) {
            hair_collider collider = hair_collider_default();
            collider.size[0] = 0.1f, collider.position[0] = 2 * (float)i + 0.1f, collider.position[1] = 1.4f;
            result = hair_set_colliders(heads->hair[i], &collider, 1, sizeof collider);
        }
        if (!result && heads->scene.fluid) {
            hair_wind wind = hair_wind_default();
            wind.model = HAIR_WIND_FLUID;
            wind.velocity[0] = 2;
            result = hair_set_wind(heads->hair[i], &wind);
        }
    }
    glCreateFramebuffers(1, &heads->frame);
    glCreateRenderbuffers(1, &heads->color);
    glNamedRenderbufferStorage(heads->color, GL_RGBA8, SIZE, SIZE);
    glNamedFramebufferRenderbuffer(heads->frame, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, heads->color);
    if (!heads->scene.before) return result;
    glCreateTextures(GL_TEXTURE_2D, 1, &heads->depth);
    glTextureStorage2D(heads->depth, 1, GL_DEPTH_COMPONENT32F, SIZE, SIZE);
    glNamedFramebufferTexture(heads->frame, GL_DEPTH_ATTACHMENT, heads->depth, 0);
    return result;
}

// Simulate and draw one frame. Heads are 2 m apart. Each head has its own view. Views of heads out
// of view look past them.
static hair_result run_frame(struct heads* heads, bool draws)
{
    hair_view view = hair_view_default();
    hair_result result = HAIR_OK;
    float angle = 0.4f * sinf(0.15f * (float)heads->frames++);
    view.projection[0] = view.projection[5] = view.projection[10] = 2.5f;
    view.view[13] = -1.5f;
    view.light_count = heads->scene.lights;
    glBindFramebuffer(GL_FRAMEBUFFER, heads->frame);
    glViewport(0, 0, SIZE, SIZE);
    view.occluder_depth = heads->scene.lends ? heads->depth : 0;
    // Before the hair, the depth buffer contains a wall of depth 0 or nothing.
    if (heads->scene.before) {
        float depth = heads->scene.before == WALL ? 0 : 1;
        glClearNamedFramebufferfv(heads->frame, GL_DEPTH, 0, &depth);
        glEnable(GL_DEPTH_TEST);
    } else {
        glDisable(GL_DEPTH_TEST);
    }
    for (uint32_t i = 0; i < heads->scene.heads && !result; ++i) {
        float a = i < heads->scene.moving ? angle : 0, x = 2 * (float)i;
        const float head[16] = {cosf(a), 0, -sinf(a), 0, 0, 1, 0, 0, sinf(a), 0, cosf(a), 0, x, 0, 0, 1};
        view.view[12] = -x - (i < heads->scene.seen ? 0 : 50);
        result = hair_set_transform(heads->hair[i], head);
        if (!result) result = hair_step(heads->hair[i], 1.0f / 60);
        if (!result && draws) result = hair_draw(heads->hair[i], &view);
    }
    return result || bench_was_interrupted() ? HAIR_ERROR_ARGUMENT : HAIR_OK;
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

// Measure the wall time of a frame in ms. `row` NULL measures nothing else.
static bool measure(struct bench* bench, const struct scene* scene, double* ms, uint32_t* runs, json_t* row)
{
    struct heads heads = {.bench = bench, .scene = *scene};
    double times[MAX_RUNS], start;
    hair_result result = live(&heads);
    uint32_t rest = scene->sleeps && scene->moving < scene->heads ? REST : 10;
    for (uint32_t i = 0; i < rest && !result; ++i) {
        result = run_frame(&heads, i == 0);
        // Hair falls asleep by results that the GPU returns. A GPU that lags behind would not be
        // done when measuring starts.
        glFinish();
    }
    uint32_t max = bench->options.quick ? 3 : MAX_RUNS;
    start = hair_now();
    for (*runs = 0; *runs < max && !result && (*runs < 3 || hair_now() - start < 4000); ++*runs) {
        double begin = hair_now();
        result = run_frame(&heads, !scene->blind);
        glFinish();
        times[*runs] = hair_now() - begin;
    }
    hair_report_info info = hair_report_info_default();
    hair_report_row works[64];
    uint32_t count = 0, ran = 0;
    if (!result) result = hair_report(heads.hair[0], true, &info, works, sizeof *works, 64, &count);
    for (uint32_t i = 0; i < count && i < 64; ++i) ran += works[i].skip_reason == HAIR_SKIP_REASON_NONE;
    if (!result) {
        qsort(times, *runs, sizeof *times, compare);
        *ms = times[*runs / 2];
    }
    if (!result && row) {
        bench_set_count(row, "passes_run", ran);
        bench_set_count(row, "passes_skipped", count - ran);
        bench_set_count(row, "bytes", info.bytes);
    }
    die(&heads);
    return !result;
}

static void run(struct bench* bench)
{
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        double all = 0, less = 0;
        uint32_t runs = 0;
        if (bench->options.quick && pairs[i].all.heads > 1) continue;
        if (!bench_begin(bench, pairs[i].name, "direct")) continue;
        if (!measure(bench, &pairs[i].all, &all, &runs, NULL)) {
            bench_refuse(bench, pairs[i].name, "direct");
            continue;
        }
        json_t* row = bench_rows_add(&bench->rows);
        bench_set_text(row, "case", pairs[i].name);
        bench_set_text(row, "method", "direct");
        bench_set_text(row, "scene", pairs[i].name);
        bench_set_number(row, "ms_all", all);
        if (!measure(bench, &pairs[i].less, &less, &runs, row)) continue;
        bench_set_number(row, "ms", less);
        bench_set_count(row, "runs", runs);
    }
}

const struct bench_suite bench_skip = {
    "skip", "scenes with a thing and without it, by time, passes and memory", columns, run};
