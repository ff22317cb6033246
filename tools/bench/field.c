// field.c - Suite `field`, the cost of voxelizing colliders and the error of the field against
// exact distances.
//
// The suite uses the public interface. It sets colliders, hair_get_field() updates the field, and
// the field's texture is read.
#include "tools/bench/field_body.h"
#include "tools/bench/field_error.h"
#include "tools/bench/pass_time.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 0.6 // side of the field's box, m
#define MAX_RUNS 41
#define MIXED 20
#define MANY 10000

static const char* const columns[] = {
    "case",       "method", "shape",     "resolution", "colliders", "ms",         "ms_min",
    "ms_max",     "runs",   "max_error", "rms_error",  "max_limit", "max_centre", "centre_limit",
    "wrong_sign", "ratio",  "limit",     "passes_run", "triangles", "pass",       NULL};

struct subject {
    struct bench* bench;
    hair_groom* groom;
    hair_instance* hair;
    hair_field_info info;
};

// Instances ---------------------------------------------------------------------------------------

// Make one strand in each direction of each axis, so that the field's box is a cube.
static hair_result make_groom(struct bench* bench, hair_groom** out)
{
    enum { VERTICES = 4 };
    float positions[6 * VERTICES * 3] = {0};
    uint32_t vertices[6];
    for (int i = 0; i < 6; ++i) {
        vertices[i] = VERTICES;
        for (int k = 0; k < VERTICES; ++k) {
            float at = (float)(SIDE / 2) * (float)(k + 1) / VERTICES;
            positions[3 * (VERTICES * i + k) + i / 2] = i % 2 ? at : -at;
        }
    }
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &bench->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 6;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = VERTICES;
    desc.follower_count = 0;
    return hair_groom_create(&desc, out);
}

static void die(struct subject* subject)
{
    hair_destroy(subject->hair);
    hair_groom_destroy(subject->groom);
}

static bool live(struct bench* bench, uint32_t resolution, struct subject* out)
{
    *out = (struct subject){.bench = bench, .info = hair_field_info_default()};
    hair_desc desc = hair_desc_default();
    desc.field_voxel = (float)(SIDE / resolution);
    hair_result result = make_groom(bench, &out->groom);
    if (!result) result = hair_create(bench->context, out->groom, &desc, &out->hair);
    if (!result) return true;
    die(out);
    return false;
}

static bool update(struct subject* subject, const hair_collider* colliders, uint32_t count)
{
    return !hair_set_colliders(subject->hair, colliders, count, sizeof *colliders) &&
           !hair_get_field(subject->hair, &subject->info);
}

