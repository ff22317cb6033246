// pass.c - programs of passes, and running a pass with its debug group, timer and memory barrier.
#include "lib/gl/commands.h"
#include "lib/gl/frame_profiler.h"

#include <time.h>

// A software rasteriser runs a dispatch at once, and applications must not stall for long. A pass
// is divided into parts. The first is expected to take PROBE ms, by the time of the last run. The
// others are expected to take PART ms, by the time of the part before.
#define PROBE 4.0
#define PART 30.0
#define MAX_GROWTH 8.0 // Maximum ratio of the groups in a part to those in the part before.
#define FIRST_GROUPS 4.0 // Work groups in the first part of a pass that never ran.
// Threads in a dispatch of a GPU. An operating system resets a GPU that takes too long for one.
#define MAX_THREADS (1u << 21)

struct hair_gl_program* hair_gl_find(const struct hair_gl* gl, hair_gl_pass pass)
{
    for (uint32_t i = 0; i < gl->programs; ++i)
        if (gl->program[i]->pass == pass) return gl->program[i];
    return NULL;
}

static struct hair_gl_program* add_program(struct hair_gl* gl, hair_gl_pass pass)
{
    if (gl->programs == gl->room) {
        // NOLINTNEXTLINE(bugprone-sizeof-expression): the elements are pointers.
        void* more = hair_grow(&gl->host, gl->program, sizeof *gl->program, &gl->room, 16);
        if (!more) return NULL;
        gl->program = more;
    }
    HAIR_ASSERT(gl->programs < gl->room);
    struct hair_gl_program* own = hair_alloc(&gl->host, 1, sizeof *own);
    if (!own) return NULL;
    own->pass = pass;
    hair_gl_write_label(pass, own->label, sizeof own->label);
    return gl->program[gl->programs++] = own;
}

struct hair_gl_program* hair_gl_get_or_add(struct hair_gl* gl, hair_gl_pass pass)
{
    struct hair_gl_program* known = hair_gl_find(gl, pass);
    if (!known) known = add_program(gl, pass);
    if (!known) hair_fail_memory(&gl->host, "a pass");
    return known;
}

void hair_gl_free_programs(struct hair_gl* gl)
{
    for (uint32_t i = 0; i < gl->programs; ++i) {
        struct hair_gl_program* own = gl->program[i];
        if (own->program) hair_gl_delete_program(gl, own->program);
        if (own->begun) hair_gl_delete_program(gl, own->begun);
        if (own->timer.query[0][0]) gl->DeleteQueries(2 * HAIR_GL_TIMER_DEPTH, own->timer.query[0]);
        hair_free(&gl->host, own);
    }
    hair_free(&gl->host, gl->program);
    hair_free(&gl->host, gl->inputs);
    gl->inputs = NULL;
    gl->inputs_count = gl->inputs_room = 0;
}

// Write a timestamp, unless the driver has made no queries. The time is 0 then.
static void write_time(struct hair_gl* gl, GLuint query)
{
    if (query) gl->QueryCounter(query, GL_TIMESTAMP);
}

void hair_gl_begin(struct hair_gl* gl, hair_gl_pass pass)
{
    struct hair_gl_program* own = hair_gl_find(gl, pass);
    HAIR_ASSERT(own);
    own->is_warm = true;
    hair_gl_profiler_begin(gl, pass);
    if (hair_gl_is_recording(gl)) return;
    struct hair_gl_timer* timer = &own->timer;
    gl->PushDebugGroup(GL_DEBUG_SOURCE_THIRD_PARTY, (GLuint)pass, -1, own->label);
    // Use timestamps, because the application may have an elapsed-time query active.
    if (gl->timings) {
        if (!timer->query[0][0]) {
            gl->CreateQueries(GL_TIMESTAMP, 2 * HAIR_GL_TIMER_DEPTH, timer->query[0]);
            timer->read = timer->begun; // Runs without queries have no results.
        }
        hair_gl_pass_ms(gl, own); // Read the results before the slot is reused.
        write_time(gl, timer->query[timer->begun % HAIR_GL_TIMER_DEPTH][0]);
    }
    hair_gl_use_program(gl, own->program);
}

