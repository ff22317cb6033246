// dispatch.c - Suite `dispatch`, the longest dispatch and the longest draw of large scenes. An
// operating system resets a GPU that takes too long for one of them.
#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/bench.h"
#include "tools/bench/gl_timer.h"
#include "tools/bench/scene.h"
#include "tools/common/stats.h"
#include "tools/common/targets.h"

#define LENGTH 0.3f // m
#define SIDE 0.4f // side of the square of roots, m
#define LIMIT_GPU 2.0 // ms
#define LIMIT_SOFTWARE 100.0 // ms
// Frames, of which the first ones compile programs. All others have the same work.
#define FRAMES_GPU 6
#define FRAMES_SOFTWARE 3
#define WIDTH 1920
#define HEIGHT 1080

static const char* const columns[] = {"case",     "method",    "guides", "vertices", "followers",
                                      "segments", "colliders", "kind",   "stage",    "ms",
                                      "limit",    "count",     "pass",   NULL};

static const struct subject {
    const char* name;
    hair_solver solver;
    uint32_t guides, vertices, followers, segments, colliders;
    hair_render_path path;
    bool quick;
    bool opacity;
} subjects[] = {
    {"guides", HAIR_SOLVER_DIRECT, 10240, 32, 0, 0, 0, 0, true, false},
    {"guides", HAIR_SOLVER_ACCURATE, 10240, 32, 0, 0, 0, 0, false, false},
    {"guides", HAIR_SOLVER_FOLLOW, 10240, 32, 0, 0, 0, 0, false, false},
    {"guides", HAIR_SOLVER_REDBLACK, 10240, 32, 0, 0, 0, 0, true, false},
    {"many guides", HAIR_SOLVER_DIRECT, 102400, 32, 0, 0, 0, 0, false, false},
    {"many guides", HAIR_SOLVER_REDBLACK, 102400, 32, 0, 0, 0, 0, false, false},
    {"long guides", HAIR_SOLVER_DIRECT, 1024, 256, 0, 0, 0, 0, false, false},
    {"long guides", HAIR_SOLVER_ACCURATE, 1024, 256, 0, 0, 0, 0, false, false},
    {"colliders", HAIR_SOLVER_DIRECT, 256, 16, 4096, 16, 10000, HAIR_RENDER_PATH_CACHED, true, false},
    {"colliders", HAIR_SOLVER_ACCURATE, 256, 16, 0, 0, 10000, 0, false, false},
    {"colliders", HAIR_SOLVER_DIRECT, 10240, 32, 0, 0, 10000, 0, false, false},
    {"colliders", HAIR_SOLVER_DIRECT, 256, 16, 4096, 16, 100000, HAIR_RENDER_PATH_CACHED, false, false},
    {"colliders", HAIR_SOLVER_DIRECT, 256, 16, 4096, 16, 1048576, HAIR_RENDER_PATH_CACHED, false, false},
    {"followers", HAIR_SOLVER_DIRECT, 256, 16, 100000, 64, 0, HAIR_RENDER_PATH_TESSELLATION, false, false},
    {"followers", HAIR_SOLVER_DIRECT, 256, 16, 100000, 64, 0, HAIR_RENDER_PATH_CACHED, true, false},
    {"followers", HAIR_SOLVER_DIRECT, 256, 16, 100000, 64, 0, HAIR_RENDER_PATH_COMPUTE, true, false},
    {"opacity", HAIR_SOLVER_DIRECT, 256, 16, 100000, 64, 0, HAIR_RENDER_PATH_CACHED, false, true},
};

struct run {
    struct bench* bench;
    const struct subject* subject;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    hair_collider* colliders;
    struct hair_targets targets;
    uint32_t guides;
};

static float random_in(uint32_t* state, float min, float max)
{
    *state = *state * 1664525u + 1013904223u;
    return min + (max - min) * (float)(*state >> 8) / 16777216.0f;
}

// Make strands that hang from a horizontal square, and bend a little.
static hair_result make_groom(struct run* run)
{
    const struct subject* subject = run->subject;
    uint32_t row = (uint32_t)sqrt((double)subject->guides), count = row * row, each = subject->vertices;
    float* positions = malloc(sizeof(float) * 3 * each * count);
    uint32_t* vertices = malloc(sizeof *vertices * count);
    for (uint32_t i = 0; i < count && positions && vertices; ++i) {
        vertices[i] = each;
        for (uint32_t k = 0; k < each; ++k) {
            float *at = positions + 3 * (each * i + k), t = (float)k / (float)(each - 1);
            at[0] = SIDE * ((float)(i % row) / (float)row - 0.5f) + 0.05f * t * t;
            at[1] = -LENGTH * t;
            at[2] = SIDE * ((float)(i / row) / (float)row - 0.5f);
        }
    }
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &run->bench->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = count;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = each;
    desc.follower_count = subject->followers;
    hair_result result = positions && vertices ? hair_groom_create(&desc, &run->groom) : HAIR_ERROR_MEMORY;
    run->guides = count;
    free(positions);
    free(vertices);
    return result;
}