// Measure an update. If the driver's timers do not measure compute shaders, wall time is used,
// which includes CPU work. Return NAN if the library refused.
static double time_update(struct subject* subject, const hair_collider* colliders, uint32_t count)
{
    struct bench* bench = subject->bench;
    uint32_t runs;
    glFinish();
    double gpu = bench_sum_passes(bench, "field/", &runs), start = hair_now();
    if (!update(subject, colliders, count)) return NAN;
    glFinish();
    double wall = hair_now() - start;
    return bench->software ? wall : bench_sum_passes(bench, "field/", &runs) - gpu;
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

static double median(double* ms, uint32_t count)
{
    qsort(ms, count, sizeof *ms, compare);
    return ms[count / 2];
}

static void set_times(json_t* row, double* ms, uint32_t count)
{
    bench_set_number(row, "ms", median(ms, count));
    bench_set_number(row, "ms_min", ms[0]);
    bench_set_number(row, "ms_max", ms[count - 1]);
    bench_set_count(row, "runs", count);
}

static json_t* new_row(struct subject* subject, const char* name, uint32_t colliders)
{
    json_t* row = bench_rows_add(&subject->bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", "voxelise");
    bench_set_count(row, "resolution", subject->info.size[0]);
    bench_set_count(row, "colliders", colliders);
    return row;
}

// Colliders ---------------------------------------------------------------------------------------

static hair_collider any_collider(hair_shape shape, double size, double reach, uint32_t* seed)
{
    hair_collider collider = hair_collider_default();
    double norm = 0, q[4];
    for (int i = 0; i < 4; ++i) {
        q[i] = bench_field_random(seed, -1, 1);
        norm += q[i] * q[i];
    }
    collider.shape = shape;
    for (int i = 0; i < 4; ++i) collider.rotation[i] = (float)(q[i] / sqrt(norm));
    for (int i = 0; i < 3; ++i) collider.position[i] = (float)bench_field_random(seed, -reach, reach);
    for (int i = 0; i < 3; ++i) collider.size[i] = (float)(size * bench_field_random(seed, 0.8, 1.2));
    return collider;
}

#define ROWS 128u

// Make a ball with enough triangles to be round to 1e-4 of its radius.
static hair_collision_mesh* make_ball(struct bench* bench, double radius)
{
    size_t vertices = (size_t)(ROWS + 1) * 2 * ROWS, triangles = 0;
    float* positions = malloc(vertices * 3 * sizeof *positions);
    uint32_t* indices = malloc(2 * vertices * 3 * sizeof *indices);
    hair_collision_mesh* mesh = NULL;
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    const double pi = 3.14159265358979323846;
    for (uint32_t i = 0; positions && indices && i < vertices; ++i) {
        uint32_t row = i / (2 * ROWS), column = i % (2 * ROWS);
        double around = row % ROWS ? sin(pi * row / ROWS) : 0,
               turn = pi * column / ROWS; // one point at the poles
        positions[3 * i] = (float)(radius * around * sin(turn));
        positions[3 * i + 1] = (float)(radius * cos(pi * row / ROWS));
        positions[3 * i + 2] = (float)(radius * around * cos(turn));
        if (row == ROWS) continue;
        uint32_t right = column + 1 < 2 * ROWS ? i + 1 : i + 1 - 2 * ROWS;
        const uint32_t two[6] = {i, i + 2 * ROWS, right, right, i + 2 * ROWS, right + 2 * ROWS};
        memcpy(indices + 3 * triangles, two, sizeof two);
        triangles += 2;
    }
    desc.host = &bench->host;
    desc.positions = positions;
    desc.triangles = indices;
    desc.vertex_count = (uint32_t)vertices;
    desc.triangle_count = (uint32_t)triangles;
    desc.resolution = 128;
    if (positions && indices && hair_collision_mesh_create(&desc, &mesh)) mesh = NULL;
    free(positions);
    free(indices);
    return mesh;
}

// Shapes ------------------------------------------------------------------------------------------

struct shape_row {
    const char* name;
    hair_shape shape;
    double rounding; // as a fraction of the size
    double limit; // in voxels
};

static void set_errors(json_t* row, const struct shape_row* shape, const struct bench_field_error* errors)
{
    // A field that is sampled from a grid has errors at voxel centres too.
    double centre = shape->shape == HAIR_SHAPE_MESH ? shape->limit : 0.05;
    bench_set_text(row, "shape", shape->name);
    bench_set_number(row, "max_error", errors->max);
    bench_set_number(row, "rms_error", sqrt(errors->square / (double)errors->points));
    bench_set_number(row, "max_limit", shape->limit);
    bench_set_number(row, "max_centre", errors->centre);
    bench_set_number(row, "centre_limit", centre);
    bench_set_count(row, "wrong_sign", errors->wrong);
    bench_set_flag(row, "pass", errors->max <= shape->limit && errors->centre <= centre && !errors->wrong);
}

static bool run_shape(struct subject* subject, const struct shape_row* shape, hair_collision_mesh* ball)
{
    uint32_t seed = 5, runs = subject->bench->options.quick ? 9 : 21;
    double ms[MAX_RUNS], size = 0.08;
    hair_collider collider = any_collider(shape->shape, size, 0.02, &seed), moved = collider,
                  exact = collider;
    collider.rounding = (float)(shape->rounding * size);
    if (shape->shape == HAIR_SHAPE_MESH) {
        collider.mesh = ball;
        exact.shape = HAIR_SHAPE_SPHERE;
        exact.size[0] = (float)size;
    } else
        exact = collider;
    moved = collider;
    moved.position[0] += 0.05f;
    if (!update(subject, &moved, 1) || !update(subject, &collider, 1)) return false;
    for (uint32_t i = 0; i < runs; ++i)
        if (isnan(ms[i] = time_update(subject, i % 2 ? &collider : &moved, 1))) return false;
    if (!update(subject, &collider, 1)) return false;
    const uint32_t* n = subject->info.size;
    size_t bytes = (size_t)n[0] * n[1] * n[2] * sizeof(float);
    float* texels = malloc(bytes);
    if (!texels || !subject->info.distance_texture) {
        free(texels);
        return false;
    }
    glGetTextureImage(subject->info.distance_texture, 0, GL_RED, GL_FLOAT, (GLsizei)bytes, texels);
    struct bench_field_error errors;
    bench_field_measure(&subject->info, texels, &exact, subject->bench->options.quick ? 400000 : 2000000,
                        &errors);
    free(texels);
    json_t* row = new_row(subject, "shape", 1);
    set_times(row, ms, runs);
    set_errors(row, shape, &errors);
    return true;
}

static void run_shapes(struct bench* bench)
{
    static const struct shape_row shapes[] = {{"sphere", HAIR_SHAPE_SPHERE, 0, 0.5},
                                              {"capsule", HAIR_SHAPE_CAPSULE, 0, 0.5},
                                              {"box", HAIR_SHAPE_BOX, 0, 0.9},
                                              {"rounded box", HAIR_SHAPE_BOX, 1, 0.5},
                                              {"cylinder", HAIR_SHAPE_CYLINDER, 0, 0.9},
                                              {"cone", HAIR_SHAPE_CONE, 0, 0.9},
                                              {"ellipsoid", HAIR_SHAPE_ELLIPSOID, 0, 0.5},
                                              {"plane", HAIR_SHAPE_PLANE, 0, 0.5},
                                              {"mesh of a ball", HAIR_SHAPE_MESH, 0, 0.5}};
    static const uint32_t resolutions[] = {32, 64, 128, 256};
    hair_collision_mesh* ball = NULL;
    for (int r = 0; r < (bench->options.quick ? 2 : 4); ++r)
        for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i) {
            struct subject subject;
            if (!bench_begin(bench, "shape", "voxelise")) continue;
            if (!ball) ball = make_ball(bench, 0.08);
            bool lives = ball && live(bench, resolutions[r], &subject);
            if (!lives || !run_shape(&subject, &shapes[i], ball)) bench_refuse(bench, "shape", "voxelise");
            if (lives) die(&subject);
        }
    hair_collision_mesh_destroy(ball);
}

// Moving colliders --------------------------------------------------------------------------------

static void make_mixed(hair_collider* colliders, uint32_t count, double size)
{
    uint32_t seed = 11;
    for (uint32_t i = 0; i < count; ++i)
        colliders[i] = any_collider((hair_shape)(i % HAIR_SHAPE_PLANE), size, 0.26, &seed);
}

// Move each collider in turn among the others and alone. The two runs alternate, so that both see
// the same state of the machine.
static bool run_moved(struct subject* mixed, struct subject* alone, uint32_t count)
{
    hair_collider colliders[MIXED];
    uint32_t runs = mixed->bench->options.quick ? 5 : 15;
    double sums[2] = {0}, min[2] = {0}, ms[2][MAX_RUNS];
    make_mixed(colliders, count, 0.04);
    if (!update(mixed, colliders, count)) return false;
    for (uint32_t k = 0; k < count; ++k) {
        if (!update(alone, &colliders[k], 1)) return false;
        for (uint32_t i = 0; i < runs; ++i) {
            colliders[k].position[1] += i % 2 ? 0.02f : -0.02f;
            ms[0][i] = time_update(mixed, colliders, count);
            ms[1][i] = time_update(alone, &colliders[k], 1);
            if (isnan(ms[0][i]) || isnan(ms[1][i])) return false;
        }
        for (int i = 0; i < 2; ++i) {
            sums[i] += median(ms[i], runs) / count;
            // The minimum is used, because other load on the machine only lengthens times.
            min[i] += ms[i][0] / count;
        }
    }
    for (int i = 0; i < 2; ++i) {
        json_t* row = new_row(i ? alone : mixed, i ? "one alone" : "one of them", i ? 1 : count);
        bench_set_number(row, "ms", sums[i]);
        bench_set_number(row, "ms_min", min[i]);
        bench_set_count(row, "runs", runs * count);
        if (i) continue;
        bench_set_number(row, "ratio", min[0] / min[1]);
        bench_set_number(row, "limit", 1.3);
        bench_set_flag(row, "pass", min[0] / min[1] <= 1.3);
    }
    return true;
}

static bool run_all(struct subject* subject, const char* name, uint32_t count, double size, bool still)
{
    hair_collider* colliders = malloc(count * sizeof *colliders);
    uint32_t runs = 9, before, after;
    double ms[MAX_RUNS];
    bool ok = colliders;
    if (ok) make_mixed(colliders, count, size);
    ok = ok && update(subject, colliders, count);
    bench_sum_passes(subject->bench, "field/", &before);
    for (uint32_t k = 0; k < runs && ok; ++k) {
        for (uint32_t i = 0; i < count && !still; ++i) colliders[i].position[2] += k % 2 ? 0.02f : -0.02f;
        ok = !isnan(ms[k] = time_update(subject, colliders, count));
    }
    bench_sum_passes(subject->bench, "field/", &after);
    free(colliders);
    if (!ok) return false;
    json_t* row = new_row(subject, name, count);
    set_times(row, ms, runs);
    bench_set_count(row, "passes_run", after - before);
    if (still) bench_set_flag(row, "pass", after == before);
    return true;
}

static void run_scenes(struct bench* bench)
{
    static const char* const names[] = {"one of them", "all of them", "none of them", "many"};
    for (int i = 0; i < 4; ++i) {
        struct subject subject, alone;
        if (!bench_begin(bench, names[i], "voxelise")) continue;
        bool lives = live(bench, 128, &subject), two = lives && !i && live(bench, 128, &alone), ok = false;
        if (two) ok = run_moved(&subject, &alone, MIXED);
        if (lives && i) ok = run_all(&subject, names[i], i < 3 ? MIXED : MANY, i < 3 ? 0.04 : 0.01, i == 2);
        if (!ok) bench_refuse(bench, names[i], "voxelise");
        if (two) die(&alone);
        if (lives) die(&subject);
    }
}

static void run_suite(struct bench* bench)
{
    run_shapes(bench);
    run_scenes(bench);
    bench_field_bodies(bench);
}

const struct bench_suite bench_field = {"field", "colliders as a field, against their exact distances",
                                        columns, run_suite};
