// bounds.c - Suite `bounds`, the time of each kind of work, its lower bound on this machine, and
// its bottleneck. Kinds of work are measured only where the driver's timers measure compute.
#include "tools/bench/scene.h"
#include "tools/bench/studio.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 720
#define FRAMES 31
#define MAX_CATEGORIES 32
#define WARM 300 // ms
#define MORE 4 // factor of guides and followers

static const char* const columns[] = {"case",     "method",   "pass",     "guides", "followers", "runs",
                                      "ms",       "ms_more",  "ms_small", "bytes",  "launch_ms", "bytes_ms",
                                      "floor_ms", "of_floor", "bound",    NULL};

static const struct point {
    const char* name;
    uint32_t guides, followers;
    bool quick;
} points[] = {{"demo", 166, 18000, true}, {"many guides", 1024, 18000, false}};

// Lower bounds of this machine.
struct floors {
    double launch; // time of an empty pass, ms
    double byte; // time to read or write a byte, ms
};

struct work {
    const char* name;
    char pass[128];
    uint32_t runs, times;
    uint64_t bytes;
    double ms[FRAMES];
};

// Floors ------------------------------------------------------------------------------------------

static GLuint make_program(const char* text)
{
    return glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
}

static double time_launch(struct bench_timer* timer)
{
    enum { LAUNCHES = 100 };
    double ms[FRAMES];
    GLuint program = make_program("#version 450 core\n"
                                  "layout(local_size_x = 64) in;\n"
                                  "void main() {}\n");
    for (int i = 0; i < FRAMES; ++i) {
        glUseProgram(program);
        bench_timer_start(timer);
        for (int k = 0; k < LAUNCHES; ++k) {
            glDispatchCompute(1, 1, 1);
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        }
        bench_timer_stop(timer);
        ms[i] = bench_timer_take(timer) / LAUNCHES;
    }
    glUseProgram(0);
    glDeleteProgram(program);
    return bench_times_of(ms, FRAMES).ms;
}

static double time_byte(struct bench_timer* timer, int frames)
{
    enum { GROUPS = 65535, GROUP = 256, BYTES = GROUPS * GROUP * 16 };
    double ms[FRAMES];
    GLuint buffer[2];
    GLuint program =
        make_program("#version 450 core\n"
                     "layout(local_size_x = 256) in;\n"
                     "layout(std430, binding = 0) readonly buffer from_buffer { vec4 from[]; };\n"
                     "layout(std430, binding = 1) writeonly buffer to_buffer { vec4 to[]; };\n"
                     "void main() { to[gl_GlobalInvocationID.x] = from[gl_GlobalInvocationID.x]; }\n");
    glCreateBuffers(2, buffer);
    for (int i = 0; i < 2; ++i) glNamedBufferStorage(buffer[i], BYTES, NULL, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffer);
    for (int i = 0; i < frames; ++i) {
        glUseProgram(program);
        bench_timer_start(timer);
        glDispatchCompute(GROUPS, 1, 1);
        bench_timer_stop(timer);
        ms[i] = bench_timer_take(timer) / (2.0 * BYTES);
    }
    glUseProgram(0);
    glDeleteProgram(program);
    glDeleteBuffers(2, buffer);
    return bench_times_of(ms, (uint32_t)frames).ms;
}

static void add_floor(struct bench* bench, const char* name, double bytes, double ms)
{
    json_t* row = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", "machine");
    bench_set_text(row, "method", name);
    bench_set_number(row, "bytes", bytes);
    bench_set_number(row, "floor_ms", ms);
}

static struct floors measure_floors(struct bench* bench)
{
    struct floors floors = {0, 0};
    struct bench_timer timer;
    if (!bench_begin(bench, "machine", "floors")) return floors;
    bench_timer_make(&timer, bench->software);
    floors = (struct floors){time_launch(&timer), time_byte(&timer, bench->options.quick ? 5 : FRAMES)};
    bench_timer_free(&timer);
    add_floor(bench, "a pass that does nothing", 0, floors.launch);
    add_floor(bench, "a gigabyte moved", 1e9, 1e9 * floors.byte);
    return floors;
}

// Work --------------------------------------------------------------------------------------------

static bool look(struct bench_studio* studio, struct work works[MAX_CATEGORIES], uint32_t* count)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[MAX_CATEGORIES];
    if (hair_report(studio->hair, true, &info, rows, sizeof *rows, MAX_CATEGORIES, count)) return false;
    for (uint32_t i = 0; i < *count && i < MAX_CATEGORIES; ++i) {
        struct work* work = &works[i];
        work->name = rows[i].stage;
        work->bytes = rows[i].bytes;
        if (!rows[i].runs || work->times == FRAMES) continue;
        work->runs = rows[i].runs;
        snprintf(work->pass, sizeof work->pass, "%s", rows[i].pass);
        work->ms[work->times++] = (double)rows[i].ms;
    }
    return true;
}

