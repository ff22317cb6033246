// collider_count.c - Cost of a step by the number of colliders, and with recorded contacts. Ten to
// ten thousand moving balls of equal size, or collision meshes, are among the hair.
#include "tools/bench/collider_count.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/host.h"
#include "tools/common/stats.h"

#define VERTICES 32
#define LENGTH 0.3f // m
#define SIDE 0.4f // side of the square of roots, m
#define RADIUS 0.01f
#define MAX_RUNS 41
#define POSTS 10
#define POST_RADIUS 0.02f
#define BUSY_FRAMES 40

enum kind { BALLS, MESHES, POSTS_WHOLE, POSTS_RECORDED, POSTS_OF_BALLS };

static const char* const names[] = {"balls", "meshes", "posts", "posts with recorded contacts",
                                    "posts of balls"};

struct subject {
    struct bench* bench;
    hair_groom* groom;
    hair_instance* hair;
    hair_collision_mesh* form;
    hair_collider* colliders;
    enum kind kind;
    uint32_t count, guides, frame;
};

static float random_in(uint32_t* state, float min, float max)
{
    *state = *state * 1664525u + 1013904223u;
    return min + (max - min) * (float)(*state >> 8) / 16777216.0f;
}

// Make straight strands that hang from a horizontal square.
static hair_result make_groom(struct subject* subject)
{
    uint32_t row = (uint32_t)sqrt((double)subject->guides), count = row * row;
    float* positions = malloc(sizeof(float) * 3 * VERTICES * count);
    uint32_t* vertices = malloc(sizeof *vertices * count);
    for (uint32_t i = 0; i < count && positions && vertices; ++i) {
        vertices[i] = VERTICES;
        for (uint32_t k = 0; k < VERTICES; ++k) {
            float* at = positions + 3 * (VERTICES * i + k);
            at[0] = SIDE * ((float)(i % row) / (float)row - 0.5f);
            at[1] = -LENGTH * (float)k / (VERTICES - 1);
            at[2] = SIDE * ((float)(i / row) / (float)row - 0.5f);
        }
    }
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &subject->bench->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = count;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = VERTICES;
    desc.follower_count = 0;
    hair_result result =
        positions && vertices ? hair_groom_create(&desc, &subject->groom) : HAIR_ERROR_MEMORY;
    subject->guides = count;
    free(positions);
    free(vertices);
    return result;
}

