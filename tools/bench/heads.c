// heads.c - Suite `heads`, many heads of hair in one view, of which a few are near.
#include "tools/bench/style_groom.h"
#include "tools/bench/timer.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

#define MAX_HEADS 100
#define NEAR_HEADS 12
#define MAX_RUNS 31
#define WARM_FRAMES 20
#define SETTLE_FRAMES 200 // Frames in which a budget finds its level of detail.
#define WIDTH 1920
#define HEIGHT 1080
#define GUIDES 200
#define FOLLOWERS 10000

static const char* const columns[] = {"case",        "method",      "heads",  "ms",    "ms_in_row",
                                      "ms_cpu",      "us_cpu_head", "passes", "bytes", "ms_used",
                                      "ms_used_max", "importance",  "runs",   NULL};

static const struct heads_case {
    const char* name;
    uint32_t near, far; // numbers of heads
} cases[] = {{"1 near", 1, 0},
             {"1 far", 0, 1},
             {"12 near", NEAR_HEADS, 0},
             {"12 far", 0, 12},
             {"48 far", 0, 48},
             {"88 far", 0, MAX_HEADS - NEAR_HEADS},
             {"100 mixed", NEAR_HEADS, MAX_HEADS - NEAR_HEADS}};

static const struct heads_method {
    const char* name;
    bool by_list;
    float budget; // ms. 0 is none.
    float motion_pixels, guide_pixels; // of hair_lod
} methods[] = {{"one by one", false, 0, 0, 0},
               {"list", true, 0, 0, 0},
               {"list of few guides", true, 0, 0, 128},
               {"list by turns", true, 0, 128, 0},
               {"few guides by turns", true, 0, 128, 128},
               {"list in 10 ms", true, 10, 0, 0},
               {"list in 5 ms", true, 5, 0, 0}};

struct heads {
    struct bench* bench;
    struct heads_case scene;
    struct heads_method method;
    hair_groom* groom;
    hair_instance* hair[MAX_HEADS];
    GLuint frame, color, depth;
    uint32_t frames;
};

static uint32_t count_heads(const struct heads* heads)
{
    return heads->scene.near + heads->scene.far;
}

static hair_result make_groom(struct bench* bench, hair_groom** out)
{
    hair_style_desc style = hair_style_desc_default();
    style.guide_count = GUIDES;
    return bench_style_groom(bench, &style, 0, bench->options.strands ? bench->options.strands : FOLLOWERS,
                             out);
}

static void die(struct heads* heads)
{
    for (uint32_t i = 0; i < count_heads(heads); ++i) hair_destroy(heads->hair[i]);
    hair_set_budget(heads->bench->context, 0);
    hair_groom_destroy(heads->groom);
    glDeleteFramebuffers(1, &heads->frame);
    glDeleteRenderbuffers(1, &heads->color);
    glDeleteTextures(1, &heads->depth);
}

// Place near heads 1 to 2 m before the camera, and far heads 7 to 18 m, where a head is about 30
// pixels large.
static void place(const struct heads* heads, uint32_t i, float transform[16])
{
    bool near = i < heads->scene.near;
    uint32_t k = near ? i : i - heads->scene.near;
    float row = (float)(near ? k / 6 : k / 11), column = (float)(near ? k % 6 : k % 11);
    float away = near ? 1.2f + 0.6f * row : 8 + 1.2f * row;
    float angle = 0.4f * sinf(0.15f * (float)heads->frames + (float)i);
    const float m[16] = {cosf(angle),
                         0,
                         -sinf(angle),
                         0,
                         0,
                         1,
                         0,
                         0,
                         sinf(angle),
                         0,
                         cosf(angle),
                         0,
                         (near ? 0.3f : 1.2f) * (column - (near ? 2.5f : 5)),
                         near ? -1.6f : -1,
                         -away,
                         1};
    memcpy(transform, m, sizeof m);
}