// Simulate and draw frames of a head that shakes.
static bool live(struct bench* bench, const struct point* point, uint32_t times, uint32_t size,
                 struct work works[MAX_CATEGORIES], uint32_t* count)
{
    struct bench_studio studio;
    struct bench_studio_desc desc = {.scene = "demo",
                                     .size = size,
                                     .guides = times * point->guides,
                                     .followers = times * point->followers,
                                     .solver = HAIR_SOLVER_DIRECT};
    memset(works, 0, MAX_CATEGORIES * sizeof *works);
    if (!bench_studio_make(bench, &desc, &studio)) return false;
    struct bench_shot shot = bench_studio_shot(&studio);
    shot.samples = 4;
    shot.view.render_path = HAIR_RENDER_PATH_AUTO;
    bool done = bench_studio_set(&studio, &shot);
    for (int i = 0; i < FRAMES + 2 && done; ++i) { // The first two frames compile shaders.
        if (i == 2) done = bench_studio_warm_up(&studio, WARM);
        done = done && bench_studio_step(&studio, NULL) && bench_studio_draw(&studio, NULL);
        glFinish();
        if (done && i > 1) done = look(&studio, works, count);
    }
    bench_studio_free(&studio);
    return done;
}

static bool draws(const struct work* work)
{
    return !strcmp(work->name, "color") || !strcmp(work->name, "depth");
}

// Return whether the work touches all of its memory. The field is written only where something
// moved.
static bool moves_all(const struct work* work)
{
    return !draws(work) && strcmp(work->name, "field") != 0;
}

// Name the bottleneck. If four times the work takes less than twice the time, threads are idle and
// wait for each other or for memory.
static const char* name_bound(const struct work* work, double ms, double more, double small, double launch,
                              double moved)
{
    if (ms < 4 * launch) return "launch";
    if (ms < 2 * moved) return "bandwidth";
    if (more < 0.5 * MORE * ms) return "latency";
    if (!draws(work)) return "arithmetic";
    return small > 0.6 * ms ? "vertices" : "pixels";
}

static double median(struct work* work)
{
    return work->times ? bench_times_of(work->ms, work->times).ms : 0;
}

static void add_row(struct bench* bench, const struct point* point, const struct floors* floors,
                    struct work* work, struct work* more, struct work* small)
{
    double ms = median(work), grown = median(more), shrunk = median(small);
    double launch = floors->launch * work->runs;
    double moved = moves_all(work) ? floors->byte * (double)work->bytes : 0;
    double min = launch > moved ? launch : moved;
    json_t* row = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", point->name);
    bench_set_text(row, "method", work->name);
    bench_set_text(row, "pass", work->pass);
    bench_set_count(row, "guides", point->guides);
    bench_set_count(row, "followers", point->followers);
    bench_set_count(row, "runs", work->runs);
    bench_set_number(row, "ms", ms);
    bench_set_number(row, "ms_more", grown);
    bench_set_number(row, "ms_small", shrunk);
    bench_set_number(row, "bytes", (double)work->bytes);
    if (!draws(work)) { // The maximum rates of vertices and pixels are unknown.
        bench_set_number(row, "launch_ms", launch);
        bench_set_number(row, "bytes_ms", moved);
        bench_set_number(row, "floor_ms", min);
        bench_set_number(row, "of_floor", ms / min);
    }
    bench_set_text(row, "bound", name_bound(work, ms, grown, shrunk, launch, moved));
}

static void measure(struct bench* bench, const struct point* point, const struct floors* floors)
{
    // The work itself, more work, and a picture of half the width and height.
    static struct work works[3][MAX_CATEGORIES];
    uint32_t count[3] = {0, 0, 0}, size = bench->options.size ? bench->options.size : SIZE;
    if (!bench_begin(bench, point->name, "direct")) return;
    for (uint32_t i = 0; i < 3; ++i)
        if (!live(bench, point, i == 1 ? MORE : 1, i == 2 ? size / 2 : size, works[i], &count[i])) {
            bench_refuse(bench, point->name, "direct");
            return;
        }
    for (uint32_t i = 0; i < count[0] && i < MAX_CATEGORIES; ++i)
        if (works[0][i].times) add_row(bench, point, floors, &works[0][i], &works[1][i], &works[2][i]);
}

static void run_suite(struct bench* bench)
{
    struct floors floors = measure_floors(bench);
    // Timers do not measure compute.
    if (bench->software || (!bench->planning && floors.launch == 0)) return;
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i)
        if (points[i].quick || !bench->options.quick) measure(bench, &points[i], &floors);
}

const struct bench_suite bench_bounds = {
    "bounds", "each kind of work on a GPU: its time, what that cannot be less than, what holds it up",
    columns, run_suite};
