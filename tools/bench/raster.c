// raster.c - Suite `raster`, compute rasterization against a naive shader that does the same. The
// naive shader has a thread per segment, which goes along the segment pixel by pixel. Both find the
// nearest segment of every sample. Only GPUs whose timers measure compute, with 64-bit atomics, are
// compared.
#include "tools/bench/extent.h"
#include "tools/bench/studio.h"

#include <epoxy/gl.h>
#include <hair/hair_buffers.h>
#include <string.h>

#define ROUNDS 15
#define WARM 200 // ms
#define MAX_RATIO 1.0

static const char* const columns[] = {"case", "method", "strands", "segments", "size",  "samples", "runs",
                                      "ms",   "ms_min", "ms_max",  "ratio",    "limit", "pass",    NULL};

static const struct point {
    const char* name;
    uint32_t followers, segments;
} points[] = {{"18000", 18000, 24}, {"100000", 100000, 24}, {"100000 x 64", 100000, 64}};
static const uint32_t sizes[] = {1080, 2160}, samples[] = {1, 4, 8};

// `count` holds the segments, the segments of a strand, the pixels of a side and the samples.
// `pixels` is the number of pixels of a metre at a distance of 1 m.
static const char text[] =
    "#version 450 core\n"
    "#extension GL_ARB_gpu_shader_int64 : require\n"
    "#extension GL_NV_shader_atomic_int64 : require\n"
    "layout(local_size_x = 256) in;\n"
    "layout(std430, binding = 0) readonly buffer vertex_buffer { vec4 vertex[]; };\n"
    "layout(std430, binding = 1) buffer nearest_buffer { uint64_t nearest[]; };\n"
    "layout(location = 0) uniform mat4 to_window;\n"
    "layout(location = 1) uniform uvec4 count;\n"
    "layout(location = 2) uniform float pixels;\n"
    "layout(location = 3) uniform vec2 place[8];\n"
    "void main()\n"
    "{\n"
    "    uint i = gl_GlobalInvocationID.x, k = i / count.y * (count.y + 1u) + i % count.y;\n"
    "    if (i >= count.x) return;\n"
    "    vec4 a = to_window * vec4(vertex[k].xyz, 1.0), b = to_window * vec4(vertex[k + 1u].xyz, 1.0);\n"
    "    vec3 from = a.xyz / a.w, way = b.xyz / b.w - from;\n"
    "    float wide = vertex[k].w * pixels / a.w, far = max(abs(way.x), abs(way.y));\n"
    "    bool upright = abs(way.y) > abs(way.x);\n"
    "    int beside = int(ceil(1.42 * wide + 0.5));\n"
    "    for (float n = 0.0; n <= far; n += 1.0)\n"
    "        for (int j = -beside; j <= beside; ++j) {\n"
    "            ivec2 side = upright ? ivec2(j, 0) : ivec2(0, j);\n"
    "            ivec2 p = ivec2(floor(from.xy + n / far * way.xy)) + side;\n"
    "            if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, ivec2(count.z)))) continue;\n"
    "            for (uint s = 0u; s < count.w; ++s) {\n"
    "                vec2 off = vec2(p) + place[s] - from.xy;\n"
    "                float t = dot(off, way.xy) / dot(way.xy, way.xy);\n"
    "                if (t < 0.0 || t > 1.0 || distance(off, t * way.xy) > wide) continue;\n"
    "                uint at = (uint(p.y) * count.z + uint(p.x)) * count.w + s;\n"
    "                uint64_t own = packUint2x32(uvec2(i, floatBitsToUint(from.z + t * way.z)));\n"
    "                if (own < nearest[at]) atomicMin(nearest[at], own);\n"
    "            }\n"
    "        }\n"
    "}\n";

struct scene {
    struct bench* bench;
    struct bench_studio studio;
    GLuint program, nearest;
    struct bench_timer timer;
};

// Compute the matrix from the origin of the strands to pixels, with depth in [0, 1], all times w.
static void find_matrix(struct scene* scene, const hair_buffers* strands, uint32_t size, float out[16],
                        float* pixels)
{
    struct hair_matrices camera;
    float clip[16], side = 0.5f * (float)size;
    bench_extent_aim(&scene->studio, &camera);
    hair_light_clip(&camera, clip);
    for (int i = 0; i < 4; ++i) {
        clip[12 + i] += clip[i] * (float)strands->origin[0] + clip[4 + i] * (float)strands->origin[1] +
                        clip[8 + i] * (float)strands->origin[2];
    }
    for (int column = 0; column < 4; ++column) {
        const float* c = clip + 4 * column;
        out[4 * column] = side * (c[0] + c[3]);
        out[4 * column + 1] = side * (c[1] + c[3]);
        out[4 * column + 2] = 0.5f * (c[2] + c[3]);
        out[4 * column + 3] = c[3];
    }
    *pixels = side * camera.projection[5];
}