void hair_gl_end(struct hair_gl* gl, hair_gl_pass pass)
{
    if (hair_gl_is_recording(gl)) return;
    struct hair_gl_program* own = hair_gl_find(gl, pass);
    HAIR_ASSERT(own);
    struct hair_gl_timer* timer = &own->timer;
    hair_gl_profiler_end(gl, pass);
    if (gl->timings) write_time(gl, timer->query[timer->begun % HAIR_GL_TIMER_DEPTH][1]);
    ++timer->begun;
    gl->PopDebugGroup();
}

static void wait_for_writes(struct hair_gl* gl)
{
    hair_gl_barrier(gl, GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                            GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                            GL_ELEMENT_ARRAY_BARRIER_BIT);
}

// Return the wall time in ms. The C library of Windows has no timespec_get(), and its clock() tells
// wall time.
double hair_gl_now(void)
{
#ifdef _WIN32
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
#else
    struct timespec time = {0};
    timespec_get(&time, TIME_UTC);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
#endif
}

// Work groups of a pass to dispatch: those from `first` up to, not including, `end`, of all.
struct groups {
    uint32_t first, end, all;
};

// Return the work groups in a dispatch of a GPU.
static uint32_t find_max_groups(struct hair_gl* gl, GLuint program)
{
    GLint size[3] = {0};
    gl->GetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, size);
    uint32_t threads = (uint32_t)size[0] * (uint32_t)size[1] * (uint32_t)size[2];
    uint32_t max = MAX_THREADS / (threads ? threads : 1);
    return max < HAIR_MAX_GROUPS ? max : HAIR_MAX_GROUPS;
}

void hair_gl_limit_groups(struct hair_gl* gl, hair_gl_pass pass, uint32_t max)
{
    struct hair_gl_program* own = hair_gl_find(gl, pass);
    HAIR_ASSERT(own && own->program && max > 0);
    uint32_t all =
        own->max_groups_of_threads ? own->max_groups_of_threads : find_max_groups(gl, own->program);
    own->max_groups_of_threads = all;
    own->max_groups = max < all ? max : all;
}

// Return the work groups that are expected to take `ms`.
static uint32_t expect_groups(double ms, double ms_per_group, double max)
{
    double groups = ms_per_group > 0 ? ms / ms_per_group : max;
    if (groups > max) groups = max;
    return groups < 1 ? 1 : groups > HAIR_MAX_GROUPS ? HAIR_MAX_GROUPS : (uint32_t)groups;
}

// Let the next call dispatch all groups at once. `last` is the number of groups in the last part.
static void end_parts(struct hair_gl* gl, GLuint program, uint32_t last, struct groups groups)
{
    if (last < groups.all) hair_gl_dispatch_whole(gl, program);
}

// Dispatch parts that take long enough.
static void dispatch_by_time(struct hair_gl* gl, struct hair_gl_program* own, GLuint program,
                             struct groups groups)
{
    double start = hair_gl_now(), begun = start, max = own->ms_per_group > 0 ? HAIR_MAX_GROUPS : FIRST_GROUPS;
    uint32_t count = 0, part = expect_groups(PROBE, own->ms_per_group, max);
    for (uint32_t first = groups.first; first < groups.end; first += count) {
        count = groups.end - first < part ? groups.end - first : part;
        hair_gl_dispatch(gl, program, first, count, groups.all);
        wait_for_writes(gl);
        double end = hair_gl_now();
        part = expect_groups(PART, (end - begun) / count, MAX_GROWTH * count);
        begun = end;
    }
    own->ms_per_group = (begun - start) / (groups.end - groups.first);
    end_parts(gl, program, count, groups);
}

// Dispatch parts that no GPU takes long for.
static void dispatch_by_count(struct hair_gl* gl, struct hair_gl_program* own, GLuint program,
                              struct groups groups)
{
    uint32_t count = 0;
    if (!own->max_groups) own->max_groups = find_max_groups(gl, program);
    for (uint32_t first = groups.first; first < groups.end; first += count) {
        count = groups.end - first < own->max_groups ? groups.end - first : own->max_groups;
        hair_gl_dispatch(gl, program, first, count, groups.all);
    }
    // Before the barrier, because other streams may run the program for all groups until there.
    end_parts(gl, program, count, groups);
    wait_for_writes(gl); // The parts do not read what others write.
}

