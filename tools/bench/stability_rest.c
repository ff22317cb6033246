// stability_rest.c - Cases `rest HAIRCUT VERTICES`, every built-in haircut with default settings on
// a head at rest.
#include "tools/bench/stability.h"
#include "tools/bench/style_groom.h"
#include "tools/common/head_rig.h"

#include <math.h>

#define GUIDES 166 // guides of a haircut by default
#define GUIDES_SOFTWARE 16 // few enough for a CPU, enough to detect jitter

double bench_rest_limit(hair_solver solver)
{
    bool exact = solver == HAIR_SOLVER_DIRECT || solver == HAIR_SOLVER_ACCURATE;
    return exact ? 0.001 : 0.005;
}

bool bench_rest_must_sleep(hair_solver solver)
{
    return solver == HAIR_SOLVER_DIRECT || solver == HAIR_SOLVER_ACCURATE;
}

static hair_result make_groom(struct bench* bench, hair_style style, uint32_t guides, uint32_t vertices,
                              hair_groom** out)
{
    hair_style_desc desc = hair_style_desc_default();
    desc.style = style;
    desc.guide_count = guides;
    desc.strand_vertices = vertices;
    return bench_style_groom(bench, &desc, vertices, 0, out);
}

// Add the built-in head, neck and shoulders in their rest pose.
static hair_result add_head(hair_instance* hair)
{
    struct hair_scene scene;
    hair_collider colliders[HAIR_HEAD_RIG_COLLIDERS];
    const float still[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_scene_default(&scene);
    scene.head = true;
    uint32_t count = hair_head_rig_colliders(&scene, NULL, 0, still, colliders);
    return hair_set_colliders(hair, colliders, count, sizeof *colliders);
}

static void add_row(struct bench* bench, const char* name, const struct bench_scene* scene, double substep,
                    const hair_groom_info* info, bool collides, const struct bench_rest* rest,
                    const hair_solver_stats* solver_stats)
{
    struct bench_live_scene live = {.bench = bench, .scene = scene, .substep = substep};
    json_t* row = bench_rows_add(&bench->rows);
    bench_set_text(row, "case", name);
    bench_set_text(row, "method", bench_solver_name(scene->solver));
    bench_set_count(row, "vertices", info->guide_vertex_count / info->guide_count);
    bench_set_count(row, "guides", info->guide_count);
    bench_set_flag(row, "colliders", collides);
    bench_set_rest(row, scene->solver, rest);
    bench_set_solver_stats(row, solver_stats);
    bench_set_material(row, &live);
}

void bench_set_rest(json_t* row, hair_solver solver, const struct bench_rest* rest)
{
    double limit = bench_rest_limit(solver);
    bool pass = rest->finite && rest->max_speed <= limit;
    bench_set_flag(row, "finite", rest->finite);
    bench_set_number(row, "max_speed", rest->max_speed);
    bench_set_number(row, "moving_fraction", rest->moving_fraction);
    bench_set_number(row, "seconds_to_sleep", rest->seconds_asleep);
    bench_set_number(row, "limit", limit);
    bench_set_flag(row, "pass", pass && (!bench_rest_must_sleep(solver) || isfinite(rest->seconds_asleep)));
}

static bool run(struct bench* bench, const char* name, hair_groom* groom, hair_instance* hair,
                const struct bench_scene* scene, bool collides)
{
    struct bench_rest_desc desc = bench_rest_desc_default();
    hair_groom_info info = hair_groom_info_default();
    hair_solver_stats solver_stats = hair_solver_stats_default();
    struct bench_rest rest;
    desc.stop = bench_was_interrupted;
    if (hair_groom_describe(groom, &info) || (collides && add_head(hair))) return false;
    uint32_t vertices = info.guide_vertex_count / info.guide_count;
    if (!bench_measure_rest(hair, info.guide_count, vertices, &desc, &rest)) return false;
    if (hair_get_solver_stats(hair, &solver_stats)) return false;
    add_row(bench, name, scene, (double)solver_stats.substep, &info, collides, &rest, &solver_stats);
    return true;
}

static void measure(struct bench* bench, hair_style style, uint32_t vertices, hair_solver solver,
                    bool collides)
{
    char name[32];
    const char* method = bench_solver_name(solver);
    snprintf(name, sizeof name, "rest %s %u", hair_style_name(style), vertices);
    if (!bench_begin(bench, name, method)) return;
    uint32_t guides = bench->options.quick || bench->software ? GUIDES_SOFTWARE : GUIDES;
    hair_groom* groom = NULL;
    hair_instance* hair = NULL;
    struct bench_scene scene = bench_scene_default();
    hair_desc desc = hair_desc_default();
    if (bench->options.strands) guides = bench->options.strands;
    scene.physics = hair_physics_default();
    scene.solver = solver;
    scene.mapping = solver == HAIR_SOLVER_REDBLACK ? HAIR_THREAD_MAPPING_AUTO : bench->options.mapping;
    desc.solver = solver;
    desc.thread_mapping = scene.mapping;
    desc.diagnose = true;
    if (make_groom(bench, style, guides, vertices, &groom) ||
        hair_create(bench->context, groom, &desc, &hair) || !run(bench, name, groom, hair, &scene, collides))
        bench_refuse(bench, name, method);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

void bench_rest_haircuts(struct bench* bench)
{
    static const uint32_t counts[] = {32, 48, 64};
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    bool quick = bench->options.quick;
    for (int style = 0; style < HAIR_STYLE_COUNT; style += quick ? HAIR_STYLE_CURLY : 1)
        for (int k = 0; k < (quick ? 1 : 3); ++k)
            for (int s = 0; s < 4; ++s)
                for (int collides = 0; collides < (quick ? 1 : 2); ++collides)
                    measure(bench, (hair_style)style, counts[k], solvers[s], collides);
}