// Run the naive shader. Return its time in ms with that of the clear, or a negative number if the
// library refuses the strands.
static double run_naive(struct scene* scene, uint32_t size, uint32_t count)
{
    static const uint32_t none = UINT32_MAX;
    hair_buffers strands = hair_buffers_default();
    float matrix[16], pixels, places[16];
    strands.attributes = HAIR_ATTRIBUTE_POSITION | HAIR_ATTRIBUTE_RADIUS;
    if (hair_get_buffers(scene->studio.hair, HAIR_READ_FOLLOWERS, &strands)) return -1;
    find_matrix(scene, &strands, size, matrix, &pixels);
    uint32_t each = strands.strand_vertices - 1, segments = each * strands.strand_count;
    glBindFramebuffer(GL_FRAMEBUFFER, scene->studio.targets.framebuffer[HAIR_TARGET_DRAWN]);
    for (GLuint i = 0; i < count; ++i) {
        places[2 * i] = places[2 * i + 1] = 0.5f;
        if (count > 1) glGetMultisamplefv(GL_SAMPLE_POSITION, i, places + 2 * i);
    }
    glUseProgram(scene->program);
    glUniformMatrix4fv(0, 1, GL_FALSE, matrix);
    glUniform4ui(1, segments, each, size, count);
    glUniform1f(2, pixels);
    glUniform2fv(3, (GLsizei)count, places);
    const GLuint buffers[] = {strands.position.buffer, scene->nearest};
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
    bench_timer_start(&scene->timer);
    glClearNamedBufferData(scene->nearest, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    glDispatchCompute((segments + 255) / 256, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    bench_timer_stop(&scene->timer);
    glUseProgram(0);
    return bench_timer_take(&scene->timer);
}

// Return the time of the same passes in the last draw of the library, ms.
static double own_time(struct scene* scene)
{
    hair_timing passes[BENCH_MAX_PASSES];
    double ms = 0;
    glFinish();
    uint32_t count = hair_get_timings(scene->bench->context, passes, BENCH_MAX_PASSES);
    for (uint32_t i = 0; i < count && i < BENCH_MAX_PASSES; ++i)
        if (!strcmp(passes[i].pass, "draw/raster_clear") || !strcmp(passes[i].pass, "draw/raster"))
            ms += (double)passes[i].ms;
    return ms;
}

static void add_row(struct scene* scene, const struct point* point, const char* method,
                    const struct bench_times* times, double ratio)
{
    json_t* row = bench_rows_add(&scene->bench->rows);
    bench_set_text(row, "case", point->name);
    bench_set_text(row, "method", method);
    bench_set_count(row, "strands", point->followers);
    bench_set_count(row, "segments", point->segments);
    bench_set_count(row, "size", scene->studio.size);
    bench_set_count(row, "samples", scene->studio.shot.samples);
    bench_set_count(row, "runs", times->runs);
    bench_set_number(row, "ms", times->ms);
    bench_set_number(row, "ms_min", times->ms_min);
    bench_set_number(row, "ms_max", times->ms_max);
    if (ratio <= 0) return;
    bench_set_number(row, "ratio", ratio);
    bench_set_number(row, "limit", MAX_RATIO);
    bench_set_flag(row, "pass", ratio <= MAX_RATIO);
}

// Compare both by turns, because the clock of a GPU changes.
static bool compare(struct scene* scene, const struct point* point, uint32_t count)
{
    struct bench_studio* studio = &scene->studio;
    struct bench_shot shot = bench_studio_shot(studio);
    double own[ROUNDS], naive[ROUNDS];
    uint32_t rounds = scene->bench->options.quick ? 3 : ROUNDS;
    shot.samples = count;
    shot.view.render_path = HAIR_RENDER_PATH_COMPUTE;
    if (!bench_studio_set(studio, &shot)) return false;
    glCreateBuffers(1, &scene->nearest);
    glNamedBufferStorage(scene->nearest, (GLsizeiptr)8 * studio->size * studio->size * count, NULL, 0);
    bool ok = bench_studio_warm_up(studio, WARM) && run_naive(scene, studio->size, count) >= 0;
    for (uint32_t i = 0; i < rounds && ok; ++i) {
        ok = bench_studio_draw(studio, NULL);
        own[i] = own_time(scene);
        naive[i] = run_naive(scene, studio->size, count);
        ok = ok && naive[i] >= 0;
    }
    glDeleteBuffers(1, &scene->nearest);
    if (!ok) return false;
    struct bench_times ours = bench_times_of(own, rounds), theirs = bench_times_of(naive, rounds);
    add_row(scene, point, "compute", &ours, ours.ms / theirs.ms);
    add_row(scene, point, "naive", &theirs, 0);
    return true;
}

static bool run_size(struct bench* bench, const struct point* point, uint32_t size)
{
    struct scene scene = {.bench = bench};
    const char* source = text;
    struct bench_studio_desc desc = {
        .scene = "demo", .size = size, .followers = point->followers, .segments = point->segments};
    if (!bench_studio_make(bench, &desc, &scene.studio)) return false;
    scene.studio.bare = true;
    scene.program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
    bench_timer_make(&scene.timer, bench->software);
    GLint linked = 0;
    glGetProgramiv(scene.program, GL_LINK_STATUS, &linked);
    bool ok = linked;
    for (size_t i = 0; i < sizeof samples / sizeof *samples && ok; ++i)
        ok = compare(&scene, point, samples[i]);
    bench_timer_free(&scene.timer);
    glDeleteProgram(scene.program);
    bench_studio_free(&scene.studio);
    return ok;
}

static void run_suite(struct bench* bench)
{
    if (!bench->planning && (bench->software || !epoxy_has_gl_extension("GL_NV_shader_atomic_int64"))) return;
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i)
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k)
            if (bench_begin(bench, points[i].name, sizes[k] == sizes[0] ? "1080" : "2160") &&
                !run_size(bench, &points[i], sizes[k]))
                bench_refuse(bench, points[i].name, "all");
}

const struct bench_suite bench_raster = {"raster", "the compute rasterizer against a naive one", columns,
                                         run_suite};