// Make an octahedron with each face subdivided into four, projected onto a sphere.
static hair_result make_mesh(struct subject* subject)
{
    static const float corners[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    static const uint32_t faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    float positions[8 * 6 * 3];
    uint32_t triangles[8 * 4 * 3];
    for (uint32_t f = 0; f < 8; ++f) {
        static const uint32_t cut[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
        for (uint32_t c = 0; c < 6; ++c) {
            const float *a = corners[faces[f][c % 3]], *b = corners[faces[f][c < 3 ? c : (c + 1) % 3]];
            float v[3], l = 0;
            for (int k = 0; k < 3; ++k) v[k] = a[k] + b[k], l += v[k] * v[k];
            for (int k = 0; k < 3; ++k) positions[3 * (6 * f + c) + (uint32_t)k] = RADIUS * v[k] / sqrtf(l);
        }
        for (uint32_t t = 0; t < 4; ++t)
            for (uint32_t k = 0; k < 3; ++k) triangles[3 * (4 * f + t) + k] = 6 * f + cut[t][k];
    }
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    desc.host = &subject->bench->host;
    desc.positions = positions;
    desc.triangles = triangles;
    desc.vertex_count = 8 * 6;
    desc.triangle_count = 8 * 4;
    desc.resolution = 24;
    return hair_collision_mesh_create(&desc, &subject->form);
}

static void die(struct subject* subject)
{
    hair_destroy(subject->hair);
    hair_collision_mesh_destroy(subject->form);
    hair_groom_destroy(subject->groom);
    free(subject->colliders);
}

// Return a collider at a random place among the hair, or a part of posts in two rows. Each post is
// one capsule or a stack of balls.
static hair_collider collider_of(const struct subject* subject, enum kind kind, uint32_t i, uint32_t* random)
{
    hair_collider collider = hair_collider_default();
    if (kind == BALLS || kind == MESHES) {
        collider.shape = kind == MESHES ? HAIR_SHAPE_MESH : HAIR_SHAPE_SPHERE;
        collider.mesh = subject->form;
        collider.size[0] = kind == MESHES ? 0 : RADIUS;
        collider.position[0] = random_in(random, -SIDE / 2, SIDE / 2);
        collider.position[1] = random_in(random, -LENGTH, -0.03f);
        collider.position[2] = random_in(random, -SIDE / 2, SIDE / 2);
        return collider;
    }
    uint32_t per_post = subject->count / POSTS, post = i / per_post;
    float half = 0.5f * LENGTH - 3 * POST_RADIUS, fraction = (float)(i % per_post) / (float)(per_post - 1);
    collider.size[0] = POST_RADIUS;
    collider.position[0] = SIDE * ((float)(post % 5) - 2) / 5;
    collider.position[1] = -0.5f * LENGTH;
    collider.position[2] = post < 5 ? -0.25f * SIDE : 0.25f * SIDE;
    if (kind == POSTS_OF_BALLS) {
        collider.position[1] += half * (2 * fraction - 1);
    } else {
        collider.shape = HAIR_SHAPE_CAPSULE;
        collider.size[1] = half;
    }
    return collider;
}

static bool live(struct bench* bench, uint32_t guides, uint32_t count, enum kind kind, struct subject* out)
{
    *out = (struct subject){.bench = bench, .kind = kind, .count = count, .guides = guides};
    hair_desc desc = hair_desc_default();
    uint32_t random = 7;
    hair_result result;
    desc.thread_mapping = bench->options.mapping;
    out->colliders = malloc(sizeof *out->colliders * count);
    result = out->colliders ? make_groom(out) : HAIR_ERROR_MEMORY;
    if (!result && kind == MESHES) result = make_mesh(out);
    if (!result) result = hair_create(bench->context, out->groom, &desc, &out->hair);
    if (!result && kind == POSTS_RECORDED) result = hair_record_contacts(out->hair, 1);
    for (uint32_t i = 0; i < count && !result; ++i) out->colliders[i] = collider_of(out, kind, i, &random);
    if (!result) return true;
    die(out);
    out->hair = NULL;
    return false;
}

static double time_of_passes(hair_context* context)
{
    hair_timing now[BENCH_MAX_PASSES];
    uint32_t count = hair_get_timings(context, now, BENCH_MAX_PASSES);
    double ms = 0;
    for (uint32_t i = 0; i < count && i < BENCH_MAX_PASSES; ++i)
        if (strncmp(now[i].pass, "sim/", 4) == 0) ms += now[i].total_ms;
    return ms;
}

// Read the contacts that the GPU has finished. Other steps may still run.
static bool read_contacts(struct subject* subject)
{
    hair_collider_contact contacts[POSTS];
    uint32_t count;
    return !hair_get_contacts(subject->hair, false, contacts, sizeof *contacts, POSTS, &count);
}

// Step one frame. Posts move together, other colliders move along different axes.
static bool ask_for_frame(struct subject* subject, double* ms_host)
{
    float way = 0.05f / 60 * (++subject->frame % 120 < 60 ? 1.0f : -1.0f); // 5 cm/s
    double start = hair_now();
    for (uint32_t i = 0; i < subject->count; ++i)
        subject->colliders[i].position[subject->kind >= POSTS_WHOLE ? 0 : i % 3] += way;
    bool whole =
        !hair_set_colliders(subject->hair, subject->colliders, subject->count, sizeof *subject->colliders) &&
        !hair_step(subject->hair, 1.0f / 60);
    if (whole && subject->kind == POSTS_RECORDED) whole = read_contacts(subject);
    *ms_host = hair_now() - start;
    return whole;
}

// Measure the GPU time and the CPU time of the thread that submits the work.
static bool run_frame(struct subject* subject, double* ms, double* ms_host)
{
    double passes = time_of_passes(subject->bench->context), start = hair_now();
    if (!ask_for_frame(subject, ms_host)) return false;
    glFinish();
    *ms = subject->bench->software ? hair_now() - start : time_of_passes(subject->bench->context) - passes;
    return !bench_was_interrupted();
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

static void add_row(struct subject* subject, double* ms, double* host, uint32_t runs, double of_few,
                    double limit)
{
    qsort(ms, runs, sizeof *ms, compare);
    qsort(host, runs, sizeof *host, compare);
    json_t* row = bench_rows_add(&subject->bench->rows);
    bench_set_text(row, "case", "many colliders");
    bench_set_text(row, "method", names[subject->kind]);
    bench_set_count(row, "strands", subject->guides);
    bench_set_count(row, "vertices", VERTICES);
    bench_set_count(row, "colliders", subject->count);
    bench_set_number(row, "ms", ms[runs / 2]);
    bench_set_number(row, "ms_host", host[runs / 2]);
    bench_set_count(row, "runs", runs);
    if (of_few > 0) bench_set_number(row, "ratio", ms[runs / 2] / of_few);
    if (limit > 0) {
        bench_set_number(row, "limit", limit);
        bench_set_flag(row, "pass", ms[runs / 2] <= limit * of_few);
    }
}

// Measure one frame. A GPU that mostly waits for the CPU lowers its clock, therefore first run
// frames of another subject.
static bool time_frame(struct subject* subject, struct subject* other, double* ms, double* ms_host)
{
    double none;
    bool whole = true;
    for (uint32_t k = 0; k < BUSY_FRAMES && whole && other->hair; ++k) whole = ask_for_frame(other, &none);
    glFinish();
    return whole && run_frame(subject, ms, ms_host);
}

// Measure many colliders next to a few, in alternating frames.
static void compare_with(struct bench* bench, enum kind few_kind, enum kind kind, uint32_t count,
                         double limit)
{
    struct subject few, many, other = {0};
    double ms[2][MAX_RUNS], host[2][MAX_RUNS], none;
    uint32_t runs = 0, max = bench->options.quick ? 3 : MAX_RUNS;
    uint32_t guides = bench->options.strands ? bench->options.strands : bench->options.quick ? 16 : 1024;
    if (!bench_begin(bench, "many colliders", names[kind])) return;
    if (!live(bench, guides, POSTS, few_kind, &few)) {
        bench_refuse(bench, "many colliders", names[few_kind]);
        return;
    }
    bool whole = bench->software || live(bench, guides, POSTS, few_kind, &other);
    whole = live(bench, guides, count, kind, &many) && whole;
    for (uint32_t k = 0; k < 3 && whole; ++k)
        whole = run_frame(&few, &none, &none) && run_frame(&many, &none, &none);
    for (; runs < max && whole; runs += whole)
        whole = time_frame(&few, &other, &ms[0][runs], &host[0][runs]) &&
                time_frame(&many, &other, &ms[1][runs], &host[1][runs]);
    if (runs && whole) {
        add_row(&few, ms[0], host[0], runs, 0, 0);
        add_row(&many, ms[1], host[1], runs, ms[0][runs / 2], limit);
    } else {
        bench_refuse(bench, "many colliders", names[kind]);
    }
    if (other.hair) die(&other);
    if (many.hair) die(&many);
    die(&few);
}

void bench_collider_count(struct bench* bench)
{
    bool quick = bench->options.quick;
    // The bodies have the same shape, so that many colliders are touched as often as a few.
    compare_with(bench, POSTS_WHOLE, POSTS_OF_BALLS, quick ? 100 : 1000, 2);
    compare_with(bench, POSTS_WHOLE, POSTS_RECORDED, POSTS, 0);
    // More bodies are touched more often.
    if (!quick) compare_with(bench, BALLS, BALLS, 100, 0);
    compare_with(bench, BALLS, BALLS, 1000, 0);
    if (!quick) compare_with(bench, BALLS, BALLS, 10000, 0);
    compare_with(bench, MESHES, MESHES, quick ? 100 : 1000, 0);
}
