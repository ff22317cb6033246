// world.c - Case `bullet world` of the suite `collision`, the cost of a Bullet world with many more
// objects than touch the hair.
#include "tools/bench/bust.h"
#include "tools/bullet/world.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

#define TOUCHING 12
#define EVERY 10000
#define MAX_RUNS 61
#define LIMIT 1.2

static const char* const name = "bullet world";

// A head of hair among objects. The number of objects that touch the hair is the same for both
// sides.
struct side {
    struct bench_bust bust;
    struct hair_scene scene; // contains the objects
    struct hair_world* world;
    uint32_t frame;
};

static float random_in(uint32_t* seed, float lower, float upper)
{
    *seed = *seed * 1664525u + 1013904223u;
    return lower + (upper - lower) * (float)(*seed >> 8) / 16777216.0f;
}

// Place the touching objects around the ends of the hair, where they move up and down. The other
// objects are anywhere in a hall, but not near the hair.
static bool fill(struct hair_scene* scene, uint32_t count)
{
    uint32_t seed = 7;
    scene->bullet.object = calloc(count, sizeof *scene->bullet.object);
    if (!scene->bullet.object) return false;
    scene->bullet.count = count;
    for (uint32_t i = 0; i < count; ++i) {
        struct hair_bullet_object* object = &scene->bullet.object[i];
        bool near = i < TOUCHING;
        object->shape = (struct hair_bullet_shape){
            .kind = HAIR_BULLET_SPHERE, .radius = near ? 0.02f : 0.2f, .scale = {1, 1, 1}, .margin = -1};
        object->body = (struct hair_scene_collider){.collider = hair_collider_default(), .stays = true};
        float* at = object->body.collider.position;
        for (int k = 0; k < 3; ++k) at[k] = random_in(&seed, -20, 20);
        if (!near && at[1] > -2 && at[1] < 4) at[0] += at[0] < 0 ? -4.0f : 4.0f;
        if (!near) continue;
        at[0] = random_in(&seed, -0.15f, 0.15f), at[1] = random_in(&seed, 1.35f, 1.5f);
        at[2] = random_in(&seed, -0.15f, 0.1f);
        for (uint32_t k = 0; k < HAIR_SCENE_COLLIDER_KEYS; ++k) {
            object->body.key[k].time = 0.25f * (float)k;
            object->body.key[k].position[1] = k % 2 ? 0.03f : 0;
        }
        object->body.key_count = HAIR_SCENE_COLLIDER_KEYS;
    }
    return true;
}

static void die(struct side* side)
{
    hair_world_destroy(side->world);
    hair_scene_free_bullet(&side->scene.bullet);
    if (side->bust.hair) bench_bust_free(&side->bust);
}

static bool live(struct bench* bench, uint32_t count, struct side* side)
{
    memset(side, 0, sizeof *side);
    bool ok = bench_bust_make(bench, 1000, 0, HAIR_HIT_METHOD_AUTO, &side->bust) &&
              fill(&side->scene, count) &&
              !hair_world_create(BENCH_TOOL, name, &side->scene, &bench->host, &side->world) && side->world;
    if (!ok) die(side);
    return ok;
}

// Return the time in ms of a frame of an application, or a negative value if the library refused.
// Objects move, objects that touch the hair become its colliders, the hair is simulated, and the
// field is updated.
static double time_frame(struct side* side, uint32_t* touching)
{
    static const float here[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_instance* hair = side->bust.hair;
    hair_field_info field = hair_field_info_default();
    const hair_collider* colliders;
    float lower[3], upper[3];
    glFinish();
    double start = hair_now();
    bool ok = !hair_get_bounds(hair, lower, upper) &&
              !hair_world_colliders(side->world, (float)++side->frame / 60, here, lower, upper, &colliders,
                                    touching) &&
              !hair_set_colliders(hair, colliders, *touching, sizeof *colliders) &&
              !hair_step(hair, 1.0f / 60) && !hair_get_field(hair, &field);
    glFinish();
    return ok ? hair_now() - start : -1;
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

// Measure both sides in alternating frames, so that both see the same state of the machine.
static bool measure(struct side sides[2])
{
    struct bench* bench = sides[0].bust.bench;
    uint32_t runs = bench->options.quick ? 15 : MAX_RUNS, touching[2] = {0};
    double ms[2][MAX_RUNS], medians[2];
    for (int i = -3; i < (int)runs; ++i) // the first frames create what is missing
        for (int k = 0; k < 2; ++k) {
            double time = time_frame(&sides[k], &touching[k]);
            if (time < 0 || bench_was_interrupted()) return false;
            if (touching[k] != TOUCHING) {
                snprintf(bench->sentence, sizeof bench->sentence, "%u objects touch the hair, not %u",
                         touching[k], (uint32_t)TOUCHING);
                return false;
            }
            if (i >= 0) ms[k][i] = time;
        }
    for (int k = 0; k < 2; ++k) {
        qsort(ms[k], runs, sizeof **ms, compare);
        medians[k] = ms[k][runs / 2];
        json_t* row = bench_rows_add(&bench->rows);
        bench_set_text(row, "case", name);
        bench_set_text(row, "method", k ? "among others" : "alone");
        bench_set_count(row, "colliders", touching[k]);
        bench_set_count(row, "objects", sides[k].scene.bullet.count);
        bench_set_number(row, "ms", medians[k]);
        bench_set_count(row, "runs", runs);
        if (!k) continue;
        bench_set_number(row, "ratio", medians[1] / medians[0]);
        bench_set_number(row, "limit", LIMIT);
        bench_set_flag(row, "pass", medians[1] <= LIMIT * medians[0]);
    }
    return true;
}

void bench_measure_world(struct bench* bench)
{
    struct side sides[2];
    if (!bench_begin(bench, name, "among others")) return;
    bool first = live(bench, TOUCHING, &sides[0]), both = first && live(bench, EVERY, &sides[1]);
    if (!both || !measure(sides)) bench_refuse(bench, name, "among others");
    if (both) die(&sides[1]);
    if (first) die(&sides[0]);
}