static hair_result live(struct heads* heads)
{
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.look = &look;
    desc.thread_mapping = heads->bench->options.mapping;
    hair_result result = make_groom(heads->bench, &heads->groom);
    for (uint32_t i = 0; i < count_heads(heads) && !result; ++i) {
        place(heads, i, desc.transform);
        result = hair_create(heads->bench->context, heads->groom, &desc, &heads->hair[i]);
    }
    glCreateFramebuffers(1, &heads->frame);
    glCreateRenderbuffers(1, &heads->color);
    glNamedRenderbufferStorage(heads->color, GL_RGBA8, WIDTH, HEIGHT);
    glNamedFramebufferRenderbuffer(heads->frame, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, heads->color);
    glCreateTextures(GL_TEXTURE_2D, 1, &heads->depth);
    glTextureStorage2D(heads->depth, 1, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT);
    glNamedFramebufferTexture(heads->frame, GL_DEPTH_ATTACHMENT, heads->depth, 0);
    return result;
}

// Let the skull of a head collide with the hair.
static hair_result set_skull(hair_instance* hair, const float transform[16])
{
    hair_collider skull = hair_collider_default();
    skull.size[0] = 0.09f;
    for (int k = 0; k < 3; ++k) skull.position[k] = transform[12 + k] + (k == 1 ? 1.6f : 0);
    return hair_set_colliders(hair, &skull, 1, sizeof skull);
}

static hair_view make_view(const hair_lod* lod)
{
    hair_view view = hair_view_default();
    const float near = 0.1f, far = 100, focal = 1.7320508f; // a field of view of 60 degrees
    memset(view.projection, 0, sizeof view.projection);
    view.projection[0] = focal * HEIGHT / WIDTH;
    view.projection[5] = focal;
    view.projection[10] = (near + far) / (near - far);
    view.projection[11] = -1;
    view.projection[14] = 2 * near * far / (near - far);
    view.render_path = HAIR_RENDER_PATH_AUTO;
    view.light_count = 1;
    view.lod = lod;
    return view;
}

static hair_result step_and_draw(struct heads* heads, const hair_view* view)
{
    uint32_t count = count_heads(heads);
    hair_result result = HAIR_OK;
    if (heads->method.by_list) {
        result = hair_step_list(heads->hair, count, 1.0f / 60);
        return result ? result : hair_draw_list(heads->hair, count, view);
    }
    for (uint32_t i = 0; i < count && !result; ++i) result = hair_step(heads->hair[i], 1.0f / 60);
    for (uint32_t i = 0; i < count && !result; ++i) result = hair_draw(heads->hair[i], view);
    return result;
}

static hair_result run_frame(struct heads* heads, double* ms_cpu)
{
    hair_lod lod = hair_lod_default();
    lod.motion_pixels = heads->method.motion_pixels;
    lod.guide_pixels = heads->method.guide_pixels;
    hair_view view = make_view(&lod);
    hair_result result = HAIR_OK;
    const float zero[4] = {0}, one = 1;
    ++heads->frames;
    glBindFramebuffer(GL_FRAMEBUFFER, heads->frame);
    glViewport(0, 0, WIDTH, HEIGHT);
    glEnable(GL_DEPTH_TEST);
    glClearNamedFramebufferfv(heads->frame, GL_COLOR, 0, zero);
    glClearNamedFramebufferfv(heads->frame, GL_DEPTH, 0, &one);
    double start = hair_now();
    for (uint32_t i = 0; i < count_heads(heads) && !result; ++i) {
        float transform[16];
        place(heads, i, transform);
        result = hair_set_transform(heads->hair[i], transform);
        if (!result) result = set_skull(heads->hair[i], transform);
    }
    if (!result) result = step_and_draw(heads, &view);
    *ms_cpu = hair_now() - start;
    return result || bench_was_interrupted() ? HAIR_ERROR_ARGUMENT : HAIR_OK;
}

// Return the GPU time of the newest frame that a budget has measured, ms.
static double read_used(const struct heads* heads, hair_result* result)
{
    hair_report_info info = hair_report_info_default();
    uint32_t count = 0;
    if (!*result) *result = hair_report(heads->hair[0], false, &info, NULL, 0, 0, &count);
    return (double)info.budget_used;
}

