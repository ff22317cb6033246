// bounds.c - the suite `bounds`: how long each kind of work takes, what it could not take less than on this machine, and what
// holds it up. Kinds of work only where the driver's timers see compute.
#include "tools/bench/scene.h"
#include "tools/bench/studio.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 720
#define FRAMES 31
#define MOST_WORKS 32
#define MORE 4 // times as much of everything, to see how time grows

static const char* const columns[] = {"case",     "method",   "pass",     "guides", "followers",
                                      "runs",     "ms",       "ms_more",  "bytes",  "launch_ms",
                                      "bytes_ms", "floor_ms", "of_floor", "bound",  NULL};

static const struct point {
    const char* name;
    uint32_t    guides, followers;
    bool        quick;
} points[] = {{"demo", 166, 18000, true}, {"many guides", 10240, 10240, false}};

// What the machine cannot do faster.
struct floors {
    double launch; // of a pass that does nothing. ms
    double byte;   // read or written. ms
};

struct work {
    const char* name;
    char        pass[128];
    uint32_t    runs, times;
    uint64_t    bytes;
    double      ms[FRAMES];
};

// Floors ----------------------------------------------------------------------------------------------------

static GLuint make_nothing(void)
{
    static const char* text = "#version 450 core\nlayout(local_size_x = 64) in;\nvoid main() {}\n";
    return glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
}

static double time_launch(struct bench_timer* timer)
{
    enum { LAUNCHES = 100 };
    double ms[FRAMES];
    GLuint program = make_nothing();
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

static double time_byte(struct bench_timer* timer)
{
    enum { BYTES = 1 << 28 };
    double ms[FRAMES];
    GLuint buffer[2];
    glCreateBuffers(2, buffer);
    for (int i = 0; i < 2; ++i) glNamedBufferStorage(buffer[i], BYTES, NULL, 0);
    for (int i = 0; i < FRAMES; ++i) {
        bench_timer_start(timer);
        glCopyNamedBufferSubData(buffer[0], buffer[1], 0, 0, BYTES);
        bench_timer_stop(timer);
        ms[i] = bench_timer_take(timer) / (2.0 * BYTES);
    }
    glDeleteBuffers(2, buffer);
    return bench_times_of(ms, FRAMES).ms;
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
    struct floors      floors = {0, 0};
    struct bench_timer timer;
    if (!bench_begin(bench, "machine", "floors")) return floors;
    bench_timer_make(&timer, bench->software);
    floors = (struct floors){time_launch(&timer), time_byte(&timer)};
    bench_timer_free(&timer);
    add_floor(bench, "a pass that does nothing", 0, floors.launch);
    add_floor(bench, "a gigabyte moved", 1e9, 1e9 * floors.byte);
    return floors;
}

// Work ------------------------------------------------------------------------------------------------------

static bool look(struct bench_studio* studio, struct work works[MOST_WORKS], uint32_t* count)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row  rows[MOST_WORKS];
    if (hair_report(studio->hair, 1, &info, rows, sizeof *rows, MOST_WORKS, count)) return false;
    for (uint32_t i = 0; i < *count && i < MOST_WORKS; ++i) {
        struct work* work = &works[i];
        work->name        = rows[i].work;
        work->bytes       = rows[i].bytes;
        if (!rows[i].runs || work->times == FRAMES) continue;
        work->runs = rows[i].runs;
        snprintf(work->pass, sizeof work->pass, "%s", rows[i].pass);
        work->ms[work->times++] = (double)rows[i].ms;
    }
    return true;
}

// Frames of a head that shakes, each stepped and drawn.
static bool live(struct bench* bench, const struct point* point, uint32_t times,
                 struct work works[MOST_WORKS], uint32_t* count)
{
    struct bench_studio      studio;
    struct bench_studio_desc desc = {.scene     = "demo",
                                     .size      = bench->options.size ? bench->options.size : SIZE,
                                     .guides    = times * point->guides,
                                     .followers = times * point->followers,
                                     .solver    = HAIR_SOLVER_DIRECT};
    memset(works, 0, MOST_WORKS * sizeof *works);
    if (!bench_studio_make(bench, &desc, &studio)) return false;
    struct bench_shot shot = bench_studio_shot(&studio);
    shot.samples           = 4;
    bool done              = bench_studio_set(&studio, &shot);
    for (int i = 0; i < FRAMES + 2 && done; ++i) { // The first two compile what they need.
        done = bench_studio_step(&studio, NULL) && bench_studio_draw(&studio, NULL);
        glFinish();
        if (done && i > 1) done = look(&studio, works, count);
    }
    bench_studio_free(&studio);
    return done;
}

// Four times the work in less than twice the time leaves threads idle that wait for each other or for memory.
static const char* name_bound(double ms, double more, double launch, double moved)
{
    if (ms < 4 * launch) return "launch";
    if (ms < 2 * moved) return "bandwidth";
    return more < 0.5 * MORE * ms ? "latency" : "throughput";
}

static void add_row(struct bench* bench, const struct point* point, const struct floors* floors,
                    struct work* work, struct work* more)
{
    double  ms     = bench_times_of(work->ms, work->times).ms;
    double  grown  = more->times ? bench_times_of(more->ms, more->times).ms : 0;
    double  launch = floors->launch * work->runs, moved = floors->byte * (double)work->bytes;
    double  least = launch > moved ? launch : moved;
    json_t* row   = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", point->name);
    bench_set_text(row, "method", work->name);
    bench_set_text(row, "pass", work->pass);
    bench_set_count(row, "guides", point->guides);
    bench_set_count(row, "followers", point->followers);
    bench_set_count(row, "runs", work->runs);
    bench_set_number(row, "ms", ms);
    bench_set_number(row, "ms_more", grown);
    bench_set_number(row, "bytes", (double)work->bytes);
    bench_set_number(row, "launch_ms", launch);
    bench_set_number(row, "bytes_ms", moved);
    bench_set_number(row, "floor_ms", least);
    bench_set_number(row, "of_floor", ms / least);
    bench_set_text(row, "bound", name_bound(ms, grown, launch, moved));
}

static void measure(struct bench* bench, const struct point* point, const struct floors* floors)
{
    static struct work works[2][MOST_WORKS];
    uint32_t           count[2] = {0, 0};
    if (!bench_begin(bench, point->name, "direct")) return;
    for (uint32_t i = 0; i < 2; ++i)
        if (!live(bench, point, i ? MORE : 1, works[i], &count[i])) {
            bench_refuse(bench, point->name, "direct");
            return;
        }
    for (uint32_t i = 0; i < count[0] && i < MOST_WORKS; ++i)
        if (works[0][i].times) add_row(bench, point, floors, &works[0][i], &works[1][i]);
}

static void run_suite(struct bench* bench)
{
    struct floors floors = measure_floors(bench);
    if (bench->software || (!bench->planning && floors.launch == 0)) return; // Its timers do not see compute.
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i)
        if (points[i].quick || !bench->options.quick) measure(bench, &points[i], &floors);
}

const struct bench_suite bench_bounds = {
    "bounds", "each kind of work on a GPU: its time, what that cannot be less than, what holds it up",
    columns, run_suite};
