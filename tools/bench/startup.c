// startup.c - Suite `startup`, from strands to the first picture: the time of creation and of cuts,
// the programs of the first frame, and the memory of a guide vertex.
//
// Programs are counted by hair_report(). Drivers keep none on the disk, see main() of bench.c.
#define _POSIX_C_SOURCE 200809L
#include "tools/bench/bench.h"
#include "tools/bench/pool.h"
#include "tools/bench/startup_cache.h"
#include "tools/bench/timer.h"
#include "tools/common/stats.h"
#include "tools/common/targets.h"

#include <epoxy/gl.h>
#include <hair/hair_buffers.h>
#include <hair/hair_cut.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define VERTICES 32
#define LENGTH 0.25f // m
#define SKULL 0.1f // m
#define SIZE 256
#define FOLLOWERS 2000
#define MAX_CALLS 10000
#define MAX_ROWS 64
#define CREATION_LIMIT 5.0 // us of the processor a guide
#define UPLOAD_LIMIT 0.5 // us of the processor a guide, on the thread of OpenGL
#define CALL_LIMIT 5.0 // ms

// clang-format off
static const char* const columns[] = {
    "case", "method", "guides", "vertices", "threads", "us_per_guide", "us_upload", "us_limit", "ms",
    "ms_step", "changed", "ms_longest", "ms_limit", "calls", "programs", "late", "bytes", "stage", "pass",
    NULL};
// clang-format on