static void set_used(json_t* row, double* used, uint32_t runs, const hair_report_info* info)
{
    double max = 0;
    for (uint32_t i = 0; i < runs; ++i) max = fmax(max, used[i]);
    bench_set_number(row, "ms_used", bench_times_of(used, runs).ms);
    bench_set_number(row, "ms_used_max", max);
    bench_set_number(row, "importance", (double)info->budget_importance);
}

// Find the time of a frame among frames that do not wait for the GPU, as those of an application.
static hair_result run_in_row(struct heads* heads, double* ms)
{
    const uint32_t frames = heads->bench->options.quick ? 4 : 24;
    hair_result result = HAIR_OK;
    double cpu = 0, start = hair_now();
    for (uint32_t i = 0; i < frames && !result; ++i) result = run_frame(heads, &cpu);
    glFinish();
    *ms = (hair_now() - start) / frames;
    return result;
}

// Measure frames with and without waiting for the GPU.
static bool measure(struct heads* heads, json_t* row)
{
    double all[MAX_RUNS], cpu[MAX_RUNS], used[MAX_RUNS], own = 0;
    uint32_t runs = 0, max = heads->bench->options.quick ? 3 : MAX_RUNS;
    hair_result result = live(heads);
    if (!result) result = hair_set_budget(heads->bench->context, heads->method.budget);
    for (uint32_t i = 0; i < (heads->method.budget > 0 ? SETTLE_FRAMES : WARM_FRAMES) && !result; ++i) {
        result = run_frame(heads, &own);
        glFinish();
    }
    double start = hair_now();
    for (; runs < max && !result && (runs < 3 || hair_now() - start < 4000); ++runs) {
        double begin = hair_now();
        result = run_frame(heads, &cpu[runs]);
        glFinish();
        all[runs] = hair_now() - begin;
        used[runs] = heads->method.budget > 0 ? read_used(heads, &result) : 0;
    }
    double ms_in_row = 0;
    if (!result) result = run_in_row(heads, &ms_in_row);
    hair_report_info info = hair_report_info_default();
    hair_report_row works[64];
    uint32_t count = 0, ran = 0;
    hair_memory memory = hair_memory_default();
    if (!result) result = hair_report(heads->hair[0], true, &info, works, sizeof *works, 64, &count);
    if (!result) result = hair_get_memory(heads->bench->context, &memory);
    if (result) return false;
    for (uint32_t i = 0; i < count && i < 64; ++i) ran += works[i].skip_reason == HAIR_SKIP_REASON_NONE;
    double ms_cpu = bench_times_of(cpu, runs).ms;
    bench_set_number(row, "ms", bench_times_of(all, runs).ms);
    bench_set_number(row, "ms_in_row", ms_in_row);
    bench_set_number(row, "ms_cpu", ms_cpu);
    bench_set_number(row, "us_cpu_head", 1e3 * ms_cpu / count_heads(heads));
    bench_set_count(row, "passes", ran);
    bench_set_count(row, "bytes", memory.bytes);
    bench_set_count(row, "runs", runs);
    if (heads->method.budget > 0) set_used(row, used, runs, &info);
    return true;
}

static void run(struct bench* bench)
{
    const size_t count = sizeof methods / sizeof *methods;
    for (size_t i = 0; i < count * sizeof cases / sizeof *cases; ++i) {
        struct heads heads = {.bench = bench, .scene = cases[i / count], .method = methods[i % count]};
        const char *name = heads.scene.name, *method = heads.method.name;
        bool is_single = count_heads(&heads) == 1;
        // A software rasteriser would take minutes for a crowd.
        if ((bench->options.quick || bench->software) && !is_single) continue;
        if (is_single && heads.method.budget > 0) continue;
        if (!bench_begin(bench, name, method)) continue;
        json_t* row = bench_rows_add(&bench->rows);
        bench_set_text(row, "case", name);
        bench_set_text(row, "method", method);
        bench_set_count(row, "heads", count_heads(&heads));
        if (!measure(&heads, row)) bench_refuse(bench, name, method);
        die(&heads);
    }
}

const struct bench_suite bench_heads = {"heads", "many heads in one view, by time and memory", columns, run};