// Make small balls all over the hair.
static hair_result set_colliders(struct run* run, uint32_t frame)
{
    uint32_t random = 1, count = run->subject->colliders;
    if (!count) return HAIR_OK;
    if (!run->colliders) run->colliders = malloc(count * sizeof *run->colliders);
    if (!run->colliders) return HAIR_ERROR_MEMORY;
    for (uint32_t i = 0; i < count; ++i) {
        hair_collider ball = hair_collider_default();
        ball.shape = HAIR_SHAPE_SPHERE;
        ball.size[0] = 0.002f;
        ball.position[0] = random_in(&random, -SIDE / 2, SIDE / 2) + 0.002f * (float)frame;
        ball.position[1] = random_in(&random, -LENGTH, -0.03f);
        ball.position[2] = random_in(&random, -SIDE / 2, SIDE / 2);
        run->colliders[i] = ball;
    }
    return hair_set_colliders(run->hair, run->colliders, count, sizeof *run->colliders);
}

static hair_result make(struct run* run)
{
    hair_context_desc context = hair_context_desc_default();
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    context.host = &run->bench->host;
    context.get_proc = bench_gl_timer_proc;
    desc.solver = run->subject->solver;
    desc.thread_mapping = run->bench->options.mapping;
    desc.look = &look;
    if (run->subject->segments) look.strand.segments = run->subject->segments;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    hair_result result = hair_context_create(&context, &run->context);
    if (!result) result = make_groom(run);
    if (!result) result = hair_create(run->context, run->groom, &desc, &run->hair);
    return result;
}

// Draw ribbons that fill the picture.
static hair_result draw(struct run* run)
{
    hair_view view = hair_view_default();
    const float scale = 2 / SIDE;
    const float projection[16] = {scale, 0, 0, 0, 0, scale * 1.2f, 0, 0, 0, 0, -1, 0, 0, 0.9f, 0, 1};
    if (!run->subject->followers) return HAIR_OK;
    memcpy(view.projection, projection, sizeof projection);
    view.primitive = HAIR_PRIMITIVE_RIBBONS;
    view.render_path = run->subject->path;
    if (run->subject->opacity) view.pass = HAIR_PASS_OPACITY;
    glBindFramebuffer(GL_FRAMEBUFFER, run->targets.framebuffer[HAIR_TARGET_DRAWN]);
    glViewport(0, 0, WIDTH, HEIGHT);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    return hair_draw(run->hair, &view);
}

static hair_result go(struct run* run)
{
    uint32_t frames = run->bench->software ? FRAMES_SOFTWARE : FRAMES_GPU;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        hair_result result = set_colliders(run, frame);
        if (frame <= 1) bench_gl_timer_clear(); // The first frame compiles programs.
        bench_gl_timer_begin_frame();
        if (!result) result = hair_step(run->hair, 1.0f / 60);
        if (!result) result = draw(run);
        if (result) return result;
    }
    return HAIR_OK;
}

static void add_row(const struct run* run, const char* kind, struct bench_gl_longest longest)
{
    const struct subject* subject = run->subject;
    double limit = run->bench->software ? LIMIT_SOFTWARE : LIMIT_GPU;
    if (!longest.count) return;
    json_t* row = bench_rows_add(&run->bench->rows);
    bench_set_text(row, "case", subject->name);
    bench_set_text(row, "method", bench_solver_name(subject->solver));
    bench_set_count(row, "guides", run->guides);
    bench_set_count(row, "vertices", subject->vertices);
    bench_set_count(row, "followers", subject->followers);
    bench_set_count(row, "segments", subject->segments);
    bench_set_count(row, "colliders", subject->colliders);
    bench_set_text(row, "kind", kind);
    bench_set_text(row, "stage", longest.pass);
    bench_set_number(row, "ms", longest.ms);
    bench_set_number(row, "limit", limit);
    bench_set_count(row, "count", longest.count);
    bench_set_flag(row, "pass", longest.ms <= limit);
}

static void destroy(struct run* run)
{
    hair_targets_delete(&run->targets);
    hair_destroy(run->hair);
    hair_groom_destroy(run->groom);
    hair_context_destroy(run->context);
    free(run->colliders);
}

static void measure(struct bench* bench, const struct subject* subject)
{
    struct run run = {.bench = bench, .subject = subject};
    const char* method = bench_solver_name(subject->solver);
    if (!bench_begin(bench, subject->name, method)) return;
    bool fits = hair_targets_make(&run.targets, WIDTH, HEIGHT, 1, 1);
    hair_result result = fits ? make(&run) : HAIR_ERROR_MEMORY;
    if (!result) result = go(&run);
    if (result) {
        bench_refuse(bench, subject->name, method);
    } else {
        add_row(&run, "dispatch", bench_gl_longest_dispatch());
        add_row(&run, "draw", bench_gl_longest_draw());
    }
    destroy(&run);
    bench_gl_timer_clear();
}

static void run_suite(struct bench* bench)
{
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; ++i)
        if (subjects[i].quick || !bench->options.quick) measure(bench, &subjects[i]);
}

const struct bench_suite bench_dispatch = {"dispatch", "longest dispatch and longest draw of large scenes",
                                           columns, run_suite};