// Time of this thread on its processor, ms.
static double thread_time(void)
{
    struct timespec time = {0};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

struct subject {
    struct bench* bench;
    uint32_t guides, followers;
    bool curled, straight, prepared;
    bool differs; // Each guide has a stiffness of its own.
    const hair_tasks* tasks; // NULL runs the tasks of the groom on this thread.
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    struct hair_targets targets;
    double create_ms, upload_ms; // times of this thread
    double groom_ms; // elapsed time of hair_groom_create()
};

// Set a strand that leaves the skull and falls, with a curl of 8 mm if it is curled.
static void set_strand(const struct subject* subject, uint32_t index, float* out)
{
    float angle = 2.399963f * (float)index, up = 1 - 1.2f * ((float)index + 0.5f) / (float)subject->guides;
    float beside = sqrtf(1 - up * up), radius = subject->curled ? 0.008f : 0;
    float at[3] = {SKULL * beside * cosf(angle), SKULL * up, SKULL * beside * sinf(angle)};
    float side[3] = {-sinf(angle), 0, cosf(angle)}, step = LENGTH / (VERTICES - 1);
    float across[3] = {up * side[2], beside * cosf(angle) * side[2] - beside * sinf(angle) * side[0],
                       -up * side[0]};
    step *= 0.6f + 0.4f * (float)(index * 7919 % 1000) / 1000;
    for (uint32_t k = 0; k < VERTICES; ++k, out += 3) {
        float t = (float)k / (VERTICES - 1), size = radius * fminf(1, 4 * t);
        float way[3] = {beside * cosf(angle), up - (subject->straight ? 0 : 1.5f * t), beside * sinf(angle)};
        float norm = sqrtf(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        for (int n = 0; n < 3; ++n) {
            out[n] = at[n] + size * (side[n] * cosf(20 * t) + across[n] * sinf(20 * t));
            at[n] += step * way[n] / norm;
        }
        norm = sqrtf(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
        for (int n = 0; n < 3 && norm < SKULL; ++n) at[n] *= SKULL / norm;
    }
}

static hair_result make_groom(struct subject* subject, const hair_physics* physics)
{
    float* positions = malloc(sizeof(float) * 3 * VERTICES * subject->guides);
    uint32_t* vertices = malloc(sizeof *vertices * subject->guides);
    for (uint32_t i = 0; i < subject->guides && positions && vertices; ++i) {
        vertices[i] = VERTICES;
        set_strand(subject, i, positions + (size_t)3 * VERTICES * i);
    }
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &subject->bench->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = subject->guides;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = VERTICES;
    desc.follower_count = subject->followers;
    desc.physics = subject->prepared ? physics : NULL;
    desc.tasks = subject->tasks;
    hair_strand_attribute stiffness = hair_strand_attribute_default();
    float* factors = malloc(sizeof *factors * subject->guides);
    for (uint32_t i = 0; i < subject->guides && factors; ++i)
        factors[i] = 1 + 1e-5f * (float)(i * 7919 % 1000);
    stiffness.strand_values = factors;
    desc.strand_attributes = &stiffness;
    desc.strand_attribute_count = subject->differs;
    bool is_there = positions && vertices && factors;
    double start = hair_now();
    hair_result result = is_there ? hair_groom_create(&desc, &subject->groom) : HAIR_ERROR_MEMORY;
    subject->groom_ms = hair_now() - start;
    free(positions);
    free(vertices);
    free(factors);
    return result;
}

static hair_result make_hair(struct subject* subject, const hair_physics* physics)
{
    hair_desc desc = hair_desc_default();
    desc.physics = physics;
    // The other mapping needs no reduction of implicit systems.
    if (subject->straight) desc.thread_mapping = HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
    double start = thread_time();
    hair_result result = hair_create(subject->context, subject->groom, &desc, &subject->hair);
    subject->upload_ms = thread_time() - start;
    return result;
}

// Make the groom, the context and the hair.
static bool make(struct subject* subject, const hair_cache* cache)
{
    hair_physics physics = hair_physics_default();
    hair_context_desc desc = hair_context_desc_default();
    if (subject->straight) physics.shape.gravity_preload = 0; // The preload bends guides at rest.
    desc.host = &subject->bench->host;
    desc.get_proc = hair_egl_get_proc;
    desc.cache = cache;
    if (hair_context_create(&desc, &subject->context)) return false;
    double start = thread_time();
    if (make_groom(subject, &physics)) return false;
    double made = thread_time();
    if (make_hair(subject, &physics)) return false;
    subject->create_ms = made - start + subject->upload_ms;
    return true;
}

static void free_subject(struct subject* subject)
{
    hair_destroy(subject->hair);
    hair_groom_destroy(subject->groom);
    hair_context_destroy(subject->context);
    if (subject->targets.framebuffer[HAIR_TARGET_DRAWN]) hair_targets_delete(&subject->targets);
}

static json_t* add_row(const struct subject* subject, const char* name, const char* method)
{
    json_t* row = bench_rows_add(&subject->bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", method);
    bench_set_count(row, "guides", subject->guides);
    bench_set_count(row, "vertices", VERTICES);
    return row;
}

// Creation ----------------------------------------------------------------------------------------

static bool run_creation(struct bench* bench, uint32_t guides, const char* method)
{
    const bool prepared = strcmp(method, "prepared") == 0, differs = strcmp(method, "factors") == 0;
    struct subject subject = {.bench = bench, .guides = guides, .prepared = prepared, .differs = differs};
    bool ok = make(&subject, NULL);
    hair_destroy(subject.hair);
    subject.hair = NULL;
    // The first instance also compiles programs. The second only uploads.
    hair_physics physics = hair_physics_default();
    double first = subject.create_ms - subject.upload_ms;
    ok = ok && !make_hair(&subject, &physics);
    if (ok) {
        double all = 1e3 * (first + subject.upload_ms) / guides, upload = 1e3 * subject.upload_ms / guides;
        json_t* row = add_row(&subject, "create", method);
        bench_set_number(row, "us_per_guide", all);
        bench_set_number(row, "us_upload", upload);
        bench_set_number(row, "us_limit", prepared ? UPLOAD_LIMIT : CREATION_LIMIT);
        bench_set_flag(row, "pass", prepared ? upload <= UPLOAD_LIMIT : all <= CREATION_LIMIT);
    }
    free_subject(&subject);
    return ok;
}

// Measure the elapsed time of hair_groom_create() with tasks on all processors.
static bool run_threads(struct bench* bench, uint32_t guides)
{
    uint32_t threads;
    hair_tasks tasks = bench_pool_tasks(&threads);
    struct subject subject = {.bench = bench, .guides = guides, .prepared = true, .tasks = &tasks};
    hair_physics physics = hair_physics_default();
    bool ok = !make_groom(&subject, &physics);
    if (ok) {
        double each = 1e3 * subject.groom_ms / guides;
        json_t* row = add_row(&subject, "create", "threads");
        bench_set_count(row, "threads", threads);
        bench_set_number(row, "us_per_guide", each);
        bench_set_number(row, "us_limit", CREATION_LIMIT);
        bench_set_flag(row, "pass", each <= CREATION_LIMIT);
    }
    free_subject(&subject);
    return ok;
}

// Cuts --------------------------------------------------------------------------------------------

#define CUT_WAYS 3
#define CUTS 5
static const char* const cut_methods[CUT_WAYS] = {"one guide", "all guides", "other groups"};

// Cut around the tip of a guide, or all guides below a plane that falls with each cut.
static hair_cut_desc cut_of(int way, const float tip[3], int index)
{
    hair_cut_desc cut = hair_cut_desc_default();
    if (way == 0) {
        cut.shape = HAIR_CUT_SHAPE_CAPSULE;
        cut.radius = 0.002f;
        memcpy(cut.start, tip, sizeof cut.start);
        memcpy(cut.end, tip, sizeof cut.end);
    }
    if (way == 1) cut.start[1] = -0.01f * (float)index;
    if (way == 2) cut.groups = 2;
    return cut;
}

// Measure cuts, and the steps after them, which compute the gravity preload.
static bool run_cuts(struct bench* bench, int way, bool curled)
{
    struct subject subject = {
        .bench = bench, .guides = 1000, .followers = 20000, .curled = curled, .prepared = true};
    double cuts[CUTS + 1], steps[CUTS + 1];
    float* at = malloc(sizeof *at * 3 * VERTICES * 1000);
    uint64_t changed = 0;
    bool ok = at && make(&subject, NULL) && !hair_step(subject.hair, 1.0f / 60);
    // The first cut compiles programs.
    for (int i = 0; i <= CUTS && ok; ++i) {
        uint32_t count = 0;
        hair_cut_info info = hair_cut_info_default();
        ok = !hair_read_positions(subject.hair, HAIR_READ_GUIDES, at, 1000 * VERTICES, &count);
        hair_cut_desc cut = cut_of(way, at + 3 * (size_t)(150 * i * VERTICES + VERTICES - 1), CUTS - i);
        double start = thread_time();
        ok = ok && !hair_cut(subject.hair, &cut, &info, NULL);
        cuts[i] = thread_time() - start, start = thread_time();
        ok = ok && !hair_step(subject.hair, 1.0f / 60);
        steps[i] = thread_time() - start;
        changed = info.guides;
    }
    if (ok) {
        json_t* row = add_row(&subject, curled ? "cut curled" : "cut straight", cut_methods[way]);
        bench_set_number(row, "ms", bench_times_of(cuts + 1, CUTS).ms);
        bench_set_number(row, "ms_step", bench_times_of(steps + 1, CUTS).ms);
        bench_set_count(row, "changed", changed);
    }
    free(at);
    free_subject(&subject);
    return ok;
}

// The first frame ---------------------------------------------------------------------------------

static bool draw_frame(struct subject* subject)
{
    hair_view view = hair_view_default();
    view.render_path = HAIR_RENDER_PATH_COMPUTE;
    view.coverage = HAIR_COVERAGE_ALPHA;
    for (int i = 0; i < 3; ++i) view.projection[5 * i] = i < 2 ? 3.0f : -0.5f;
    glBindFramebuffer(GL_FRAMEBUFFER, subject->targets.framebuffer[HAIR_TARGET_DRAWN]);
    glViewport(0, 0, SIZE, SIZE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    bool ok = !hair_step(subject->hair, 1.0f / 60) && !hair_draw(subject->hair, &view);
    glFinish();
    return ok;
}

// Precompile until all is ready. Return the number of calls, or 0 on failure.
static uint32_t precompile(struct subject* subject, double* longest)
{
    hair_view view = hair_view_default();
    view.render_path = HAIR_RENDER_PATH_COMPUTE;
    view.coverage = HAIR_COVERAGE_ALPHA;
    glBindFramebuffer(GL_FRAMEBUFFER, subject->targets.framebuffer[HAIR_TARGET_DRAWN]);
    for (uint32_t calls = 1; calls <= MAX_CALLS; ++calls) {
        bool ready = false;
        double start = hair_now();
        if (hair_precompile(subject->hair, &view, &ready)) return 0;
        *longest = fmax(*longest, hair_now() - start);
        if (ready) return calls;
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    return 0;
}

// Return the number of programs that the driver has compiled.
static uint32_t compiled(const struct subject* subject)
{
    hair_report_info info = hair_report_info_default();
    uint32_t count = 0;
    hair_report(subject->hair, false, &info, NULL, 0, 0, &count);
    return info.compiled_programs;
}

// Measure the first frame after precompile(), which must compile nothing.
static bool run_precompiled(struct subject* subject)
{
    double longest = 0;
    uint32_t calls = precompile(subject, &longest), ready = compiled(subject);
    double start = hair_now();
    if (!calls || !draw_frame(subject)) return false;
    json_t* row = add_row(subject, "first frame", "precompiled");
    bench_set_number(row, "ms", hair_now() - start);
    bench_set_number(row, "ms_longest", longest);
    bench_set_number(row, "ms_limit", CALL_LIMIT);
    bench_set_count(row, "calls", calls);
    bench_set_count(row, "programs", ready);
    bench_set_count(row, "late", compiled(subject) - ready);
    bench_set_flag(row, "pass", compiled(subject) == ready && longest <= CALL_LIMIT);
    return true;
}

// Measure the time from hair_create() to the end of the first frame. NULL `cache` precompiles.
static bool run_frame(struct bench* bench, const hair_cache* cache, const char* method)
{
    struct subject subject = {.bench = bench, .guides = 166, .followers = FOLLOWERS, .prepared = true};
    bool ok = hair_targets_make(&subject.targets, SIZE, SIZE, 1, 1);
    double start = hair_now();
    ok = ok && make(&subject, cache);
    if (ok && !cache) {
        ok = run_precompiled(&subject);
    } else if (ok) {
        ok = draw_frame(&subject);
        double ms = hair_now() - start;
        json_t* row = add_row(&subject, "first frame", method);
        bench_set_number(row, "ms", ms);
        bench_set_count(row, "programs", compiled(&subject));
    }
    free_subject(&subject);
    return ok;
}

// Memory ------------------------------------------------------------------------------------------

static void add_memory_rows(const struct subject* subject, const char* method, double limit)
{
    hair_report_row rows[MAX_ROWS];
    hair_report_info info = hair_report_info_default();
    uint32_t count = 0, vertices = subject->guides * VERTICES;
    if (hair_report(subject->hair, true, &info, rows, sizeof *rows, MAX_ROWS, &count)) return;
    double all = 0;
    for (uint32_t i = 0; i < count && i < MAX_ROWS; ++i) {
        // The memory of followers and pixels does not grow with guides.
        if (strcmp(rows[i].stage, "solve") && strcmp(rows[i].stage, "smooth")) continue;
        json_t* row = add_row(subject, "memory", method);
        bench_set_text(row, "stage", rows[i].stage);
        bench_set_number(row, "bytes", (double)rows[i].bytes / vertices);
        all += (double)rows[i].bytes / vertices;
    }
    json_t* row = add_row(subject, "memory", method);
    bench_set_text(row, "stage", "all");
    bench_set_number(row, "bytes", all);
    bench_set_flag(row, "pass", all <= limit);
}

static bool run_memory(struct bench* bench, bool curled)
{
    struct subject subject = {
        .bench = bench, .guides = 2000, .curled = curled, .straight = !curled, .prepared = true};
    bool ok =
        hair_targets_make(&subject.targets, SIZE, SIZE, 1, 1) && make(&subject, NULL) && draw_frame(&subject);
    if (ok) add_memory_rows(&subject, curled ? "curled" : "straight", curled ? 180 : 120);
    free_subject(&subject);
    return ok;
}

static void run_suite(struct bench* bench)
{
    static const uint32_t guides[] = {1000, 10000, 100000};
    static const char* const creations[] = {"whole", "prepared", "factors"};
    for (size_t i = 0; i < sizeof guides / sizeof *guides; ++i)
        for (int k = 0; k < 3; ++k) {
            if (bench->options.quick && guides[i] > 1000) continue;
            if (bench_begin(bench, "create", creations[k]) && !run_creation(bench, guides[i], creations[k]))
                bench_refuse(bench, "create", creations[k]);
        }
    for (size_t i = 0; i < sizeof guides / sizeof *guides; ++i) {
        if (bench->options.quick && guides[i] > 1000) continue;
        if (bench_begin(bench, "create", "threads") && !run_threads(bench, guides[i]))
            bench_refuse(bench, "create", "threads");
    }
    for (int way = 0; way < CUT_WAYS; ++way)
        for (int curled = 0; curled < 2; ++curled)
            if (bench_begin(bench, curled ? "cut curled" : "cut straight", cut_methods[way]) &&
                !run_cuts(bench, way, curled))
                bench_refuse(bench, curled ? "cut curled" : "cut straight", cut_methods[way]);
    static const char* const methods[] = {"precompiled", "nothing cached", "cached"};
    struct startup_cache programs = {0};
    hair_cache cache = startup_cache_of(&programs);
    GLint formats = 0; // Mesa has no program binaries without its own cache.
    if (!bench->planning) glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    for (int i = 0; i < 3; ++i) {
        if (i == 2 && !bench->planning && formats == 0) continue;
        if (bench_begin(bench, "first frame", methods[i]) &&
            !run_frame(bench, i == 0 ? NULL : &cache, methods[i]))
            bench_refuse(bench, "first frame", methods[i]);
    }
    startup_cache_free(&programs);
    for (int curled = 0; curled < 2; ++curled) {
        const char* method = curled ? "curled" : "straight";
        if (bench_begin(bench, "memory", method) && !run_memory(bench, curled))
            bench_refuse(bench, "memory", method);
    }
}

const struct bench_suite bench_startup = {"startup", "creation, programs of the first frame, memory", columns,
                                          run_suite};