static void dispatch(struct hair_gl* gl, struct hair_gl_program* own, GLuint program, struct groups groups)
{
    HAIR_ASSERT(own && program && groups.first < groups.end && groups.end <= groups.all);
    bool by_time = gl->software && !hair_gl_is_recording(gl);
    if (by_time)
        dispatch_by_time(gl, own, program, groups);
    else
        dispatch_by_count(gl, own, program, groups);
}

void hair_gl_run_part(struct hair_gl* gl, hair_gl_pass pass, uint32_t first, uint32_t end, uint32_t groups)
{
    struct hair_gl_program* own = hair_gl_find(gl, pass);
    HAIR_ASSERT(own);
    hair_gl_begin(gl, pass);
    dispatch(gl, own, own->program, (struct groups){first, end, groups});
    hair_gl_end(gl, pass);
}

void hair_gl_run(struct hair_gl* gl, hair_gl_pass pass, uint32_t groups)
{
    if (groups > 0) hair_gl_run_part(gl, pass, 0, groups, groups);
}

void hair_gl_run_with(struct hair_gl* gl, hair_gl_pass pass, GLuint program, uint32_t groups)
{
    if (groups == 0) return;
    HAIR_ASSERT(program);
    hair_gl_begin(gl, pass);
    hair_gl_use_program(gl, program);
    dispatch(gl, hair_gl_find(gl, pass), program, (struct groups){0, groups, groups});
    hair_gl_end(gl, pass);
}

void hair_gl_run_indirect(struct hair_gl* gl, hair_gl_pass pass, GLuint program, GLuint buffer, size_t at)
{
    HAIR_ASSERT(program && buffer && at % 4 == 0);
    hair_gl_begin(gl, pass);
    hair_gl_use_program(gl, program);
    if (gl->software && !hair_gl_is_recording(gl)) {
        GLuint groups[3] = {0};
        gl->GetNamedBufferSubData(buffer, (GLintptr)at, sizeof groups, groups);
        HAIR_ASSERT(groups[0] <= HAIR_MAX_GROUPS && groups[1] <= HAIR_MAX_GROUPS);
        uint32_t all = groups[0] * groups[1];
        if (all) dispatch(gl, hair_gl_find(gl, pass), program, (struct groups){0, all, all});
    } else {
        hair_gl_dispatch_indirect(gl, program, buffer, at);
        wait_for_writes(gl);
    }
    hair_gl_end(gl, pass);
}

static void read_timer(struct hair_gl* gl, struct hair_gl_timer* timer)
{
    if (timer->begun - timer->read > HAIR_GL_TIMER_DEPTH) timer->read = timer->begun - HAIR_GL_TIMER_DEPTH;
    HAIR_ASSERT(timer->read <= timer->begun);
    for (; timer->read < timer->begun; ++timer->read) {
        const GLuint* query = timer->query[timer->read % HAIR_GL_TIMER_DEPTH];
        GLuint64 there = 0, start = 0, end = 0;
        gl->GetQueryObjectui64v(query[1], GL_QUERY_RESULT_AVAILABLE, &there);
        if (!there) break;
        gl->GetQueryObjectui64v(query[0], GL_QUERY_RESULT, &start);
        gl->GetQueryObjectui64v(query[1], GL_QUERY_RESULT, &end);
        timer->ms = (float)((double)(end - start) * 1e-6);
        timer->total += (double)(end - start) * 1e-6;
    }
}

float hair_gl_pass_ms(struct hair_gl* gl, struct hair_gl_program* of)
{
    if (!of->timer.query[0][0]) return 0;
    GLint buffer = hair_gl_begin_query_reads(gl);
    read_timer(gl, &of->timer);
    hair_gl_end_query_reads(gl, buffer);
    return of->timer.ms;
}
